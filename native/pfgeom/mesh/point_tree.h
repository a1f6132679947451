// A tree over points that finds those near a segment.
#pragma once

#include "pfgeom/base/box.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pfgeom {

class PointTree {
  public:
    explicit PointTree(std::vector<Vec3> points);

    /// Rows of all points whose distance to the segment ab is at most `distance`, in no particular order.
    void near_segment(const Vec3& a, const Vec3& b, double distance, std::vector<std::int32_t>& rows) const;

  private:
    struct Node {
        Box box;
        std::int32_t begin, end;  // of order_
        std::int32_t right;       // second child; the first follows its parent; -1: a leaf
    };
    void build(std::int32_t begin, std::int32_t end);

    std::vector<Vec3> points_;
    std::vector<std::int32_t> order_;
    std::vector<Node> nodes_;
};

/// Where on ab the point nearest to p is: 0 at a, 1 at b.
double nearest_parameter(const Vec3& p, const Vec3& a, const Vec3& b);

}  // namespace pfgeom
