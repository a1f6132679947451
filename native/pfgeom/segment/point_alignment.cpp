// Source: Horn, "Closed-form solution of absolute orientation using unit quaternions", Journal of the Optical
// Society of America A 4(4), 1987. The eigenvector by Jacobi's rotations, as in function/principal_axes.cpp.
#include "pfgeom/segment/point_alignment.h"

#include <array>
#include <cmath>

namespace pfgeom {
namespace {

using Matrix4 = std::array<std::array<double, 4>, 4>;

Vec3 mean_of(std::span<const Vec3> points) {
    Vec3 sum;
    for (const Vec3& p : points) sum += p - points[0];
    return points[0] + sum / static_cast<double>(points.size());
}

// Makes m[p][q] zero; the columns of `axes` turn along.
void rotate(Matrix4& m, Matrix4& axes, std::size_t p, std::size_t q) {
    if (m[p][q] == 0) return;
    const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
    const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(1 + theta * theta));
    const double c = 1 / std::sqrt(1 + t * t), s = t * c;
    const auto turn = [c, s](double& a, double& b) {
        const double old = a;
        a = c * old - s * b;
        b = s * old + c * b;
    };
    for (std::size_t i = 0; i < 4; ++i) turn(m[i][p], m[i][q]);
    for (std::size_t i = 0; i < 4; ++i) turn(m[p][i], m[q][i]);
    m[p][q] = m[q][p] = 0;
    for (std::size_t i = 0; i < 4; ++i) turn(axes[i][p], axes[i][q]);
}

// Of the largest eigenvalue, of length 1.
std::array<double, 4> largest_eigenvector(Matrix4 m) {
    constexpr int kSweeps = 12;  // it takes 4 to 6
    Matrix4 axes{};
    for (std::size_t i = 0; i < 4; ++i) axes[i][i] = 1;
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        for (std::size_t p = 0; p < 3; ++p) {
            for (std::size_t q = p + 1; q < 4; ++q) rotate(m, axes, p, q);
        }
    }
    std::size_t best = 0;
    for (std::size_t i = 1; i < 4; ++i) {
        if (m[i][i] > m[best][best]) best = i;
    }
    return {axes[0][best], axes[1][best], axes[2][best], axes[3][best]};
}

// The matrix whose largest eigenvector is the turn, from s = Σ from toᵀ.
Matrix4 matrix_of(const std::array<Vec3, 3>& s) {
    const double xx = s[0].x, xy = s[0].y, xz = s[0].z, yx = s[1].x, yy = s[1].y, yz = s[1].z;
    const double zx = s[2].x, zy = s[2].y, zz = s[2].z;
    return {{{xx + yy + zz, yz - zy, zx - xz, xy - yx},
             {yz - zy, xx - yy - zz, xy + yx, zx + xz},
             {zx - xz, xy + yx, yy - xx - zz, yz + zy},
             {xy - yx, zx + xz, yz + zy, zz - xx - yy}}};
}

}  // namespace

Similarity align_points(std::span<const Vec3> from, std::span<const Vec3> to, bool mirrored, bool rigid) {
    const Vec3 middle = mean_of(from), goal = mean_of(to);
    std::array<Vec3, 3> products{};
    double size = 0, goal_size = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        const Vec3 a = mirrored ? middle - from[i] : from[i] - middle, b = to[i] - goal;
        for (int k = 0; k < 3; ++k) products[static_cast<std::size_t>(k)] += a[k] * b;
        size += squared_norm(a);
        goal_size += squared_norm(b);
    }
    Similarity s;
    s.rows = rotation_of(largest_eigenvector(matrix_of(products)));
    if (mirrored) {  // a turn after the reflection in the middle
        for (Vec3& row : s.rows) row = -row;
    }
    if (!rigid && size > 0 && goal_size > 0) s.scale = std::sqrt(goal_size / size);
    s.translation = goal - s.apply(middle);
    return s;
}

}  // namespace pfgeom
