// Tangents of a pruned function by Taylor's theorem, up to the second or the third derivative, whichever says
// more: balls are smooth everywhere. On igea's hierarchy in a grid of 1024³ the third one leaves a fifth
// fewer cells to look at.
#include "pfgeom/eval/pruned_function.h"

#include <algorithm>

namespace pfgeom {

std::array<Pair, 6> PrunedFunction::bends_of(const Vec3& a, const Vec3& b) const {
    const Pair x{a.x, b.x}, y{a.y, b.y}, z{a.z, b.z};
    Pair all{}, xx{}, yy{}, zz{}, xy{}, xz{}, yz{};
    const Ball* ball = balls_.data();
    for (const Part& part : parts_) {
        const double i = part.inverse_squared;
        for (const Ball* end = balls_.data() + part.end; ball != end; ++ball) {
            const Pair dx = x - ball->centre.x, dy = y - ball->centre.y, dz = z - ball->centre.z;
            const Pair q = positive(1.0 - ((dx * dx + dy * dy) + dz * dz) * i);
            const Pair fq = ball->factor * q, t = (24 * i * i) * fq;  // f q³ has 24 i² f q d dᵀ - 6 i f q² I
            all += (-6 * i) * fq * q;
            xx += t * dx * dx;
            yy += t * dy * dy;
            zz += t * dz * dz;
            xy += t * dx * dy;
            xz += t * dx * dz;
            yz += t * dy * dz;
        }
    }
    const auto& c = whole_.base().c;
    return {xx + all + 2 * c[0], yy + all + 2 * c[1], zz + all + 2 * c[2], xy + c[3], xz + c[4], yz + c[5]};
}

// How far the function is from its tangents at the centres of two boxes.
std::array<double, 2> PrunedFunction::errors_of(const Box& a, const Box& b) const {
    const std::array<Pair, 6> bends = bends_of(a.centre(), b.centre());
    std::array<double, 2> errors{};
    for (std::size_t i = 0; i < 2; ++i) {
        const Vec3 h = (i == 0 ? a : b).extent() * 0.5;
        const auto at = [&](std::size_t k) { return std::abs(bends[k][i]); };
        const double here = (at(0) * h.x * h.x + at(1) * h.y * h.y + at(2) * h.z * h.z) / 2 +
                            (at(3) * h.x * h.y + at(4) * h.x * h.z + at(5) * h.y * h.z);
        const double reach = squared_norm(h);
        errors[i] = std::min(bend_ * reach / 2, here + twist_ * reach * std::sqrt(reach) / 6);
    }
    return errors;
}

bool PrunedFunction::smooth_in(const Box& box) const {
    return box_.contains(box.lo) && box_.contains(box.hi) && perturbations_.empty();
}

Tangent PrunedFunction::tangent(const Box& box) const {
    if (!smooth_in(box)) return whole_.tangent(box);
    Tangent result;
    tangents({&box, 1}, {&result, 1});
    return result;
}

void PrunedFunction::tangents(std::span<const Box> boxes, std::span<Tangent> tangents) const {
    for (std::size_t i = 0; i < boxes.size(); i += 2) {
        const std::size_t j = std::min(i + 1, boxes.size() - 1);
        if (!smooth_in(boxes[i]) || !smooth_in(boxes[j])) {
            for (const std::size_t k : {i, j}) tangents[k] = tangent(boxes[k]);
            continue;
        }
        const std::array jets = jets_of(boxes[i].centre(), boxes[j].centre());
        const std::array errors = errors_of(boxes[i], boxes[j]);
        tangents[i] = tangent_of(jets[0], errors[0], boxes[i].extent() * 0.5);
        tangents[j] = tangent_of(jets[1], errors[1], boxes[j].extent() * 0.5);
    }
}

}  // namespace pfgeom
