#include "pfgeom/segment/natural_axes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace pfgeom {
namespace {

// Normals that face the same way: those of a file of single precision differ by 1e-4 on small faces.
constexpr double kAlong = 1 - 1e-6;
// Perpendicular to the first: as exact.
constexpr double kAcross = 2e-3;
constexpr std::size_t kTried = 128;  // faces, spread over the area
// Of the area, what makes a direction. A scan has less.
constexpr double kLeastArea = 0.02;
// What the identity may have less.
constexpr double kAsGood = 0.99;

struct Facing {
    Vec3 normal;
    double area = 0;
};

class AxisFinder {
  public:
    explicit AxisFinder(const TriangleMesh& mesh) {
        for (const Triangle& t : mesh.faces) {
            const Vec3& a = mesh.vertices[t[0]];
            const Vec3 n = cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a);
            faces_.push_back({normalized(n), norm(n) / 2});
            area_ += faces_.back().area;
        }
    }

    std::array<Vec3, 3> run() const {
        constexpr std::array<Vec3, 3> kIdentity{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
        const std::optional<Vec3> z = best_direction({});
        if (!z) return kIdentity;
        const Vec3 x = normalized(across(best_direction(*z).value_or(any_across(*z)), *z));
        const std::array<Vec3, 3> axes{x, cross(*z, x), *z};
        return area_along(kIdentity) >= kAsGood * area_along(axes) ? kIdentity : axes;
    }

  private:
    static bool is_along(const Facing& face, const Vec3& axis) {
        return std::abs(dot(face.normal, axis)) > kAlong;
    }
    static Vec3 across(const Vec3& v, const Vec3& axis) { return v - dot(v, axis) * axis; }
    static Vec3 any_across(const Vec3& axis) {
        return std::abs(axis.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    }

    double area_along(const Vec3& axis) const {
        double sum = 0;
        for (const Facing& face : faces_) sum += is_along(face, axis) ? face.area : 0;
        return sum;
    }
    double area_along(const std::array<Vec3, 3>& axes) const {
        return area_along(axes[0]) + area_along(axes[1]) + area_along(axes[2]);
    }

    // Of the directions across `beside` (of all, if it is zero) the one that most area faces, or its
    // opposite.
    std::optional<Vec3> best_direction(const Vec3& beside) const {
        std::optional<Vec3> best;
        double most = kLeastArea * area_;
        double passed = 0;
        std::size_t tried = 0;
        for (const Facing& face : faces_) {
            passed += face.area;
            if (passed * kTried < static_cast<double>(tried) * area_) continue;
            while (passed * kTried >= static_cast<double>(tried) * area_) ++tried;
            if (std::abs(dot(face.normal, beside)) > kAcross) continue;
            const double area = area_along(face.normal);
            if (area > most * (1 + 1e-9)) most = area, best = face.normal;
        }
        return best ? std::optional(mean_along(*best)) : best;
    }

    Vec3 mean_along(const Vec3& axis) const {
        Vec3 sum;
        for (const Facing& face : faces_) {
            if (is_along(face, axis))
                sum += (dot(face.normal, axis) < 0 ? -face.area : face.area) * face.normal;
        }
        return normalized(sum);
    }

    std::vector<Facing> faces_;
    double area_ = 0;
};

}  // namespace

std::array<Vec3, 3> natural_axes(const TriangleMesh& mesh) {
    return AxisFinder(mesh).run();
}

}  // namespace pfgeom
