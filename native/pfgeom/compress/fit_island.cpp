#include "pfgeom/compress/candidate.h"
#include "pfgeom/segment/exact_patches.h"

#include <algorithm>
#include <utility>

namespace pfgeom {
namespace {

// Up to so many faces the mesh candidate is cheap enough to be made as the bytes to beat.
constexpr std::size_t kQuickMesh = 40'000;
// Fewer faces than this are no ellipsoid; fewer than that are a tree or part of the common mesh.
constexpr std::size_t kLeastFacesOfQuadric = 8, kLeastFacesAlone = 100;
// The estimate is of flat faces; curved ones take down to half of it (thingi-1706459 at 1e-3: 826 bytes where
// the estimate says 1,170 and its tree takes 1,124).
constexpr std::size_t kSure = 2;
// A tree of so few bytes is not compared: a mesh could save a dozen of them, at many times the work; but it
// is no work where the input has few faces.
constexpr std::size_t kFewBytes = 120, kFewFaces = 400;
// How much larger a tree may become when it is mended, before a mesh of as many bytes is looked for.
constexpr double kGrowth = 1.25;
// A tree is kept though a mesh would save up to so much: functions keep creases and can be rebuilt at any
// resolution (milled pocket askew: 213 bytes, the mesh 204).
constexpr double kWorthOfFunctions = 0.05;
// A cut hierarchy that uses so much of the tolerance is smaller than one that is not cut.
constexpr double kWellUsed = 0.9;
// Nor are fewer than this worth a sheet, which takes some 40 bytes.
constexpr std::size_t kLeastFacesOfSheet = 16;

void take_cheaper(std::optional<Outcome> outcome, std::optional<Outcome>& best) {
    if (outcome && outcome->holds && (!best || outcome->bytes < best->bytes)) best = std::move(outcome);
}

// A tree is fitted first: where a shape is made of quadrics nothing else comes near, and neither needs to be
// made for comparison. The estimate of the mesh says when that is so. Where it is not, the mesh is made
// before the tree is mended and proved, which takes longest, and limits it (thingi-1706459 at 1e-3).
std::optional<Outcome> fit_by_max(const Goal& goal, const Task& task) {
    const bool all = goal.effort == Effort::best;
    std::optional<MeshEstimate> known;  // once it is asked for: not for scans
    const auto estimate = [&]() -> const MeshEstimate& {
        return known ? *known : known.emplace(estimate_mesh(goal, task));
    };
    const auto surely_less = [&](std::size_t bytes) {
        return (bytes <= kFewBytes && goal.mesh.faces.size() > kFewFaces) ||
               kSure * bytes < estimate().least_mirrored();
    };
    std::optional<Outcome> plain;
    std::size_t beaten = 0;  // no mesh takes so few bytes
    const auto look_for_mesh = [&](std::size_t most) {
        if (all) most = kAnyBytes;
        if (plain || most <= beaten) return;
        Outcome mesh = try_mesh(goal, known, most, task);
        if (mesh.holds)
            plain = std::move(mesh);
        else
            beaten = most;
    };
    const auto limit = [&](std::size_t bytes) {
        if (!surely_less(bytes))
            look_for_mesh(static_cast<std::size_t>(kGrowth * static_cast<double>(bytes)));
        return plain ? std::min(plain->bytes, estimate().likely) : estimate().likely;
    };
    std::optional<Outcome> best = try_tree(goal, limit, task);
    if (best && surely_less(best->bytes) && !all) return best;
    if (!best && goal.mesh.faces.size() < kLeastFacesAlone) return {};
    std::size_t most = kAnyBytes;
    if (best) most = static_cast<std::size_t>((1 - kWorthOfFunctions) * static_cast<double>(best->bytes));
    look_for_mesh(most);
    if (plain && plain->bytes <= most) best = std::move(plain);
    // By the maximum no hierarchy was the cheapest of the candidates at any of 50 points: 17 meshes at 1e-2,
    // 1e-3 and 2e-4.
    if (all || !best) take_cheaper(try_hierarchy(goal, best ? best->bytes : kAnyBytes, task), best);
    return best;
}

// Of the tree and the mesh the likely one comes first and limits the other.
std::optional<Outcome> fit_by_rms(const Goal& goal, const Task& task) {
    const MeshEstimate estimate = estimate_mesh(goal, task);
    const std::size_t faces = goal.mesh.faces.size();
    const bool alone = faces >= kLeastFacesAlone, all = goal.effort == Effort::best;
    std::optional<Outcome> best;
    const auto good_enough = [&] { return best && best->bytes <= kFewBytes && !all; };
    const auto look_for_tree = [&] {
        const std::size_t most = best ? std::min(best->bytes, estimate.likely) : estimate.likely;
        take_cheaper(try_tree(
                         goal, [&](std::size_t) { return most; }, task),
                     best);
    };
    const auto look_for_mesh = [&] {
        const bool needless = good_enough() || (best && best->bytes < estimate.least_mirrored() && !all);
        if ((alone || best) && faces <= kQuickMesh && !needless)
            take_cheaper(try_mesh(goal, estimate, kAnyBytes, task), best);
    };
    // What is not alone is a tree or nothing.
    if (!alone || is_tessellation(goal.mesh, find_exact_patches(goal.mesh, task))) {
        look_for_tree();
        look_for_mesh();
    } else {
        look_for_mesh();
        look_for_tree();
    }
    if (!alone || good_enough()) return best;
    // A smooth form's tree can be certified and yet take half as many bytes again as its hierarchy; the
    // search of that starts too fine.
    const std::size_t most = best ? 2 * best->bytes : kAnyBytes;
    std::optional<Outcome> cut = try_cut_hierarchy(goal, most, task);
    const bool found = cut && cut->deviation.rms() > kWellUsed * goal.tolerance;
    if (!found || all) take_cheaper(try_hierarchy(goal, most, task), best);
    take_cheaper(std::move(cut), best);
    return best;
}

std::optional<Outcome> fit_closed(const Goal& goal, const Task& task) {
    if (goal.mesh.faces.size() >= kLeastFacesOfQuadric) {
        if (std::optional<Outcome> quadric = try_quadric(goal, task)) return quadric;
    }
    return goal.metric == Metric::max ? fit_by_max(goal, task) : fit_by_rms(goal, task);
}

// Sheets of one quadric need no comparison. Of free forms a hierarchy has never beaten the mesh part by the
// maximum, closed or not; by the rms the bunny takes 0.75 times as many bytes at 5e-4.
std::optional<Outcome> fit_open(const Goal& goal, const Task& task) {
    if (std::optional<Outcome> sheet = try_sheet(goal, task)) return sheet;
    const std::size_t faces = goal.mesh.faces.size();
    if (faces < kLeastFacesAlone || (goal.metric == Metric::max && goal.effort != Effort::best)) return {};
    std::optional<Outcome> best;
    if (faces <= kQuickMesh) take_cheaper(try_mesh(goal, {}, kAnyBytes, task), best);
    take_cheaper(try_open_hierarchy(goal, best ? best->bytes : kAnyBytes, task), best);
    return best;
}

}  // namespace

std::optional<Outcome> fit_island(const Island& island, const Goal& goal, const Task& task) {
    if (!island.oriented) return {};
    if (island.closed) return fit_closed(goal, task);
    if (!island.manifold || goal.mesh.faces.size() < kLeastFacesOfSheet) return {};
    return fit_open(goal, task);
}

}  // namespace pfgeom
