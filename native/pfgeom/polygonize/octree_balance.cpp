#include "pfgeom/base/sort_unique.h"
#include "pfgeom/polygonize/octree.h"

namespace pfgeom {

// Neighbouring cells that the surface crosses differ by at most one level (better shapes; the mesh would be
// closed without it).
void Octree::balance() {
    for (int depth = deepest_ - 1; depth > options_.min_depth; --depth) {
        for (;;) {
            std::vector<std::int32_t> coarse;
            for (std::size_t i = 0; i < nodes_.size(); ++i) {
                if (i % 1024 == 0) task_.check();
                if (nodes_[i].depth == depth && !nodes_[i].leaf()) add_coarse_neighbours(nodes_[i], coarse);
            }
            sort_unique(coarse);
            if (coarse.empty()) break;
            sample_corners(split(coarse));
        }
    }
}

// Leaves beside `parent` that are larger than it, where its children carry surface.
void Octree::add_coarse_neighbours(const OctreeNode& parent, std::vector<std::int32_t>& coarse) const {
    bool surface = false;
    for (int k = 0; k < 8; ++k) surface |= nodes_[parent.children + k].mixed();
    if (!surface) return;
    const std::int32_t size = size_at(parent.depth);
    for (int k = 0; k < 27; ++k) {
        const LatticePoint beside = {parent.corner[0] + (k % 3 - 1) * size,
                                     parent.corner[1] + (k / 3 % 3 - 1) * size,
                                     parent.corner[2] + (k / 9 - 1) * size};
        if (!contains(beside)) continue;
        const std::int32_t other = find(beside, parent.depth);
        if (nodes_[other].depth < parent.depth && nodes_[other].mixed()) coarse.push_back(other);
    }
}

}  // namespace pfgeom
