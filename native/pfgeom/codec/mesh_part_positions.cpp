#include "pfgeom/codec/mesh_part_positions.h"

#include "pfgeom/codec/residual.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace pfgeom {
namespace {

// Kinds of the mixer (128..191 are the mesh part's).
enum Kind : std::uint32_t {
    kFree = 148,
    kAcross = 152,
    kSteep = 160,
    kLevel = 164,
    kOnMirror = 176
};  // each residual takes four

// The coarsest lattice, of 2^level steps, that both coordinates lie on: fitters choose coarse ones where they
// can.
constexpr int kLevels = 5;
int level_of(std::int32_t u, std::int32_t v) {
    return std::countr_zero(static_cast<std::uint32_t>(u | v) | (1U << kLevels));
}

// The plane behind a gate, with the axis that is coded last.
struct Frame2 {
    Vec3 a, along, normal,
        outward;                    // along, outward, normal: unit vectors; outward points away from the apex
    double length = 0, height = 0;  // of the gate, and of the triangle behind over it
    int steep = 2;

    Frame2(const Vec3& from, const Vec3& to, const Vec3& apex) : a(from) {
        const Vec3 edge = to - from;
        length = norm(edge);
        along = normalized(edge);
        normal = normalized(cross(from - to, apex - to));
        outward = cross(along, normal) * -1.0;
        if (dot(apex - from, outward) > 0) outward = -outward;
        height = -dot(apex - from, outward);
        const Vec3 n{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
        steep = n.x > n.y && n.x > n.z ? 0 : n.y > n.z ? 1 : 2;
    }
    bool flat() const { return squared_norm(normal) > 0; }

    // With the parabola z = bend / 2 · t (t + height), which is zero at the gate and at the apex.
    double reach(const Vec3& p) const { return std::max(dot(p - a, outward), height / 4); }
    double lever(const Vec3& p) const { return reach(p) * (reach(p) + height) / 2; }
};

Frame2 frame_at(const std::vector<GridPoint>& positions, const Gate& gate) {
    const auto at = [&](std::int32_t v) { return to_vec(positions[static_cast<std::size_t>(v)]); };
    return {at(gate.from), at(gate.to), at(gate.apex)};
}

}  // namespace

double PositionCoder::bend(const std::vector<GridPoint>& positions, const Gate& gate, const GridPoint& p) {
    const Frame2 frame = frame_at(positions, gate);
    const Vec3 x = to_vec(p);
    const double lever = frame.lever(x), reach = frame.reach(x);
    if (!(lever > 0)) return gate.bend;
    // Across a crease the bend says nothing about what comes after: heights above half the reach are cut.
    const double rise = std::clamp(dot(x - frame.a, frame.normal), -0.5 * reach, 0.5 * reach);
    return 0.5 * gate.bend + 0.5 * rise / lever;
}

int PositionCoder::code_level(int level, const std::array<int, 3>& around) {
    for (int i = 0; i < kLevels; ++i) {
        const auto coarser = std::count_if(around.begin(), around.end(), [&](int l) { return l > i; });
        const auto set = static_cast<std::uint32_t>(i), near = set * 4 + static_cast<std::uint32_t>(coarser);
        const std::array<std::uint32_t, 3> contexts{set, near,
                                                    near * 8 + static_cast<std::uint32_t>(around[0])};
        if (mixer_.code(coder_, level > i ? 1 : 0, {kLevel, set, 0}, contexts) == 0) return i;
    }
    return kLevels;
}

// Whether a vertex is on the plane of a mirrored part, by where the parallelogram's would be: from its gate
// as far as towards the plane, in eighths, and by how near the gate's ends are.
bool PositionCoder::code_on_mirror(bool on, const GridPoint& a, const GridPoint& b, const GridPoint& d) {
    const auto axis = static_cast<std::size_t>(mirror_axis_);
    const double height = 0.5 * (1.0 * a[axis] + b[axis]), rise = height - d[axis];
    const std::uint32_t ends = (a[axis] == 0 ? 1U : 0U) + (b[axis] == 0 ? 2U : 0U) + (d[axis] == 0 ? 4U : 0U);
    std::uint32_t ahead = 0;  // the plane is not ahead
    if (rise * height < 0)
        ahead = 1 + std::min(static_cast<std::uint32_t>(8 * std::min(-height / rise, 7.0)), 31U);
    const std::array<std::uint32_t, 3> contexts{ends, 16 + ahead, 64 + ends * 64 + ahead};
    return mixer_.code(coder_, on ? 1 : 0, {kOnMirror, 0, 0}, contexts) != 0;
}

bool PositionCoder::code_free(const GridPoint& before, GridPoint& p) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        p[axis] = before[axis] + code_residual(coder_, mixer_, p[axis] - before[axis], {kFree, 0, 0, 0});
        if (std::abs(p[axis]) >= kMaxCoordinate) return false;
    }
    magnitudes_.emplace_back();
    return true;
}

bool PositionCoder::code(const std::vector<GridPoint>& positions, const Gate& gate, GridPoint& p) {
    const std::size_t ids[3] = {static_cast<std::size_t>(gate.from), static_cast<std::size_t>(gate.to),
                                static_cast<std::size_t>(gate.apex)};
    const GridPoint &a = positions[ids[0]], &b = positions[ids[1]], &d = positions[ids[2]];
    const Frame2 frame = frame_at(positions, gate);
    const auto w = static_cast<std::size_t>(frame.steep), u = (w + 1) % 3, v = (w + 2) % 3;
    std::uint32_t tangential = 0, normal = 0;
    for (const std::size_t id : ids) {
        tangential += magnitudes_[id].tangential;
        normal += magnitudes_[id].normal;
    }
    tangential /= 3;
    normal /= 3;

    int flat_axis = kNoMirror;
    if (mirror_axis_ != kNoMirror && code_on_mirror(on_mirror(p, mirror_axis_), a, b, d))
        flat_axis = mirror_axis_;
    if (flat_axis != kNoMirror) p[static_cast<std::size_t>(flat_axis)] = 0;

    const std::uint32_t scale = half_octaves(std::max(frame.length, frame.height));
    const int level =
        code_level(level_of(p[u], p[v]), {level_of(a[u], a[v]), level_of(b[u], b[v]), level_of(d[u], d[v])});
    const auto in_pitches = [&](std::uint32_t octaves) {
        return octaves - std::min(octaves, 2 * static_cast<std::uint32_t>(level));
    };
    const std::int32_t pitch = 1 << level;
    std::int32_t across = 0;
    for (const std::size_t axis : {u, v}) {
        if (static_cast<int>(axis) == flat_axis) continue;
        const std::int32_t predicted = (a[axis] + b[axis] - d[axis] + pitch / 2) >> level;
        const std::uint32_t extra = axis == u ? 0 : 1 + std::min(half_octaves(across) / 2, 30U);
        const std::int32_t r = code_residual(coder_, mixer_, (p[axis] >> level) - predicted,
                                             {kAcross, in_pitches(scale), in_pitches(tangential), extra});
        const std::int64_t place = (std::int64_t{predicted} + r) * pitch;
        if (std::abs(place) >= kMaxCoordinate) return false;
        p[axis] = static_cast<std::int32_t>(place);
        across = std::max(across, std::abs(r));
    }
    across *= pitch;

    // On the plane behind: n·(p - a) = 0; then the parabola over it.
    double height = to_vec(a)[frame.steep];
    double slope = 1, lever = 0;
    if (frame.flat()) {
        const int iu = static_cast<int>(u), iv = static_cast<int>(v), iw = frame.steep;
        slope = frame.normal[iw];
        height -= (frame.normal[iu] * (p[u] - a[u]) + frame.normal[iv] * (p[v] - a[v])) / slope;
        Vec3 on_plane = to_vec(p);
        on_plane[iw] = height;
        lever = frame.lever(on_plane);
    }
    const double bent = gate.bend * lever, gain = gain_;
    const double predicted =
        std::clamp(height + gain * bent / slope, -1.0 * kMaxCoordinate, 1.0 * kMaxCoordinate);
    const auto base = static_cast<std::int32_t>(std::floor(predicted + 0.5));
    const std::uint32_t extra = half_octaves(std::abs(across));
    if (frame.steep != flat_axis)
        p[w] =
            base + code_residual(coder_, mixer_, p[w] - base, {kSteep, scale, normal, std::min(extra, 63U)});
    if (std::abs(p[w]) >= kMaxCoordinate) return false;
    if (flat_axis == kNoMirror && on_mirror(p, mirror_axis_)) return false;

    const double risen = (p[w] - height) * slope;
    gain_ += 0.05 * (risen - gain * bent) * bent / (bent * bent + risen * risen + 1);
    const auto steps = static_cast<std::uint32_t>(std::abs(p[w] - base));
    magnitudes_.push_back({static_cast<std::uint8_t>(std::min(half_octaves(across), 63U)),
                           static_cast<std::uint8_t>(std::min(half_octaves(steps), 63U))});
    return true;
}

}  // namespace pfgeom
