#include "pfgeom/codec/mesh_part_walk.h"

#include <algorithm>

namespace pfgeom {
namespace {

enum Kind : std::uint32_t {
    kSeedNew = 130,
    kReference = 132,
    kBorder = 134,
    kNear = 135,
    kFar = 136,
    kNew = 137,
    kFlipped = 138
};
enum Border : std::uint8_t { kLeaves = 1, kArrives = 2 };

// A byte pays for at most this many faces, so that a decoder can refuse a count before it allocates: a face
// takes some 300 bytes of a decoder's memory, of the 16 KiB that it may use for each byte of a file. Only
// meshes with next to no information (flat regular grids) come near it; zero bytes are then put between.
constexpr std::size_t kFacesPerByte = 32, kFacesFree = 1024;

const std::vector<Triangle> kNoFaces;

std::uint32_t at_most(int value, int limit) {
    return static_cast<std::uint32_t>(std::clamp(value, 0, limit));
}

// log2(x / y) in half octaves around 8, within 0 .. 15.
std::uint32_t ratio(double x, double y) {
    if (!(y > 0)) return 15;
    return at_most(log2_sixteenths(static_cast<std::uint32_t>(std::min(x / y, 1e3) * 256)) / 8, 15);
}

}  // namespace

/// What the coding of a third vertex knows about its place.
struct MeshPartWalk::Surroundings {
    Wedge near, far;
    std::uint32_t near_angle, far_angle;      // in 32 and 16 steps, 32 and 16: none
    std::uint32_t near_valence, far_valence;  // of the corners of the wedges
    std::uint32_t closing;                    // length of the edge across the near wedge against the gate
    std::uint32_t miss;     // distance of the near vertex from the parallelogram's against the gate
    std::uint32_t borders;  // of the gate's two ends

    Surroundings(const Front& front, const Gate& gate, const std::vector<std::uint8_t>& border_flags)
        : near(front.before(gate)), far(front.after(gate)) {
        std::int32_t near_corner = gate.from, far_corner = gate.to;
        if (far.vertex >= 0 && (near.vertex < 0 || far.angle < near.angle)) {
            std::swap(near, far);
            std::swap(near_corner, far_corner);
        }
        near_angle = at_most(near.vertex < 0 ? 32 : near.angle / 32, 32);
        far_angle = at_most(far.vertex < 0 ? 16 : far.angle / 64, 16);
        near_valence = at_most(front.valence(near_corner), 15);
        far_valence = at_most(front.valence(far_corner), 15);
        borders = border_flags[static_cast<std::size_t>(gate.from)] * 4U +
                  border_flags[static_cast<std::size_t>(gate.to)];
        closing = miss = 15;
        if (near.vertex < 0) return;
        const auto at = [&](std::int32_t v) {
            return to_vec(front.positions()[static_cast<std::size_t>(v)]);
        };
        const Vec3 a = at(gate.from), b = at(gate.to), c = at(near.vertex);
        const double length = norm(b - a);
        closing = ratio(norm(c - at(far_corner)), length);
        miss = ratio(norm(a + b - at(gate.apex) - c), length);
    }
};

MeshPartWalk::MeshPartWalk(EntropyCoder& coder, ContextMixer& mixer, int mirror_axis, const MeshPart* written)
    : coder_(coder),
      mixer_(mixer),
      mirror_axis_(mirror_axis),
      written_(written),
      left_(written ? written->faces : kNoFaces, written ? written->positions.size() : 0),
      known_(written ? written->positions.size() : 0, -1),
      vertex_coder_(coder, mixer, mirror_axis) {}

FormatStatus MeshPartWalk::run(std::size_t count, std::size_t budget_bytes) {
    if (count > kFacesFree + budget_bytes * kFacesPerByte) return FormatStatus::limit_exceeded;
    faces_.reserve(count);
    const std::size_t bytes_before = coder_.bytes_so_far();
    Gate gate;
    while (faces_.size() < count) {
        if (coder_.exhausted()) return FormatStatus::truncated;
        const bool good = front_.pop(gate) ? step(gate) : seed();
        if (!good) return FormatStatus::bad_value;
        const std::size_t paid = (coder_.bytes_so_far() - bytes_before) * kFacesPerByte;
        if (faces_.size() > kFacesFree + paid) coder_.code_raw(0, 8);
    }
    return FormatStatus::ok;
}

MeshPartWalk::Corner MeshPartWalk::corner_of(std::int32_t written) const {
    return {written, known_[static_cast<std::size_t>(written)]};
}

bool MeshPartWalk::add_vertex(const Gate* gate, Corner& corner) {
    const std::vector<GridPoint>& positions = front_.positions();
    GridPoint p{};
    if (written_) p = written_->positions[static_cast<std::size_t>(corner.written)];
    const bool good = gate ? vertex_coder_.code(positions, *gate, p)
                           : vertex_coder_.code_free(positions.empty() ? GridPoint{} : positions.back(), p);
    corner.known = static_cast<std::int32_t>(positions.size());
    if (written_) {
        known_[static_cast<std::size_t>(corner.written)] = corner.known;
        written_rows_.push_back(corner.written);
    }
    front_.add_vertex(p);
    borders_.push_back(0);
    return good;
}

bool MeshPartWalk::code_reference(Corner& corner) {
    const auto known = static_cast<std::int32_t>(front_.positions().size());
    const std::uint32_t age =
        mixer_.code_uint(coder_, static_cast<std::uint32_t>(known - 1 - corner.known), kReference);
    if (age >= static_cast<std::uint32_t>(known)) return false;
    corner.known = known - 1 - static_cast<std::int32_t>(age);
    return true;
}

bool MeshPartWalk::seed() {
    std::array<Corner, 3> corners;
    if (written_) {
        const std::int32_t face = left_.lowest();
        left_.take(face);
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = corner_of(written_->faces[static_cast<std::size_t>(face)][k]);
        }
    }
    for (Corner& corner : corners) {
        const std::array<std::uint32_t, 1> context{0};
        const bool fresh = mixer_.code(coder_, corner.known < 0 ? 1 : 0, {kSeedNew, 0, 0}, context) != 0;
        if (!(fresh ? add_vertex(nullptr, corner) : code_reference(corner))) return false;
    }
    const std::int32_t a = corners[0].known, b = corners[1].known, c = corners[2].known;
    if (a == b || b == c || c == a) return false;
    faces_.push_back({a, b, c});
    front_.seed(a, b, c);
    return true;
}

bool MeshPartWalk::code_border(const Surroundings& around, bool border) {
    const std::array<std::uint32_t, 4> contexts{around.borders, 16 + around.near_angle,
                                                64 + around.borders * 16 + around.far_angle,
                                                1024 + around.borders * 64 + around.near_angle};
    return mixer_.code(coder_, border ? 1 : 0, {kBorder, 0, around.borders}, contexts) != 0;
}

// On the plane of a mirrored part the image begins: no face follows, and nothing is coded.
bool MeshPartWalk::is_seam(const Gate& gate) const {
    return on_mirror(front_.positions()[static_cast<std::size_t>(gate.from)], mirror_axis_) &&
           on_mirror(front_.positions()[static_cast<std::size_t>(gate.to)], mirror_axis_);
}

// Codes which vertex the face has; corner.known becomes -1 for a new one.
bool MeshPartWalk::code_third(const Surroundings& around, Corner& corner) {
    const auto is = [&](Kind kind, bool yes, std::uint32_t set, std::span<const std::uint32_t> contexts) {
        return mixer_.code(coder_, yes ? 1 : 0, {kind, set, 0}, contexts) != 0;
    };
    const std::uint32_t shape = around.closing * 16 + around.miss;
    if (around.near.vertex >= 0) {
        const std::uint32_t angle = around.near_angle;
        const std::array<std::uint32_t, 6> contexts{angle,
                                                    around.near_valence * 64 + angle,
                                                    shape,
                                                    around.miss * 64 + angle,
                                                    around.far_angle * 64 + angle,
                                                    around.borders * 16 + around.near_valence};
        if (is(kNear, corner.known == around.near.vertex, angle, contexts)) {
            corner.known = around.near.vertex;
            return true;
        }
    }
    if (around.far.vertex >= 0 && around.far.vertex != around.near.vertex) {
        const std::uint32_t angle = around.far_angle;
        const std::array<std::uint32_t, 3> contexts{angle, around.far_valence * 32 + angle,
                                                    around.near_angle * 32 + angle};
        if (is(kFar, corner.known == around.far.vertex, angle, contexts)) {
            corner.known = around.far.vertex;
            return true;
        }
    }
    const std::array<std::uint32_t, 2> contexts{around.near_angle, 64 + around.borders};
    if (is(kNew, corner.known < 0, 0, contexts)) {
        corner.known = -1;
        return true;
    }
    return code_reference(corner);
}

bool MeshPartWalk::step(const Gate& gate) {
    FacesLeft::Found found;
    if (written_) {
        const auto row = [&](std::int32_t v) { return written_rows_[static_cast<std::size_t>(v)]; };
        found = left_.at_edge(row(gate.from), row(gate.to), gate.flipped);
    }
    const Surroundings around(front_, gate, borders_);
    if (is_seam(gate) || code_border(around, found.face < 0)) {
        borders_[static_cast<std::size_t>(gate.from)] |= kLeaves;
        borders_[static_cast<std::size_t>(gate.to)] |= kArrives;
        return true;
    }
    Corner corner;
    if (written_) {
        corner = corner_of(found.third);
        left_.take(found.face);
    }
    if (!code_third(around, corner)) return false;
    const std::array<std::uint32_t, 1> context{gate.flipped ? 1U : 0U};
    const bool flipped = mixer_.code(coder_, found.flipped ? 1 : 0, {kFlipped, 0, 0}, context) != 0;
    if (corner.known < 0 && !add_vertex(&gate, corner)) return false;
    if (corner.known == gate.from || corner.known == gate.to) return false;
    if (flipped)
        faces_.push_back({gate.to, gate.from, corner.known});
    else
        faces_.push_back({gate.from, gate.to, corner.known});
    const auto& positions = front_.positions();
    const double bend =
        PositionCoder::bend(positions, gate, positions[static_cast<std::size_t>(corner.known)]);
    front_.grow(gate, corner.known, flipped, bend);
    return true;
}

}  // namespace pfgeom
