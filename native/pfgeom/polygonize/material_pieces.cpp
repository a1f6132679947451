#include "pfgeom/polygonize/material_pieces.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace pfgeom {
namespace {

struct Piece {
    std::vector<Vec3> polygon;
    std::int32_t material = 0;
    double area = 0;
};

class Spans {
  public:
    Spans(const MaterialTree& tree, const Vec3& a, const Vec3& b) : tree_(tree), a_(a), b_(b) {
        walk(0, 0, 1);
    }
    std::vector<double> changes;

  private:
    // Recursion as deep as the tree, at most kMaxMaterialDepth.
    void walk(std::int32_t index, double from, double to) {
        const MaterialNode& node = tree_.nodes[static_cast<std::size_t>(index)];
        if (node.leaf()) {
            if (before_ >= 0 && before_ != node.material) changes.push_back(from);
            before_ = node.material;
            return;
        }
        const double at_a = dot(node.normal, a_) - node.level, at_b = dot(node.normal, b_) - node.level;
        const double first = at_a + from * (at_b - at_a), last = at_a + to * (at_b - at_a);
        const std::int32_t near = first >= 0 ? node.high : node.low, far = first >= 0 ? node.low : node.high;
        if ((first >= 0) == (last >= 0)) return walk(near, from, to);
        const double middle = std::clamp(at_a / (at_a - at_b), from, to);
        walk(near, from, middle);
        walk(far, middle, to);
    }

    const MaterialTree& tree_;
    const Vec3 &a_, &b_;
    std::int32_t before_ = -1;
};

double area_of(const std::vector<Vec3>& polygon) {
    Vec3 sum;
    for (std::size_t i = 2; i < polygon.size(); ++i)
        sum += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
    return norm(sum);
}

// The part of a convex polygon on one side of a plane.
std::vector<Vec3> part_of_polygon(const std::vector<Vec3>& polygon, const MaterialNode& plane, bool high) {
    std::vector<Vec3> part;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const double at_p = dot(plane.normal, p) - plane.level, at_q = dot(plane.normal, q) - plane.level;
        const bool p_high = at_p >= 0, q_high = at_q >= 0;
        if (p_high == high) part.push_back(p);
        if (p_high != q_high) part.push_back(p + (q - p) * (at_p / (at_p - at_q)));
    }
    return part;
}

void cut(const MaterialTree& tree, std::int32_t index, std::vector<Vec3> polygon,
         std::vector<Piece>& pieces) {
    const MaterialNode& node = tree.nodes[static_cast<std::size_t>(index)];
    if (node.leaf()) {
        const double area = area_of(polygon);
        pieces.push_back({std::move(polygon), node.material, area});
        return;
    }
    std::vector<Vec3> high = part_of_polygon(polygon, node, true),
                      low = part_of_polygon(polygon, node, false);
    if (high.size() >= 3) cut(tree, node.high, std::move(high), pieces);
    if (low.size() >= 3) cut(tree, node.low, std::move(low), pieces);
}

std::int32_t main_material(const std::vector<Piece>& pieces) {
    std::int32_t best = pieces.front().material;
    double most = -1;
    for (const Piece& piece : pieces) {
        double area = 0;
        for (const Piece& other : pieces) area += other.material == piece.material ? other.area : 0;
        if (area > most) most = area, best = piece.material;
    }
    return best;
}

// Of a point of the triangle, from its nearest side.
double depth_of(const Vec3& p, const std::array<Vec3, 3>& corners) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 &a = corners[i], side = corners[(i + 1) % 3] - a;
        least = std::min(least, squared_norm(cross(side, p - a)) / squared_norm(side));
    }
    return std::sqrt(least);
}

}  // namespace

std::vector<double> material_changes(const MaterialTree& tree, const Vec3& a, const Vec3& b) {
    return Spans(tree, a, b).changes;
}

TriangleMaterials triangle_materials(const MaterialTree& tree, const std::array<Vec3, 3>& corners) {
    TriangleMaterials result;
    std::vector<Piece> pieces;
    cut(tree, 0, {corners.begin(), corners.end()}, pieces);
    if (pieces.empty()) {  // as rounding has it, on all planes at once
        result.main = material_at(tree, corners[0]);
        return result;
    }
    result.main = main_material(pieces);
    const auto look_at = [&](const Vec3& p) {
        const double depth = depth_of(p, corners);
        if (depth > result.depth) result.depth = depth, result.deepest = p;  // false for NaN: no area
    };
    for (const Piece& piece : pieces) {
        if (piece.material == result.main) continue;
        Vec3 sum;
        for (const Vec3& p : piece.polygon) {
            look_at(p);
            sum += p;
        }
        look_at(sum / static_cast<double>(piece.polygon.size()));
    }
    return result;
}

}  // namespace pfgeom
