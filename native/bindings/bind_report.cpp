#include "arrays.h"
#include "bindings.h"
#include "describe.h"
#include "job.h"
#include "pfgeom/report/deviation.h"

namespace py = pybind11;

namespace pfgeom::bindings {
namespace {

py::dict compare_arrays(const Points& vertices_a, const Indices& faces_a, const Points& vertices_b,
                        const Indices& faces_b, std::size_t samples, std::uint64_t seed, bool bound,
                        int threads, py::object progress, const CancelToken* cancel) {
    const auto a = std::make_shared<const TriangleMesh>(mesh_from(vertices_a, faces_a));
    const auto b = std::make_shared<const TriangleMesh>(mesh_from(vertices_b, faces_b));
    DeviationOptions options;
    options.samples = samples;
    options.seed = seed;
    options.bound = bound;
    options.smooth_normals = true;
    Job job(threads, std::move(progress), cancel);
    py::dict result = describe_deviation(
        job.run([=](const Task& task) { return measure_deviation(*a, *b, options, task); }));
    result["diagonal"] = diagonal(*a);
    return result;
}

}  // namespace

void bind_report(py::module_& m) {
    m.def("compare", &compare_arrays, py::arg("vertices_a").noconvert(), py::arg("faces_a").noconvert(),
          py::arg("vertices_b").noconvert(), py::arg("faces_b").noconvert(), py::arg("samples"),
          py::arg("seed"), py::arg("bound"), py::arg("threads"), py::arg("progress"), py::arg("cancel"));
}

}  // namespace pfgeom::bindings
