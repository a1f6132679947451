// Rays, watertight: triangles are projected along the ray to a plane, each corner once and for all its
// triangles, so that two triangles compute the same number for a common edge up to its sign; zero counts as a
// hit of both.
//
// Source: Woop, Benthin, Wald, "Watertight ray/triangle intersection", 2013. Departures: double precision,
// both sides of a triangle are hit, and boxes are tested with a slack in place of directed rounding.
#include "pfgeom/mesh/bvh.h"
#include "pfgeom/mesh/bvh_stack.h"

namespace pfgeom {
namespace {

// The ray's entry into each child's box; infinity where it misses the box within [t_min, t_max].
std::array<double, 4> entries(const BvhNode& node, const Vec3& origin, const Vec3& direction, double t_min,
                              double t_max) {
    std::array<double, 4> enter;
    for (int k = 0; k < 4; ++k) {
        double near = t_min, far = t_max;
        for (int axis = 0; axis < 3; ++axis) {
            const double lo = node.lo[axis][k] - origin[axis], hi = node.hi[axis][k] - origin[axis];
            if (direction[axis] == 0) {
                if (lo > 0 || hi < 0) near = Box::kInf;
                continue;
            }
            const double t0 = lo / direction[axis], t1 = hi / direction[axis];
            // By the direction and not by size, so that an unused child's empty box is left where it is
            // entered.
            near = std::max(near, direction[axis] > 0 ? t0 : t1);
            far = std::min(far, direction[axis] > 0 ? t1 : t0);
        }
        const double slack =
            1e-12 * (std::abs(near) + std::abs(far));  // far above rounding; NaN only at infinity
        enter[k] = near > far + slack ? Box::kInf : near;
    }
    return enter;
}

class ShearedRay {
  public:
    ShearedRay(const Vec3& origin, const Vec3& direction) : origin_(origin) {
        const Vec3 size = max(direction, -direction);
        z_ = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        x_ = (z_ + 1) % 3;
        y_ = (z_ + 2) % 3;
        shear_x_ = direction[x_] / direction[z_];
        shear_y_ = direction[y_] / direction[z_];
        direction_z_ = direction[z_];
    }

    // Where the ray meets the triangle, border included; NaN: nowhere.
    double meet(const Vec3* t) const {
        const Vec3 a = project(t[0]), b = project(t[1]), c = project(t[2]);
        const double u = c.x * b.y - c.y * b.x, v = a.x * c.y - a.y * c.x, w = b.x * a.y - b.y * a.x;
        const bool outside = (u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0);
        const double sum = u + v + w;
        if (outside || sum == 0) return std::numeric_limits<double>::quiet_NaN();  // 0: seen edge-on
        return (u * a.z + v * b.z + w * c.z) / (sum * direction_z_);
    }

  private:
    Vec3 project(const Vec3& p) const {
        const Vec3 q = p - origin_;
        return {q[x_] - shear_x_ * q[z_], q[y_] - shear_y_ * q[z_], q[z_]};
    }

    Vec3 origin_;
    int x_, y_, z_;
    double shear_x_, shear_y_, direction_z_;
};

}  // namespace

RayHit Bvh::first_hit(const Vec3& origin, const Vec3& direction, double t_min, double t_max) const {
    RayHit best{-1, t_max};
    if (nodes_.empty()) return best;
    const ShearedRay ray(origin, direction);
    BvhStack stack;
    stack.push({t_min, 0, 0});
    while (!stack.empty()) {
        const BvhStack::Entry entry = stack.pop();
        for (std::int32_t i = entry.first; i < entry.first + entry.count; ++i) {
            const double t = ray.meet(&corners_[3 * static_cast<std::size_t>(i)]);
            if (!(t >= t_min && t <= best.t)) continue;
            // Of equal ones the lowest face; as unsigned numbers, "none" (-1) is the highest.
            const bool lower = static_cast<std::uint32_t>(faces_[i]) < static_cast<std::uint32_t>(best.face);
            if (t < best.t || lower) best = {faces_[i], t};
        }
        if (entry.count > 0) continue;
        const BvhNode& node = nodes_[entry.first];
        const double limit = std::min(best.t * (1 + 1e-9), std::numeric_limits<double>::max());
        stack.push_sorted(node, entries(node, origin, direction, t_min, limit), limit);
    }
    return best;
}

}  // namespace pfgeom
