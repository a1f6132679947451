#include "pfgeom/eval/cell_quadric.h"

#include <cmath>

namespace pfgeom {
namespace {

// Range of a x² + g x on [-1,1]: the ends, and the vertex at -g/2a when it lies inside.
Interval parabola_range(double a, double g) {
    Interval r{std::min(a - g, a + g), std::max(a - g, a + g)};
    if (std::abs(g) <= 2 * std::abs(a) && a != 0) {
        const double vertex = -(g * g) / (4 * a);
        r = {std::min(r.lo, vertex), std::max(r.hi, vertex)};
    }
    return r;
}

double magnitude(const Quadric& q) {
    double sum = 0;
    for (const double c : q.c) sum += std::abs(c);
    return sum;
}

}  // namespace

Quadric child_quadric(const Quadric& q, int i, int j, int k) {
    const auto& [A, B, C, D, E, F, G, H, I, K] = q.c;
    const double g = G / 2 + i * A / 2 + j * D / 4 + k * E / 4;
    const double h = H / 2 + i * D / 4 + j * B / 2 + k * F / 4;
    const double l = I / 2 + i * E / 4 + j * F / 4 + k * C / 2;
    const double k1 = K + (i * G + j * H + k * I) / 4;
    const double k2 = k1 + (i * g + j * h + k * l) / 2;
    return {{A / 4, B / 4, C / 4, D / 4, E / 4, F / 4, g, h, l, k2}};
}

Quadric in_frame_of(const Quadric& q, const Box& box) {
    const Vec3 c = box.centre(), h = box.extent() * 0.5, g = q.gradient(c);
    return {{q.c[0] * h.x * h.x, q.c[1] * h.y * h.y, q.c[2] * h.z * h.z, q.c[3] * h.x * h.y,
             q.c[4] * h.x * h.z, q.c[5] * h.y * h.z, g.x * h.x, g.y * h.y, g.z * h.z, q.value(c)}};
}

int classify_cell(const Quadric& q) {
    const double k = std::abs(q.c[9]);
    if (k > (magnitude(q) - k) * (1 + 1e-14)) return q.c[9] > 0 ? 1 : -1;
    return 0;
}

Interval cell_range(const Quadric& q) {
    const Interval x = parabola_range(q.c[0], q.c[6]), y = parabola_range(q.c[1], q.c[7]),
                   z = parabola_range(q.c[2], q.c[8]);
    const double mixed = std::abs(q.c[3]) + std::abs(q.c[4]) + std::abs(q.c[5]);
    const double slack = 1e-13 * magnitude(q);
    return {x.lo + y.lo + z.lo + q.c[9] - mixed - slack, x.hi + y.hi + z.hi + q.c[9] + mixed + slack};
}

}  // namespace pfgeom
