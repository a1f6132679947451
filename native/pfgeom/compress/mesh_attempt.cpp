#include "pfgeom/compress/mesh_attempt.h"

#include "pfgeom/base/error.h"
#include "pfgeom/codec/mesh_part_codec.h"
#include "pfgeom/compress/mesh_code.h"
#include "pfgeom/eval/mesh_part.h"
#include "pfgeom/fit/simplify.h"
#include "pfgeom/function/edges_of_faces.h"

#include <array>
#include <cstdint>
#include <vector>

namespace pfgeom {
namespace {

// Of the tolerance: how far the default mesh may be from the curved faces, how far where it would have more
// than three quarters of the input's triangles, or three times as many, and what the fit leaves for it.
constexpr double kChordShare = 0.08, kLongChordShare = 0.12, kMostChordShare = 0.5, kReserve = 0.05;
constexpr std::size_t kMostTriangles = 3;
// By the rms chords add little: half of the tolerance 2 % of the rms, 0.7 of it 5 % (cheburashka at 1e-4).
constexpr double kChordOfRms = 0.5, kMostChordOfRms = 1;
// It may have so many times as many where a finer one is tried (cheburashka and rocker-arm at 1e-3: 3.01).
constexpr std::size_t kMostTrianglesFiner = 4;
// Inside a patch chords are off by more than along its edges: where the proof misses the tolerance by less
// than so much a finer default mesh is tried, with chords of half the length in the end.
constexpr double kMaySuffice = 1.15;
constexpr std::array kFinerCodes{1, 2, 4};
// Of a face: the fewest were 2.3 curved (suzanne at 1e-2) and 1.03 flat (teapot at 2e-4).
constexpr double kLeastCurvedBytes = 2, kLeastFlatBytes = 0.9;

// The finest default mesh that is not too large for the input.
std::uint8_t mesh_code_of(const Goal& goal, const Object& object) {
    const auto code_for = [&](double share) { return mesh_code_for(goal, share * goal.tolerance); };
    const bool by_max = goal.metric == Metric::max;
    std::uint8_t code = code_for(by_max ? kChordShare : kChordOfRms);
    const auto triangles = [&] {
        try {
            return mesh_of(object, {.chord = goal.diagonal * exp2_eighths(-2 * int{code})}).faces.size();
        } catch (const LimitExceeded&) {
            return SIZE_MAX;
        }
    };
    std::size_t count = triangles();
    const auto coarsen = [&](double share, std::size_t most) {
        for (const std::uint8_t least = code_for(share); code > least && count > most; count = triangles())
            --code;
    };
    const std::size_t input = goal.mesh.faces.size();
    if (by_max) {
        coarsen(kLongChordShare, input - input / 4);
        coarsen(kMostChordShare, kMostTriangles * input);
    } else {
        coarsen(kMostChordOfRms, kMostTrianglesFiner * input);
    }
    return code;
}

bool too_many(const Goal& goal, const Outcome& outcome) {
    return outcome.mesh.faces.size() > kMostTrianglesFiner * goal.mesh.faces.size();
}

void prove_curved(const Goal& goal, Outcome& outcome, const Task& task) {
    prove(goal, outcome, task);
    const std::uint8_t code = outcome.object.mesh_code;
    for (const int finer : kFinerCodes) {
        if (code + finer > 255) break;
        const bool may =
            goal.metric == Metric::max && outcome.deviation.max() <= kMaySuffice * goal.tolerance;
        if (outcome.holds || !may || too_many(goal, outcome)) break;
        outcome.object.mesh_code = static_cast<std::uint8_t>(code + finer);
        prove(goal, outcome, task);
    }
    if (too_many(goal, outcome)) outcome.holds = false;
}

// Where the halves of a mirrored part meet each edge must have one face, which its image continues.
bool joins_cleanly(const MeshPart& part) {
    const EdgesOfFaces edges = EdgesOfFaces::of(part.faces);
    std::vector<int> faces(edges.ends.size(), 0);
    for (const Triangle& rows : edges.of_face) {
        for (const std::int32_t row : rows) ++faces[static_cast<std::size_t>(row)];
    }
    for (std::size_t row = 0; row < faces.size(); ++row) {
        if (faces[row] > 1 && part.is_seam(edges.ends[row])) return false;
    }
    return true;
}

}  // namespace

Outcome attempt_mesh(const WantedMesh& wanted, double share, bool curved, const Task& task) {
    const Goal& goal = wanted.goal;
    Outcome outcome;
    outcome.candidate = "mesh";
    const double reserve = curved ? kReserve * goal.tolerance : 0;
    MeshPartOptions options{goal.tolerance - reserve, goal.metric, share, curved, {}};
    if (wanted.mirror) options.mirror = wanted.mirror->plane;
    const double faces =
        static_cast<double>(wanted.most_bytes) / (curved ? kLeastCurvedBytes : kLeastFlatBytes);
    if (wanted.most_bytes < kAnyBytes) options.most_faces = static_cast<std::size_t>(faces);
    outcome.object = fit_mesh_part(wanted.mirror ? wanted.mirror->mesh : goal.mesh, options, task);
    if (wanted.mirror) outcome.object.placements = wanted.mirror->placements;
    auto& part = std::get<MeshPart>(outcome.object.shape);
    if (part.faces.empty()) {
        outcome.bytes = kAnyBytes;
        return outcome;
    }
    if (curved) outcome.object.mesh_code = mesh_code_of(goal, outcome.object);
    if (!joins_cleanly(part)) return outcome;
    part = canonical(part);
    if (curved)
        prove_curved(goal, outcome, task);
    else
        prove(goal, outcome, task);
    return outcome;
}

}  // namespace pfgeom
