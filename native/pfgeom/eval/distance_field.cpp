#include "pfgeom/eval/distance_field.h"

#include <cmath>

namespace pfgeom {

DistanceField::DistanceField(const TriangleMesh& mesh, const Task& task) : bvh_(mesh, task) {
    constexpr double kRounding = 1e-10;  // of the size
    const double size = bvh_.bounds().diagonal() * kRounding;
    near_ = size * size;
    double volume = 0;
    for (const auto& [i, j, k] : mesh.faces) {
        const Vec3& a = mesh.vertices[static_cast<std::size_t>(i)];
        const Vec3& b = mesh.vertices[static_cast<std::size_t>(j)];
        const Vec3& c = mesh.vertices[static_cast<std::size_t>(k)];
        const Vec3 across = cross(b - a, c - a);
        volume += dot(across, a - mesh.vertices.front());
        inwards_.push_back(-normalized(across));
    }
    if (volume >= 0) return;
    for (Vec3& normal : inwards_) normal = -normal;
}

double DistanceField::value(const Vec3& p) const {
    Vec3 gradient;
    return value_and_gradient(p, gradient);
}

double DistanceField::value_and_gradient(const Vec3& p, Vec3& gradient) const {
    const ClosestPoint c = bvh_.closest(p);
    const double d = std::sqrt(c.squared_distance);
    const bool inside = std::abs(bvh_.winding_number(p)) > 0.5;
    const Vec3 away = normalized(p - c.point);
    gradient = c.squared_distance <= near_ && c.face >= 0 ? inwards_[static_cast<std::size_t>(c.face)]
               : inside                                   ? away
                                                          : -away;
    return inside ? d : -d;
}

// A distance changes by no more than one moves.
Interval DistanceField::range(const Box& box) const {
    const double radius = box.diagonal() / 2 * (1 + 1e-9), middle = value(box.centre());
    return {middle - radius, middle + radius};
}

}  // namespace pfgeom
