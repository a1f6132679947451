#include "arrays.h"
#include "bindings.h"
#include "describe.h"
#include "job.h"
#include "model_handle.h"
#include "pfgeom/render/depth_buffers.h"

#include <pybind11/stl.h>

#include <memory>
#include <utility>
#include <variant>

namespace py = pybind11;

namespace pfgeom::bindings {
namespace {

/// The shares of the progress that the scenes of both sides are ready at.
constexpr double kFirst = 0.05, kSecond = 0.1;

using Arrays = std::pair<Points, Indices>;  // vertices and faces
using Side = std::variant<ModelPointer, Arrays>;

/// Owns what it makes a scene of.
class Shape {
  public:
    explicit Shape(const Side& side) {
        if (const auto* arrays = std::get_if<Arrays>(&side)) {
            mesh_ = std::make_shared<const TriangleMesh>(mesh_from(arrays->first, arrays->second));
        } else {
            model_ = std::get<ModelPointer>(side);
        }
    }

    /// A model's is shared with other calls.
    std::shared_ptr<const RayScene> scene(const Task& task) const {
        if (model_) return {model_, &model_->scene(task)};
        return std::make_shared<const RayScene>(*mesh_, task);
    }

  private:
    ModelPointer model_;
    std::shared_ptr<const TriangleMesh> mesh_;
};

py::dict compare_shapes(const Side& a, const Side& b, int side, double tolerance, int threads,
                        py::object progress, const CancelToken* cancel) {
    Job job(threads, std::move(progress), cancel);
    return describe_depths(job.run([=, a = Shape(a), b = Shape(b)](const Task& task) {
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
