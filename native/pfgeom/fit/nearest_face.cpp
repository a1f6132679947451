#include "pfgeom/fit/nearest_face.h"

#include "pfgeom/fit/foot_point.h"
#include "pfgeom/mesh/bvh.h"

#include <algorithm>
#include <cmath>

namespace pfgeom {

NearestFace::NearestFace(const Patch& patch) : patch_(patch) {
    for (std::size_t row = 0; row < patch.bulges.size(); ++row) {
        const auto& [a, b, c] = patch.triangles[row];
        const Vec3 centre = (a + b + c) / 3;
        const double reach =
            std::max({squared_norm(a - centre), squared_norm(b - centre), squared_norm(c - centre)});
        // 4 (uv |b0| + vw |b1| + wu |b2|) is no more than 4/3 of the largest.
        const auto& bulges = patch.bulges[row];
        const double bend =
            std::max({squared_norm(bulges[0]), squared_norm(bulges[1]), squared_norm(bulges[2])});
        balls_.push_back({centre, std::sqrt(reach) + 4.0 / 3 * std::sqrt(bend)});
    }
}

std::size_t NearestFace::row_of(std::int32_t f) const {
    return static_cast<std::size_t>(std::find(patch_.after.begin(), patch_.after.end(), f) -
                                    patch_.after.begin());
}

void NearestFace::look_at(std::size_t row, const Vec3& p, Found& best) const {
    if (balls_.empty()) {
        const auto& t = patch_.triangles[row];
        const Vec3 q = closest_point_on_triangle(p, t[0], t[1], t[2]);
        const double squared = squared_norm(p - q);
        if (squared < best.squared) best = {row, q, squared, {}};
        return;
    }
    const double apart = squared_norm(p - balls_[row].centre),
                 reach = std::sqrt(best.squared) + balls_[row].radius;
    if (apart >= reach * reach) return;
    const FootPoint foot = foot_point(p, patch_.surface(row));
    if (foot.squared < best.squared) best = {row, foot.point, foot.squared, foot.weights};
}

NearestFace::Found NearestFace::operator()(const Vec3& p, std::size_t likely, double good_enough) const {
    Found best;
    const std::size_t n = patch_.triangles.size();
    for (std::size_t i = 0, row = likely < n ? likely : 0; i < n && best.squared > good_enough; ++i) {
        look_at(row, p, best);
        if (++row == n) row = 0;
    }
    return best;
}

}  // namespace pfgeom
