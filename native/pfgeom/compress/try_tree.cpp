// A set-operation tree: fitted to points, mended until it is certified, then proved like every candidate on
// its bytes and its default mesh.
#include "pfgeom/compress/candidate.h"
#include "pfgeom/compress/mend_tree.h"
#include "pfgeom/compress/mesh_code.h"
#include "pfgeom/fit/set_tree.h"
#include "pfgeom/fit/target.h"
#include "pfgeom/mesh/islands.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace pfgeom {
namespace {

// Larger islands are tried if they are tessellations.
constexpr std::size_t kLarge = 40'000;  // faces
// Of the tolerance, what the tree is certified to. The chords of the default mesh may take more than the
// rest: they are longest where the quadrics are not at their worst, and the mesh is measured. Shorter ones
// come next: by a step of the mesh code, or by what the mesh missed, of which each chord adds itself and what
// thinning may. At the shortest a filled pit can open that coarser meshes pass over (tri-plate_holes at
// 1e-2).
constexpr double kTreeShare = 0.97;
constexpr double kChordShare = 0.36, kLeastChordShare = 0.08, kShorter = 0.84, kMeshOfChord = 2.5;
constexpr double kLongChordShares[] = {0.4, 0.6};
constexpr std::size_t kMostGrowth = 3;  // triangles of the mesh for each of the input
constexpr int kMostProofs = 3;
constexpr int kMostCleanings = 4;
// A region costs at least so many bytes.
constexpr std::size_t kBytesOfRegion = 6;
// Free forms fall into more (310 to 3,400 on seven of them at 1e-3 of the diagonal), parts into fewer (23 to
// 79 on six); no tree of so many has ever been certified.
constexpr std::size_t kMostRegions = 300;
// Metric rms: the maximum that a tree is certified to, in its rms (3.3 to 4.7 on three parts), and the
// chords.
constexpr double kMaxOverRms = 4, kChordOfRms = 0.5;
// Of the rms that is asked for: where the search stops, and what it aims at.
constexpr double kEnough = 0.9, kAim = 0.96;

// How far regions, rounded quadrics and the points beside the surface may use the tolerance. What leaves the
// seams room on one mesh costs functions on another (fandisk: the first, 1706459: the last).
struct Shares {
    double fit, quantise, tube;
    bool askew = false;
};
constexpr Shares kShares[] = {{0.6, 0.85, 0.95}, {0.75, 0.93, 0.985}};
// Where none of them can be certified, or the tree asks far more than its few functions should need: trees
// have 8 to 25 bytes a function, but a capsule askew, finely tessellated, had 269 for three, where 67 do.
// First of all they would change what is asked where it is not needed: at 5e-4 tri-plate_holes takes 371
// bytes instead of 276.
constexpr double kBytesOfTree = 30, kBytesOfFunction = 20;
constexpr Shares kOtherwise[] = {{0.75, 0.93, 0.985, true}, {0.6, 0.85, 0.95, true}};
// Where none of those can be mended either, though they are small (a milled pocket askew, finely tessellated:
// 209 bytes where a mesh takes 226).
constexpr Shares kLast[] = {{0.85, 0.95, 0.99, true}};

TriangleMesh outwards_in_cube(const Goal& goal, const Frame& frame) {
    TriangleMesh mesh = in_cube(goal.mesh, frame);
    if (goal.inward) {
        for (Triangle& t : mesh.faces) std::swap(t[1], t[2]);
    }
    return mesh;
}

class TreeSearch {
  public:
    TreeSearch(const Goal& goal, const TreeLimit& most_bytes, const Task& task)
        : goal_(goal),
          most_bytes_(most_bytes),
          task_(task),
          frame_(Frame::around(goal.bvh.bounds())),
          target_(outwards_in_cube(goal, frame_), task) {}

    std::optional<Outcome> run() const {
        if (target_.mesh.faces.size() > kLarge && !is_tessellation(target_.mesh, target_.exact)) return {};
        return goal_.metric == Metric::max ? by_max() : by_rms();
    }

  private:
    std::optional<Outcome> by_max() const {
        double share = kTreeShare;
        for (int proof = 0; proof < kMostProofs; ++proof) {
            std::optional<TreeCandidate> found = smallest(share, goal_.tolerance);
            if (!found) return {};
            double reached = 0, chord = kChordShare;
            for (;;) {
                Outcome outcome = prove_tree(*found, chord * goal_.tolerance, goal_.tolerance);
                if (outcome.holds) return slimmer(*found, std::move(outcome));
                if (outcome.mesh.faces.empty()) return {};
                reached = outcome.deviation.max() / goal_.tolerance;
                chord = std::min(kShorter * chord, chord - (reached - 1) / kMeshOfChord);
                chord = std::max(chord, kLeastChordShare);
                if (mesh_code_for(goal_, chord * goal_.tolerance) == outcome.object.mesh_code) break;
            }
            share *= std::clamp(0.99 / reached, 0.7, 0.97);
        }
        return {};
    }

    // A coarse input shall not come back as a mesh of many times its triangles.
    bool is_dense(const Outcome& outcome) const {
        return outcome.mesh.faces.size() > kMostGrowth * goal_.mesh.faces.size();
    }

    // With longer chords, as far as they hold.
    Outcome slimmer(TreeCandidate& found, Outcome outcome) const {
        for (const double chord : kLongChordShares) {
            if (!is_dense(outcome)) break;
            Outcome longer = prove_tree(found, chord * goal_.tolerance, goal_.tolerance);
            if (!longer.holds) break;
            outcome = std::move(longer);
        }
        return outcome;
    }

    // The maximum that has this rms is searched for.
    std::optional<Outcome> by_rms() const {
        std::optional<Outcome> best;
        double most = kMaxOverRms * goal_.tolerance;
        for (int proof = 0; proof < kMostProofs; ++proof) {
            std::optional<TreeCandidate> found = smallest(kTreeShare, most);
            if (!found) break;
            Outcome outcome = prove_tree(*found, kChordOfRms * goal_.tolerance, most);
            if (outcome.mesh.faces.empty()) break;
            const double reached = outcome.deviation.rms() / goal_.tolerance;
            const bool enough = outcome.holds && reached > kEnough;
            if (outcome.holds && (!best || outcome.bytes < best->bytes)) best = std::move(outcome);
            if (enough || !(reached > 0)) break;
            most *= std::clamp(kAim / reached, 0.6, 1.5);
        }
        return best;
    }

    // Fitted within this share of the tolerance, certified to all of it.
    std::optional<TreeCandidate> smallest(double share, double tolerance) const {
        const double certified = tolerance / frame_.half();
        std::optional<TreeCandidate> best;
        bool mended = false;
        const std::span<const Shares> sets[] = {kShares, kOtherwise, kLast};
        for (const std::span<const Shares> shares : sets) {
            if (shares.data() == kLast && (best || !mended)) break;
            std::vector<TreeCandidate> trees = fitted(shares, share * certified);
            if (trees.empty()) continue;
            const double least = least_bits(trees);
            if (!std::isfinite(least)) continue;
            mend(trees, certified);
            mended = true;
            for (TreeCandidate& tree : trees) {
                if (tree.proved > 0 && (!best || tree.fit.bits < best->fit.bits)) best = std::move(tree);
            }
            // What is too large is not so for lack of room at its seams.
            if (best ? !is_wordy(*best) : least > most_bits(least)) break;
        }
        return best;
    }

    static bool is_wordy(const TreeCandidate& tree) {
        const auto functions = static_cast<double>(tree.fit.tree.quadrics.size());
        return tree.fit.bits > 8 * (kBytesOfTree + kBytesOfFunction * functions);
    }

    // Of each setting a tree; none where one has too many regions.
    std::vector<TreeCandidate> fitted(std::span<const Shares> settings, double tolerance) const {
        std::vector<TreeCandidate> fits;
        for (const Shares& shares : settings) {
            const TreeFitOptions options = options_for(shares, tolerance);
            fits.push_back({fit_set_tree(target_.mesh, target_.bvh, options, task_), options});
            if (fits.back().fit.regions.empty()) return {};
            if (fits.back().fit.mostly_whole()) break;  // no seams that want other shares
        }
        return fits;
    }

    void mend(std::span<TreeCandidate> fits, double certified) const {
        mend_trees(fits, target_, certified, most_bits(least_bits(fits)), task_);
    }

    static double least_bits(std::span<const TreeCandidate> fits) {
        double least = std::numeric_limits<double>::infinity();
        for (const TreeCandidate& candidate : fits) least = std::min(least, candidate.fit.bits);
        return least;
    }

    // For trees of which the smallest has so many.
    double most_bits(double least) const {
        return 8.0 * static_cast<double>(most_bytes_(static_cast<std::size_t>(least / 8)));
    }

    TreeFitOptions options_for(const Shares& shares, double tolerance) const {
        TreeFitOptions options;
        options.tolerance = tolerance;
        options.effort = static_cast<int>(goal_.effort);
        options.fit_share = shares.fit;
        options.quantise_share = shares.quantise;
        options.tube_share = shares.tube;
        options.askew = shares.askew;
        const std::size_t most = most_bytes_(0);
        options.most_regions = std::clamp<std::size_t>(most / kBytesOfRegion, 1, kMostRegions);
        options.most_bits = 8.0 * static_cast<double>(most);
        options.exact = target_.exact;
        return options;
    }

    // An island is one piece, and so must its mesh be. Within the tube a tree may leave bits of surface by
    // themselves: they break no promise, but nobody wants them (a pebble's tree left one of two
    // tolerances). The leaves that they are in are mended like others that are wrong.
    Outcome prove_tree(TreeCandidate& found, double chord, double tolerance) const {
        for (int i = 0;; ++i) {
            Outcome outcome = prove_once(found, chord);
            if (!outcome.holds) return outcome;  // a mesh with shorter chords may have none
            const std::vector<KnownSide> bits = loose_bits(outcome.mesh);
            if (bits.empty()) return outcome;
            if (i == kMostCleanings) return {};
            repair_set_tree(found.fit, target_.bvh, bits, task_);
            found.proved = 0;
            mend({&found, 1}, tolerance / frame_.half());
            if (found.proved == 0) return {};
        }
    }

    // Points in the pieces of a tree's mesh but for the largest, with their sides of the island.
    std::vector<KnownSide> loose_bits(const TriangleMesh& mesh) const {
        std::vector<KnownSide> points;
        std::vector<std::vector<std::int32_t>> pieces = find_pieces(mesh);
        for (std::size_t i = 1; i < pieces.size(); ++i) {
            Vec3 centre;
            for (const std::int32_t v : pieces[i])
                centre += mesh.vertices[v] / static_cast<double>(pieces[i].size());
            for (const std::int32_t v : pieces[i]) {
                const Vec3 p = frame_.to_local((centre + mesh.vertices[v]) / 2);
                points.push_back({p, target_.distance(p).distance > 0});
            }
        }
        return points;
    }

    Outcome prove_once(const TreeCandidate& found, double chord) const {
        Outcome outcome;
        outcome.candidate = "tree";
        outcome.bound_functions = found.proved * frame_.half();
        SetTree tree = found.fit.tree;
        tree.complement = goal_.inward;
        outcome.object.frame = frame_;
        outcome.object.shape = std::move(tree);
        outcome.object.mesh_code = mesh_code_for(goal_, chord);
        prove(goal_, outcome, task_);
        return outcome;
    }

    const Goal& goal_;
    const TreeLimit& most_bytes_;
    const Task& task_;
    Frame frame_;
    TreeTarget target_;
};

}  // namespace

std::optional<Outcome> try_tree(const Goal& goal, const TreeLimit& most_bytes, const Task& task) {
    return TreeSearch(goal, most_bytes, task).run();
}

}  // namespace pfgeom
