#include "pfgeom/fit/patch_loop.h"

#include "pfgeom/base/parallel.h"

#include <algorithm>

namespace pfgeom {

// A patch's level is the first above those of all earlier ones with a face in common.
void PatchLoop::add(const std::vector<std::int32_t>& faces) {
    std::size_t level = side_by_side_ ? 0 : levels_.size();
    for (const std::int32_t f : faces) level = std::max(level, of_faces_[static_cast<std::size_t>(f)]);
    for (const std::int32_t f : faces) of_faces_[static_cast<std::size_t>(f)] = level + 1;
    if (level == levels_.size()) levels_.emplace_back();
    levels_[level].push_back(size_++);
}

void PatchLoop::run(const Task& task, const std::function<void(std::size_t)>& body) const {
    for (const std::vector<std::size_t>& level : levels_) {
        parallel_chunks(level.size(), 1, task, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) body(level[i]);
        });
    }
}

}  // namespace pfgeom
