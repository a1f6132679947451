// Source: Jacobi, "Über ein leichtes Verfahren, die in der Theorie der Säcularstörungen vorkommenden
// Gleichungen numerisch aufzulösen", Journal für die reine und angewandte Mathematik 30, 1846: cyclic
// rotations, which need no more than a square root and find small eigenvalues as exactly as large ones.
#include "pfgeom/function/principal_axes.h"

namespace pfgeom {
namespace {

constexpr int kMostSweeps = 30;  // it takes 4 to 6

using Matrix3 = std::array<Vec3, 3>;

// Makes m[p][q] zero and turns the axes along.
void rotate(Matrix3& m, std::array<Vec3, 3>& axes, int p, int q) {
    auto at = [&m](int i, int j) -> double& { return m[static_cast<std::size_t>(i)][j]; };
    const double theta = (at(q, q) - at(p, p)) / (2 * at(p, q));
    const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(1 + theta * theta));
    const double c = 1 / std::sqrt(1 + t * t), s = t * c, moved = t * at(p, q);
    at(p, p) -= moved;
    at(q, q) += moved;
    at(p, q) = at(q, p) = 0;
    const int r = 3 - p - q;
    const double rp = at(r, p), rq = at(r, q);
    at(r, p) = at(p, r) = c * rp - s * rq;
    at(r, q) = at(q, r) = s * rp + c * rq;
    Vec3& a = axes[static_cast<std::size_t>(p)];
    Vec3& b = axes[static_cast<std::size_t>(q)];
    const Vec3 old = a;
    a = c * old - s * b;
    b = s * old + c * b;
}

}  // namespace

PrincipalAxes principal_axes(const std::array<Vec3, 3>& rows) {
    Matrix3 m = rows;
    m[1].x = m[0].y;
    m[2].x = m[0].z;
    m[2].y = m[1].z;
    PrincipalAxes result{{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {}};
    for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
        const double off = std::abs(m[0].y) + std::abs(m[0].z) + std::abs(m[1].z);
        const double on = std::abs(m[0].x) + std::abs(m[1].y) + std::abs(m[2].z);
        if (!(off > 1e-18 * on)) break;
        for (const auto& [p, q] : {std::array{0, 1}, std::array{0, 2}, std::array{1, 2}}) {
            if (m[static_cast<std::size_t>(p)][q] != 0) rotate(m, result.axes, p, q);
        }
    }
    result.axes[2] = cross(result.axes[0], result.axes[1]);
    result.values = {m[0].x, m[1].y, m[2].z};
    return result;
}

}  // namespace pfgeom
