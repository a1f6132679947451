// What the queries of the hierarchy share: its depth bound, and their stack.
#pragma once

#include "pfgeom/mesh/bvh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace pfgeom {

/// Depth (in halvings) below which ranges are halved by count. Binned halving of real meshes stays below 40.
constexpr int kBvhBinnedDepth = 48;
/// 31 more halvings separate 2^31 triangles; a node leaves at most three siblings on the stack.
constexpr int kBvhStackSize = 3 * (kBvhBinnedDepth + 31) + 4;

/// Children still to be visited, the nearest on top.
class BvhStack {
  public:
    struct Entry {
        double distance;  // in the query's own measure
        std::int32_t first, count;
    };
    bool empty() const { return size_ == 0; }
    void push(const Entry& entry) { entries_[size_++] = entry; }
    Entry pop() { return entries_[--size_]; }

    /// Pushes the children of `node` whose distance is at most `limit`, the farthest first.
    void push_sorted(const BvhNode& node, const std::array<double, 4>& distance, double limit) {
        const int bottom = size_;
        for (int k = 0; k < 4; ++k) {
            if (!(distance[k] <= limit)) continue;
            int at = size_++;
            for (; at > bottom && entries_[at - 1].distance < distance[k]; --at)
                entries_[at] = entries_[at - 1];
            entries_[at] = {distance[k], node.first[k], node.count[k]};
        }
    }

  private:
    std::array<Entry, kBvhStackSize> entries_;
    int size_ = 0;
};

/// Dipoles of all children of all nodes, for the winding number.
std::vector<std::array<BvhDipole, 4>> bvh_dipoles(const std::vector<BvhNode>& nodes,
                                                  const std::vector<Vec3>& corners);

}  // namespace pfgeom
