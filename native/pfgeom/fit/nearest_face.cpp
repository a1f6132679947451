#include "pfgeom/fit/nearest_face.h"

#include "pfgeom/fit/foot_point.h"
#include "pfgeom/mesh/bvh.h"

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

// A foot point whose weights are all above this is inside its face.
constexpr double kInside = 1e-3;

double least(const Vec3& w) {
    return std::min({w.x, w.y, w.z});
}

}  // namespace

NearestFace::NearestFace(const Patch& patch, double near) : patch_(patch), near_squared_(near * near) {
    rows_.reserve(patch.triangles.size());
    for (std::size_t i = 0; i < patch.triangles.size(); ++i) {
        const auto& [a, b, c] = patch.triangles[i];
        Row row;
        row.centre = (a + b + c) / 3;
        // 4 (uv |b0| + vw |b1| + wu |b2|) is no more than 4/3 of the largest.
        if (patch.curved()) {
            const auto& bulges = patch.bulges[i];
            row.bend = 4.0 / 3 *
                       std::sqrt(std::max(
                           {squared_norm(bulges[0]), squared_norm(bulges[1]), squared_norm(bulges[2])}));
        }
        row.radius = std::sqrt(std::max({squared_norm(a - row.centre), squared_norm(b - row.centre),
                                         squared_norm(c - row.centre)})) +
                     row.bend;
        const Vec3 normal = cross(b - a, c - a);
        const double area = squared_norm(normal);
        if (area > 0) {
            row.first = cross(c - a, normal) / area;
            row.second = cross(normal, b - a) / area;
            row.first_offset = dot(a, row.first);
            row.second_offset = dot(a, row.second);
        }
        rows_.push_back(row);
    }
}

std::size_t NearestFace::row_of(std::int32_t f) const {
    return static_cast<std::size_t>(std::find(patch_.after.begin(), patch_.after.end(), f) -
                                    patch_.after.begin());
}

// Most often it is the one.
NearestFace::Above NearestFace::face_below(const Vec3& p, std::size_t likely) const {
    Above best;
    const std::size_t n = rows_.size();
    for (std::size_t i = 0, row = likely < n ? likely : 0; i < n && best.inside < 0; ++i) {
        const Row& r = rows_[row];
        const double v = dot(p, r.first) - r.first_offset, w = dot(p, r.second) - r.second_offset;
        const double inside = std::min({1 - v - w, v, w});
        if (inside > best.inside) best = {row, {1 - v - w, v, w}, inside};
        if (++row == n) row = 0;
    }
    return best;
}

NearestFace::Found NearestFace::flat(const Vec3& p, std::size_t likely, double good_enough) const {
    const Above above = face_below(p, likely);
    if (above.inside > kInside) {
        const auto& [a, b, c] = patch_.triangles[above.row];
        const Vec3 foot = a * above.weights.x + b * above.weights.y + c * above.weights.z;
        const double squared = squared_norm(p - foot);
        if (squared <= std::max(near_squared_, good_enough)) return {above.row, foot, squared, {}};
    }
    Found best;
    const std::size_t n = rows_.size();
    for (std::size_t i = 0, row = above.row; i < n && best.squared > good_enough; ++i) {
        const double reach = std::sqrt(best.squared) + rows_[row].radius;
        if (squared_norm(p - rows_[row].centre) < reach * reach) {
            const auto& t = patch_.triangles[row];
            const Vec3 q = closest_point_on_triangle(p, t[0], t[1], t[2]);
            const double squared = squared_norm(p - q);
            if (squared < best.squared) best = {row, q, squared, {}};
        }
        if (++row == n) row = 0;
    }
    return best;
}

NearestFace::Found NearestFace::curved(const Vec3& p, std::size_t likely, double good_enough) const {
    const Above above = face_below(p, likely);
    Found best;
    const auto look_at = [&](std::size_t row, const Vec3& from) {
        const FootPoint foot = foot_point(p, patch_.surface(row), from, good_enough);
        if (foot.squared < best.squared) best = {row, foot.point, foot.squared, foot.weights};
    };
    look_at(above.row, above.inside >= 0 ? above.weights : closest_weights(p, patch_.triangles[above.row]));
    if (best.squared <= good_enough) return best;
    if (best.squared <= near_squared_ && least(best.weights) > kInside) return best;
    for (std::size_t row = 0; row < rows_.size() && best.squared > good_enough; ++row) {
        if (row == above.row) continue;
        const double apart = squared_norm(p - rows_[row].centre),
                     reach = std::sqrt(best.squared) + rows_[row].radius;
        if (apart >= reach * reach) continue;
        const auto& t = patch_.triangles[row];
        const Vec3 from = closest_weights(p, t);
        const double close = std::sqrt(best.squared) + rows_[row].bend;
        if (squared_norm(p - (t[0] * from.x + t[1] * from.y + t[2] * from.z)) >= close * close) continue;
        look_at(row, from);
    }
    return best;
}

NearestFace::Found NearestFace::operator()(const Vec3& p, std::size_t likely, double good_enough) const {
    return patch_.curved() ? curved(p, likely, good_enough) : flat(p, likely, good_enough);
}

}  // namespace pfgeom
