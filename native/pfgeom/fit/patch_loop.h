// A loop that changes patch after patch, on several threads, with the result of one pass in order: patches
// that have a face in common are changed one after the other, in their order, all others side by side.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/fit/collapse_error.h"
#include "pfgeom/fit/collapse_mesh.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace pfgeom {

class PatchLoop {
  public:
    /// Over patches of `mesh`, whose faces stay what they are. Those of an error whose patches are not
    /// independent() are all changed one after the other.
    PatchLoop(const CollapseMesh& mesh, const CollapseError& error)
        : side_by_side_(error.independent()), of_faces_(mesh.face_ids(), 0) {}

    /// The next patch: all faces whose corners, bulges or samples are looked at or changed.
    void add(const std::vector<std::int32_t>& faces);
    /// Calls body(i) once for each patch that was added, the i-th.
    void run(const Task& task, const std::function<void(std::size_t)>& body) const;

  private:
    bool side_by_side_;
    std::size_t size_ = 0;
    std::vector<std::size_t> of_faces_;             // levels that end at the face
    std::vector<std::vector<std::size_t>> levels_;  // patches without a common face
};

}  // namespace pfgeom
