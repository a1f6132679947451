#include "arrays.h"
#include "bindings.h"
#include "describe.h"
#include "errors.h"
#include "job.h"
#include "model_handle.h"
#include "pfgeom/base/parallel.h"
#include "pfgeom/codec/codec.h"
#include "pfgeom/compress/compress.h"
#include "pfgeom/compress/surface_size.h"
#include "pfgeom/function/check.h"
#include "pfgeom/render/closest.h"
#include "pfgeom/report/function_list.h"

#include <pybind11/stl.h>

#include <limits>
#include <string>
#include <vector>

namespace py = pybind11;

namespace pfgeom::bindings {
namespace {

/// Points a chunk: some milliseconds of work.
constexpr std::size_t kChunk = 1024;

ModelPointer decode_bytes(const py::bytes& data) {
    const std::string_view view = data;
    return Job().run([bytes = std::vector<std::uint8_t>(view.begin(), view.end())](const Task&) {
        Result<Model> model = decode(bytes);
        if (!model) throw FormatFailure(model.status());
        return std::make_shared<ModelHandle>(std::move(*model), bytes);
    });
}

py::bytes bytes_of(const ModelHandle& handle) {
    return py::bytes(reinterpret_cast<const char*>(handle.bytes().data()), handle.bytes().size());
}

py::tuple mesh_of_model(const ModelPointer& handle, std::optional<double> tolerance,
                        std::optional<int> resolution, int threads, py::object progress,
                        const CancelToken* cancel) {
    Job job(threads, std::move(progress), cancel);
    return arrays_from(job.run([=](const Task& task) {
        return to_painted_mesh(handle->model(), MeshOptions{tolerance, resolution}, task);
    }));
}

/// query(field, point) for every row; `unknown` where a coordinate is not finite.
template <class Value, class Query>
std::vector<Value> query_all(const ModelPointer& handle, const Points& points, int threads, Value unknown,
                             Query query) {
    Job job(threads, py::none(), nullptr);
    return job.run([=, rows = points_from(points)](const Task& task) {
        const ModelField& field = handle->field();
        std::vector<Value> values(rows.size());
        parallel_chunks(rows.size(), kChunk, task, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                values[i] = is_finite(rows[i]) ? query(field, rows[i]) : unknown;
        });
        return values;
    });
}

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

py::array values_at(const ModelPointer& handle, const Points& points, int threads) {
    const auto values = query_all(handle, points, threads, kNaN,
                                  [](const ModelField& field, const Vec3& p) { return field.value(p); });
    return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

py::array gradients_at(const ModelPointer& handle, const Points& points, int threads) {
    return array_from<double>(
        query_all(handle, points, threads, Vec3{kNaN, kNaN, kNaN},
                  [](const ModelField& field, const Vec3& p) { return field.gradient(p); }));
}

py::array contains_at(const ModelPointer& handle, const Points& points, int threads) {
    const auto inside = query_all(
        handle, points, threads, std::uint8_t{0},
        [](const ModelField& field, const Vec3& p) { return static_cast<std::uint8_t>(field.contains(p)); });
    return py::array_t<std::uint8_t>(static_cast<py::ssize_t>(inside.size()), inside.data());
}

/// The same functions with other names and another place in the world, as a file of their own.
ModelPointer placed(const ModelPointer& handle, std::vector<std::string> names,
                    std::vector<double> world_transform) {
    return Job().run([=](const Task&) {
        Model model = handle->model();
        model.names = names;
        model.world_transform = world_transform;
        if (const std::string flaw = find_flaw(model); !flaw.empty()) throw InvalidInput(flaw);
        std::vector<std::uint8_t> bytes = encode(model);
        return std::make_shared<ModelHandle>(std::move(model), std::move(bytes));
    });
}

py::list function_list_of(const ModelPointer& handle) {
    return describe_function_list(
        Job().run([=](const Task& task) { return list_functions(handle->model(), task); }));
}

py::list names_of(const ModelHandle& handle) {
    py::list names;
    for (const std::string& name : handle.model().names) names.append(py::str(name));
    return names;
}

/// Of the bounds, as a share of the diagonal.
constexpr double kBoundsAccuracy = 1e-6;

py::array bounds_of(const ModelPointer& handle) {
    const Box box = Job().run([=](const Task& task) {
        const Task quietly = quiet(task, task.threads);
        return handle->scene(quietly).bounds(kBoundsAccuracy * handle->model().diagonal, quietly);
    });
    return array_from<double>(std::vector<Vec3>{box.lo, box.hi});
}

py::tuple size_of(const ModelPointer& handle, double tolerance, int threads, py::object progress,
                  const CancelToken* cancel) {
    Job job(threads, std::move(progress), cancel);
    const SurfaceSize size =
        job.run([=](const Task& task) { return surface_size(handle->model(), tolerance, task); });
    return py::make_tuple(size.area, size.volume);
}

/// The share of a search's progress that making the scene is.
constexpr double kPreparing = 0.2;

py::tuple closest_on_model(const ModelPointer& handle, const Points& points, double accuracy, int threads,
                           py::object progress, const CancelToken* cancel) {
    Job job(threads, std::move(progress), cancel);
    const std::vector<NearestPoint> found = job.run([=, rows = points_from(points)](const Task& task) {
        const RayScene& scene = handle->scene(part_of(task, 0, kPreparing));
        if (!scene.keeps_distances())
            throw InvalidInput("closest points of set operations and sheared models cannot be searched for");
        return closest_points(scene, rows, accuracy, part_of(task, kPreparing, 1));
    });
    std::vector<Vec3> places;
    std::vector<double> distances, proved;
    std::vector<std::int32_t> objects;
    for (const NearestPoint& nearest : found) {
        const bool none = nearest.object < 0;
        places.push_back(none ? Vec3{kNaN, kNaN, kNaN} : nearest.point);
        distances.push_back(none ? kNaN : nearest.distance);
        proved.push_back(none ? kNaN : nearest.proved);
        objects.push_back(nearest.object);
    }
    const auto count = static_cast<py::ssize_t>(found.size());
    return py::make_tuple(
        array_from<double>(std::move(places)), array_of<double>(std::move(distances), {count}),
        array_of<double>(std::move(proved), {count}), array_of<std::int32_t>(std::move(objects), {count}));
}

}  // namespace

void bind_model(py::module_& m) {
    m.def("decode", &decode_bytes, py::arg("data"));
    py::class_<ModelHandle, ModelPointer>(m, "Model", "A decoded model and its bytes.")
        .def("to_bytes", &bytes_of)
        .def("to_mesh", &mesh_of_model, py::arg("tolerance"), py::arg("resolution"), py::arg("threads"),
             py::arg("progress"), py::arg("cancel"))
        .def("values", &values_at, py::arg("points").noconvert(), py::arg("threads"))
        .def("gradients", &gradients_at, py::arg("points").noconvert(), py::arg("threads"))
        .def("contains", &contains_at, py::arg("points").noconvert(), py::arg("threads"))
        .def("bounds", &bounds_of)
        .def("closest_points", &closest_on_model, py::arg("points").noconvert(), py::arg("accuracy"),
             py::arg("threads"), py::arg("progress"), py::arg("cancel"))
        .def("size", &size_of, py::arg("tolerance"), py::arg("threads"), py::arg("progress"),
             py::arg("cancel"))
        .def("names", &names_of)
        .def("material_names", [](const ModelHandle& h) { return h.model().materials.names; })
        .def("world_transform", [](const ModelHandle& h) { return h.model().world_transform; })
        .def("placed", &placed, py::arg("names"), py::arg("world_transform"))
        .def("functions", [](const ModelHandle& h) { return describe_functions(h.model()); })
        .def("function_list", &function_list_of)
        .def("objects", [](const ModelHandle& h) { return describe_objects(h.model()); })
        .def("promise", [](const ModelHandle& h) { return describe_promise(h.model()); })
        .def("sizes", [](const ModelHandle& h) { return describe_sizes(h.model()); });
}

}  // namespace pfgeom::bindings
