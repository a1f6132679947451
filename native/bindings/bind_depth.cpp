#include "bindings.h"
#include "describe.h"
#include "job.h"
#include "pfgeom/render/depth_buffers.h"
#include "shape_handle.h"

#include <pybind11/stl.h>

#include <utility>

namespace py = pybind11;

namespace pfgeom::bindings {
namespace {

/// The shares of the progress that the scenes of both sides are ready at.
constexpr double kFirst = 0.05, kSecond = 0.1;

py::dict compare_shapes(const ShapeArgument& a, const ShapeArgument& b, int side, double tolerance,
                        int threads, py::object progress, const CancelToken* cancel) {
    Job job(threads, std::move(progress), cancel);
    return describe_depths(job.run([=, a = ShapeHandle(a), b = ShapeHandle(b)](const Task& task) {
        const auto scene_a = a.scene(part_of(task, 0, kFirst));
        const auto scene_b = b.scene(part_of(task, kFirst, kSecond));
        return compare_depths(*scene_a, *scene_b, {side, tolerance}, part_of(task, kSecond, 1));
    }));
}

}  // namespace

void bind_depth(py::module_& m) {
    m.def("compare_depths", &compare_shapes, py::arg("a"), py::arg("b"), py::arg("side"),
          py::arg("tolerance"), py::arg("threads"), py::arg("progress"), py::arg("cancel"));
}

}  // namespace pfgeom::bindings
