#include "arrays.h"
#include "bindings.h"
#include "job.h"
#include "model_handle.h"
#include "pfgeom/render/render.h"
#include "shape_handle.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace py = pybind11;

namespace pfgeom::bindings {
namespace {

/// The share of a picture's progress that making the scene is.
constexpr double kPreparing = 0.2;

using Triple = std::array<double, 3>;

/// Directions get unit length, so that a ray's parameter is a distance; those without one stay as they are.
std::vector<Ray> rays_from(const Points& origins, const Points& directions) {
    const std::vector<Vec3> from = points_from(origins), along = points_from(directions);
    if (from.size() != along.size()) throw InvalidInput("there must be as many origins as directions");
    std::vector<Ray> rays;
    rays.reserve(from.size());
    for (std::size_t i = 0; i < from.size(); ++i) {
        const Vec3 size = max(along[i], -along[i]);
        const double largest = std::max({size.x, size.y, size.z});
        rays.push_back({from[i], largest > 0 ? normalized(along[i] / largest) : along[i]});
    }
    return rays;
}

py::tuple cast(const ModelPointer& handle, const Points& origins, const Points& directions, double from,
               double to, int threads, py::object progress, const CancelToken* cancel) {
    Job job(threads, std::move(progress), cancel);
    const std::vector<SurfaceHit> hits =
        job.run([=, rays = rays_from(origins, directions)](const Task& task) {
            return cast_rays(handle->scene(task), rays, {from, to}, quiet(task, task.threads));
        });
    std::vector<double> distances;
    std::vector<Vec3> normals;
    std::vector<std::int32_t> objects, functions;
    for (const SurfaceHit& hit : hits) {
        distances.push_back(hit.t);
        normals.push_back(hit.normal);
        objects.push_back(hit.object);
        functions.push_back(hit.function);
    }
    const auto count = static_cast<py::ssize_t>(hits.size());
    return py::make_tuple(array_of<double>(std::move(distances), {count}),
                          array_from<double>(std::move(normals)),
                          array_of<std::int32_t>(std::move(objects), {count}),
                          array_of<std::int32_t>(std::move(functions), {count}));
}

Vec3 vector_of(const Triple& values) {
    return {values[0], values[1], values[2]};
}

/// What the points of a picture are worked out from: an eye, three axes, and whether it is orthographic.
py::tuple describe_camera(const Camera& camera) {
    const std::vector<Vec3> rows{camera.eye, camera.forward, camera.right, camera.up};
    return py::make_tuple(array_from<double>(rows), camera.orthographic);
}

/// `fitted`: what the camera sees as large as possible; the shape itself, unless it is another one.
py::tuple draw(const ShapeArgument& shape, const std::optional<ShapeArgument>& fitted, int width, int height,
               int samples, const Triple& direction, const Triple& up, double slope, double margin,
               int threads, py::object progress, const CancelToken* cancel) {
    Job job(threads, std::move(progress), cancel);
    const PictureSize size{width, height, samples};
    const View view{vector_of(direction), vector_of(up), slope, margin};
    std::optional<ShapeHandle> other;
    if (fitted) other.emplace(*fitted);
    auto [picture, camera] = job.run([=, drawn = ShapeHandle(shape)](const Task& task) {
        check_size(size);
        const auto scene = drawn.scene(part_of(task, 0, kPreparing));
        const Task quietly = quiet(task, task.threads);
        const Camera from = fit_camera(other ? other->scene(quietly)->cover() : scene->cover(), view, size);
        return std::pair(render(*scene, from, size, part_of(task, kPreparing, 1)), from);
    });
    const py::ssize_t rows = height, columns = width;
    return py::make_tuple(array_of<std::uint8_t>(std::move(picture.colours), {rows, columns, 4}),
                          array_of<double>(std::move(picture.depth), {rows, columns}),
                          array_of<float>(std::move(picture.normals), {rows, columns, 3}),
                          array_of<std::int32_t>(std::move(picture.objects), {rows, columns}),
                          array_of<std::int32_t>(std::move(picture.functions), {rows, columns}),
                          describe_camera(camera));
}

}  // namespace

void bind_render(py::module_& m) {
    m.def("raycast", &cast, py::arg("model"), py::arg("origins").noconvert(),
          py::arg("directions").noconvert(), py::arg("start"), py::arg("end"), py::arg("threads"),
          py::arg("progress"), py::arg("cancel"));
    m.def("render", &draw, py::arg("shape"), py::arg("fitted"), py::arg("width"), py::arg("height"),
          py::arg("samples"), py::arg("direction"), py::arg("up"), py::arg("slope"), py::arg("margin"),
          py::arg("threads"), py::arg("progress"), py::arg("cancel"));
}

}  // namespace pfgeom::bindings
