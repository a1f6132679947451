#include "pfgeom/polygonize/label_surface.h"

#include "pfgeom/polygonize/lattice.h"

#include <bit>
#include <cstdint>

namespace pfgeom {
namespace {

constexpr int kSteps = 8;  // of Newton; two are the rule
constexpr std::size_t kKnown = 1 << 16;

std::size_t slot_of(std::int32_t question, const Vec3& p) {
    std::uint64_t key = static_cast<std::uint64_t>(question);
    for (const double c : {p.x, p.y, p.z}) key = hash_key(key ^ std::bit_cast<std::uint64_t>(c));
    return key & (kKnown - 1);
}

}  // namespace

Jet LabelSurface::jet(Label label, const Vec3& p) const {
    const std::int32_t question = label / 2;
    if (solid_.is_quadric(question))
        return {solid_.quadric(question).value(p), solid_.quadric(question).gradient(p)};
    if (known_.empty()) known_.resize(kKnown);
    Known& known = known_[slot_of(question, p)];
    if (known.question != question || !(known.p == p)) {
        known = {question, p, {}};
        known.jet.value = solid_.value(question, p, known.jet.gradient);
    }
    return known.jet;
}

// Newton's step for all the labels, by Gram and Schmidt: the shortest that solves the linearised equations.
Vec3 LabelSurface::step(std::span<const Label> labels, const Vec3& p, double least_sine) const {
    std::array<Vec3, 3> basis;
    std::size_t n = 0;
    Vec3 d;
    for (const Label label : labels) {
        const auto [value, gradient] = jet(label, p);
        const double slope = norm(gradient);
        const Vec3 g = gradient / slope;
        Vec3 u = g;
        for (std::size_t i = 0; i < n; ++i) u -= basis[i] * dot(u, basis[i]);
        const double sine = norm(u);
        if (!(sine > least_sine)) continue;
        u = u / sine;
        d -= u * ((value / slope + dot(g, d)) / sine);
        basis[n++] = u;
        if (n == 3) break;
    }
    return d;
}

bool LabelSurface::project(std::span<const Label> labels, double reach, double accuracy, Vec3& p,
                           double least_sine) const {
    Vec3 at = p;
    for (int i = 0; i < kSteps; ++i) {
        const Vec3 d = step(labels, at, least_sine);
        at += d;
        if (!(squared_norm(at - p) <= reach * reach)) return false;
        if (squared_norm(d) > accuracy * accuracy) continue;
        p = at;
        return true;
    }
    return false;
}

}  // namespace pfgeom
