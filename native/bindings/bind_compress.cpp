#include "arrays.h"
#include "bindings.h"
#include "describe.h"
#include "job.h"
#include "model_handle.h"
#include "pfgeom/compress/compress.h"

namespace py = pybind11;

namespace pfgeom::bindings {
namespace {

py::tuple compress_arrays(const Points& vertices, const Indices& faces,
                          const std::optional<Indices>& materials, std::vector<std::string> names,
                          double tolerance, bool relative, bool rms, std::uint8_t effort, int threads,
                          py::object progress, const CancelToken* cancel) {
    TriangleMesh bare = mesh_from(vertices, faces);
    FaceMaterials painted = materials_from(materials, std::move(names), bare.faces.size());
    const auto mesh = std::make_shared<const PaintedMesh>(PaintedMesh{std::move(bare), std::move(painted)});
    const CompressOptions options{tolerance, relative, rms ? Metric::rms : Metric::max,
                                  static_cast<Effort>(effort)};
    Job job(threads, std::move(progress), cancel);
    Compressed result = job.run([=](const Task& task) { return compress(*mesh, options, task); });
    const py::dict report = describe_report(result.report);
    return py::make_tuple(std::make_shared<ModelHandle>(std::move(result.model), std::move(result.bytes)),
                          report);
}

}  // namespace

void bind_compress(py::module_& m) {
    m.def("compress", &compress_arrays, py::arg("vertices").noconvert(), py::arg("faces").noconvert(),
          py::arg("materials").noconvert(), py::arg("names"), py::arg("tolerance"), py::arg("relative"),
          py::arg("rms"), py::arg("effort"), py::arg("threads"), py::arg("progress"), py::arg("cancel"),
          "(Model, what was measured on the way)");
}

}  // namespace pfgeom::bindings
