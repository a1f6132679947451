// In coordinates where the ellipsoid is the unit sphere, take a ray from the centre, and a point x of it that
// the two surfaces disagree about, say inside the sphere alone. The mesh winds once around the centre, so
// between there and x the ray crosses a face, at y and at the distance t from the centre: x is between y and
// the sphere. Outside the sphere it is the same on the way to infinity, around which the mesh does not wind.
// So whatever is wrong is within |1 - t| of y on its ray, and so are the sphere's points, next to which
// something is wrong or which the mesh crosses; as things were, within |y - centre| |1 - t| / t. Over a face
// t lies between the distance of the face and that of its farthest corner.
#include "pfgeom/report/ellipsoid_bound.h"

#include "pfgeom/base/cholesky.h"
#include "pfgeom/mesh/edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace pfgeom {
namespace {

// What is lost to rounding: more than 1e4 times what doubles about one lose here.
constexpr double kRounding = 1e-10;
// Of the winding number of a closed mesh, which is whole.
constexpr double kWhole = 1e-6;

// Maps an ellipsoid to the unit sphere: rows of an upper triangular matrix, after taking off the centre.
struct ToSphere {
    Vec3 centre;
    std::array<Vec3, 3> rows;
    Vec3 operator()(const Vec3& p) const {
        const Vec3 d = p - centre;
        return {dot(rows[0], d), dot(rows[1], d), dot(rows[2], d)};
    }
};

// Squares and products are factorised with the sign that makes them positive. The gradient vanishes at the
// centre: twice their matrix times it is (G, H, I).
std::optional<ToSphere> to_sphere(const Quadric& q) {
    const auto& c = q.c;
    Matrix10 squares{};
    squares[0] = {-c[0]};
    squares[1] = {-c[3] / 2, -c[1]};
    squares[2] = {-c[4] / 2, -c[5] / 2, -c[2]};
    const Matrix10 f = factorise(squares, 3);
    if (!(f[0][0] > 0 && f[1][1] > 0 && f[2][2] > 0)) return {};
    const Vector10 centre = solve_factorised(f, {c[6] / 2, c[7] / 2, c[8] / 2}, 3);
    ToSphere map{{centre[0], centre[1], centre[2]}, {}};
    const double height = q.value(map.centre);
    if (!(height > 0)) return {};
    const Vec3 sizes{std::sqrt(f[0][0] / height), std::sqrt(f[1][1] / height), std::sqrt(f[2][2] / height)};
    map.rows = {Vec3{1, f[1][0], f[2][0]} * sizes.x, Vec3{0, 1, f[2][1]} * sizes.y, Vec3{0, 0, sizes.z}};
    return map;
}

bool is_closed(const TriangleMesh& mesh) {
    bool closed = true;
    EdgeTable(mesh.faces, mesh.vertices.size()).for_each([&](std::span<const EdgeUse> uses) {
        std::ptrdiff_t balance = 0;
        for (const EdgeUse& use : uses) balance += use.forward ? 1 : -1;
        closed = closed && balance == 0;
    });
    return closed;
}

}  // namespace

std::optional<double> bound_ellipsoid(const Quadric& quadric, const TriangleMesh& mesh, const Bvh& bvh) {
    const std::optional<ToSphere> map = to_sphere(quadric);
    if (!map || !is_closed(mesh)) return {};
    const double turns = std::abs(bvh.winding_number(map->centre, Box::kInf));
    if (!(std::abs(turns - 1) < kWhole)) return {};
    std::vector<Vec3> on_sphere;
    std::vector<double> radius, height;  // of the vertices, before and on the sphere
    for (const Vec3& p : mesh.vertices) {
        on_sphere.push_back((*map)(p));
        radius.push_back(norm(p - map->centre));
        height.push_back(norm(on_sphere.back()));
    }
    double bound = 0;
    for (const Triangle& face : mesh.faces) {
        std::array<Vec3, 3> t;
        double far = 0, most = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto v = static_cast<std::size_t>(face[k]);
            t[k] = on_sphere[v];
            far = std::max(far, radius[v]);
            most = std::max(most, height[v]);
        }
        const double least = norm(closest_point_on_triangle({}, t[0], t[1], t[2])) - kRounding;
        if (!(least > 0)) return {};
        bound = std::max({bound, far * (1 - least) / least, far * (most - 1) / most});
    }
    return bound * (1 + kRounding) + kRounding;
}

}  // namespace pfgeom
