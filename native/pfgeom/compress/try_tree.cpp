// A set-operation tree: fitted to points, certified by the pruned octree, mended where the certificate finds
// points on the wrong side, then proved like every candidate on its bytes and its default mesh.
#include "pfgeom/base/parallel.h"
#include "pfgeom/base/random.h"
#include "pfgeom/compress/candidate.h"
#include "pfgeom/compress/mesh_code.h"
#include "pfgeom/fit/set_tree.h"
#include "pfgeom/fit/target.h"
#include "pfgeom/mesh/signed_distance.h"
#include "pfgeom/mesh/union_find.h"
#include "pfgeom/report/tree_bound.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

namespace pfgeom {
namespace {

// Of the tolerance, what the tree is certified to. The chords of the default mesh may take more than the
// rest: they are longest where the quadrics are not at their worst, and the mesh is measured. Shorter ones
// come next.
constexpr double kTreeShare = 0.97;
constexpr double kChordShares[] = {0.25, 0.1};
constexpr int kMostProofs = 3;
// Of mending. What is not nearly mended by then is hopeless: with more counter-examples than kFew, or more
// cells than kMostCells (300,000 to 800,000 where it works). What is nearly mended comes to an end in up to
// twelve rounds more, if it is mended to a little less than what is proved; else every certificate finds some
// last points between the two (printed part of 68 quadrics).
constexpr int kCalmRound = 2, kHopefulRounds = 6, kMostRounds = 20;
constexpr std::size_t kFew = 300;
constexpr double kCalmShare = 0.955;
constexpr std::int64_t kMostCells = 3'000'000;
// Where a union of ellipsoids fills a pit of the mesh, the ellipsoids around it are rounded again, each time
// to so much less there: leaves that grow would cut the pit out of them one after the other.
constexpr int kMostHolds = 4;
constexpr double kHold = 0.4;
// More cells than these left open by a certificate: the tree is far from what it should be.
constexpr std::int64_t kMostUnresolved = 100'000;
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
// Cells at the border of the tube while there is something to mend: finer ones cost time and find no more.
constexpr double kRoughest = 1.0 / 16;
// Of the tolerance, where the final certificate looks: what its cells leave open then stays below one.
constexpr double kProofShare = 0.985;
// Labels that a certificate gives besides: more make mending slower, not better.
constexpr std::size_t kLabels = 10'000;
// Points beside a counter-example, and how far away, in tolerances.
constexpr std::size_t kBeside = 3, kMostJittered = 10'000;
constexpr double kJitter = 0.7;

// How far regions, rounded quadrics and the points beside the surface may use the tolerance. What leaves the
// seams room on one mesh costs functions on another (fandisk: the first, 1706459: the last).
struct Shares {
    double fit, quantise, tube;
    bool askew = false;
};
constexpr Shares kShares[] = {{0.6, 0.85, 0.95}, {0.75, 0.93, 0.985}};
// Where none of them can be certified. First of all they would change what is asked where it is not needed:
// at 5e-4 tri-plate_holes takes 371 bytes instead of 276.
constexpr Shares kOtherwise[] = {{0.75, 0.93, 0.985, true}, {0.6, 0.85, 0.95, true}};

// An island is one piece, and so must its mesh be. Within the tube a tree may leave bits of surface by
// themselves: they break no promise, but nobody wants them (a pebble's tree of 688 bytes left one of two
// tolerances).
bool in_one_piece(const TriangleMesh& mesh) {
    UnionFind pieces(mesh.vertices.size());
    std::size_t left = mesh.vertices.size();
    for (const auto& [a, b, c] : mesh.faces) {
        for (const std::int32_t v : {b, c}) {
            if (pieces.find(a) == pieces.find(v)) continue;
            pieces.join(a, v);
            --left;
        }
    }
    return left == 1;
}

class TreeSearch {
  public:
    /// `tolerance`: the maximum that the tree is certified to.
    TreeSearch(const Goal& goal, double tolerance, std::size_t most_bytes, const Task& task)
        : goal_(goal),
          most_bytes_(most_bytes),
          task_(task),
          frame_(Frame::around(goal.bvh.bounds())),
          mesh_(outwards_in_cube(goal, frame_)),
          bvh_(mesh_),
          distance_(mesh_, bvh_),
          tolerance_(tolerance / frame_.half()) {}

    // For metric rms: whatever rms the tree then has.
    std::optional<Outcome> run_once() {
        std::optional<Certified> found = smallest(kTreeShare * tolerance_);
        if (!found) return {};
        return prove_tree(*std::move(found), kChordOfRms * goal_.tolerance);
    }

    std::optional<Outcome> run() {
        double share = kTreeShare;
        for (int proof = 0; proof < kMostProofs; ++proof) {
            std::optional<Certified> found = smallest(share * tolerance_);
            if (!found) return {};
            double reached = 0;
            for (const double chord : kChordShares) {
                Outcome outcome = prove_tree(*found, chord * goal_.tolerance);
                if (outcome.holds) return outcome;
                if (outcome.mesh.faces.empty()) return {};
                reached = outcome.deviation.max() / goal_.tolerance;
            }
            share *= std::clamp(0.99 / reached, 0.7, 0.97);
        }
        return {};
    }

  private:
    struct Certified {
        SetTree tree;
        double bound = 0;  // in the cube's units
    };

    struct Candidate {
        TreeFit fit;
        TreeFitOptions options;
    };

    static TriangleMesh outwards_in_cube(const Goal& goal, const Frame& frame) {
        TriangleMesh mesh = in_cube(goal.mesh, frame);
        if (goal.inward) {
            for (Triangle& t : mesh.faces) std::swap(t[1], t[2]);
        }
        return mesh;
    }

    std::optional<Certified> smallest(double tolerance) const {
        const std::size_t settings = goal_.effort == Effort::fast ? 1 : std::size(kShares);
        std::optional<Certified> found = smallest_of(std::span(kShares).first(settings), tolerance);
        return found ? found : smallest_of(std::span(kOtherwise).first(settings), tolerance);
    }

    // Of the settings, the certified tree with the fewest bits. They are mended side by side.
    std::optional<Certified> smallest_of(std::span<const Shares> settings, double tolerance) const {
        std::vector<Candidate> fits;
        for (const Shares& shares : settings) {
            TreeFitOptions options;
            options.tolerance = tolerance;
            options.effort = static_cast<int>(goal_.effort);
            options.fit_share = shares.fit;
            options.quantise_share = shares.quantise;
            options.tube_share = shares.tube;
            options.askew = shares.askew;
            options.most_regions = std::clamp<std::size_t>(most_bytes_ / kBytesOfRegion, 1, kMostRegions);
            fits.push_back({fit_set_tree(mesh_, bvh_, options, task_), options});
            if (fits.back().fit.tree.nodes.empty()) return {};
            if (fits.back().fit.mostly_whole()) break;  // no seams that want other shares
        }
        std::vector<std::optional<double>> bounds(fits.size());
        const double most_bits = 8.0 * static_cast<double>(most_bytes_);
        const int threads = std::max(1, thread_count(task_) / static_cast<int>(fits.size()));
        parallel_chunks(fits.size(), 1, task_, [&](std::size_t i, std::size_t) {
            if (fits[i].fit.bits < most_bits)
                bounds[i] = certify(fits[i].fit, fits[i].options, quiet(task_, threads));
        });
        std::optional<Certified> best;
        double least = most_bits;
        for (std::size_t i = 0; i < fits.size(); ++i) {
            if (!bounds[i] || fits[i].fit.bits >= least) continue;
            least = fits[i].fit.bits;
            best = {std::move(fits[i].fit.tree), *bounds[i]};
        }
        return best;
    }

    // Mends the tree until the certificate finds nothing wrong: what it then proves, in the cube's
    // units. Nothing: it does not come to that, or the tree grows beyond `most_bits`.
    std::optional<double> certify(TreeFit& fit, TreeFitOptions& options, const Task& task) const {
        Random random(1);
        const double tolerance = options.tolerance;
        const double most_bits = 8.0 * static_cast<double>(most_bytes_);
        double held = 1;
        for (int round = 0, holds = 0; round < kMostRounds;) {
            const double reach = round < kCalmRound ? tolerance : kCalmShare * tolerance;
            TreeBound bound = rough_bound(fit.tree, reach, task);
            if (!bound.sides_defined || bound.counts.unresolved > kMostUnresolved) return {};
            if (round >= kHopefulRounds && bound.counter_examples.size() > kFew) return {};
            double worst = 0;
            for (const LabelledPoint& p : bound.counter_examples) worst = std::max(worst, p.distance);
            const double proof = kProofShare * tolerance_;
            if (worst <= proof && bound.missed.empty()) {
                TreeBoundOptions fine;
                fine.labels = 0;
                const TreeBound exact = bound_tree(fit.tree, mesh_, bvh_, proof, fine, task);
                if (exact.holds(tolerance_)) return exact.proved;
                append(exact.counter_examples, bound.counter_examples);
                append(exact.missed, bound.missed);
            }
            if (bound.counter_examples.empty() && bound.missed.empty()) return {};
            if (bound.counter_examples.empty() && fit.mostly_whole() && holds < kMostHolds) {
                ++holds;
                held *= kHold;
                for (const LabelledPoint& p : bound.missed) options.held.push_back({p.point, held});
                refit_set_tree(fit, mesh_, bvh_, options, task);
                continue;
            }
            ++round;
            repair_set_tree(fit, bvh_, evidence(bound, reach, random), task);
            if (fit.bits > most_bits) return {};
        }
        return {};
    }

    TreeBound rough_bound(const SetTree& tree, double reach, const Task& task) const {
        TreeBoundOptions rough;
        rough.finest = kRoughest;
        rough.labels = kLabels;
        rough.max_cells = kMostCells;
        return bound_tree(tree, mesh_, bvh_, reach, rough, task);
    }

    static void append(const std::vector<LabelledPoint>& more, std::vector<LabelledPoint>& list) {
        list.insert(list.end(), more.begin(), more.end());
    }

    // All that the certificate has labelled; about its counter-examples, whose cells are small, points beside
    // them as well: else the next one lies there.
    std::vector<KnownSide> evidence(const TreeBound& bound, double tolerance, Random& random) const {
        std::vector<KnownSide> points;
        for (const auto* list : {&bound.counter_examples, &bound.missed, &bound.labels}) {
            for (const LabelledPoint& p : *list) points.push_back({p.point, p.inside});
        }
        const std::size_t count = std::min(bound.counter_examples.size(), kMostJittered);
        for (std::size_t i = 0; i < kBeside * count; ++i) {
            const LabelledPoint& known = bound.counter_examples[i % count];
            Vec3 p = known.point;
            for (int axis = 0; axis < 3; ++axis) p[axis] += kJitter * tolerance * (2 * random.uniform() - 1);
            const SignedClosest closest = distance_(p, known.face);
            if (std::abs(closest.distance) > tolerance) points.push_back({p, closest.distance > 0});
        }
        return points;
    }

    Outcome prove_tree(Certified found, double chord) const {
        Outcome outcome;
        outcome.candidate = "tree";
        outcome.bound_functions = found.bound * frame_.half();
        found.tree.complement = goal_.inward;
        outcome.object.frame = frame_;
        outcome.object.shape = std::move(found.tree);
        outcome.object.mesh_code = mesh_code_for(goal_, chord);
        prove(goal_, outcome, task_);
        if (!in_one_piece(outcome.mesh)) return {};
        return outcome;
    }

    const Goal& goal_;
    std::size_t most_bytes_;
    const Task& task_;
    Frame frame_;
    TriangleMesh mesh_;  // in the cube, normals outwards
    Bvh bvh_;
    SignedDistance distance_;
    double tolerance_;  // in the cube's units
};

}  // namespace

std::optional<Outcome> try_tree(const Goal& goal, std::size_t most_bytes, const Task& task) {
    if (goal.metric == Metric::max) return TreeSearch(goal, goal.tolerance, most_bytes, task).run();
    std::optional<Outcome> best;
    double most = kMaxOverRms * goal.tolerance;
    for (int i = 0; i < kMostProofs; ++i) {
        std::optional<Outcome> outcome = TreeSearch(goal, most, most_bytes, task).run_once();
        if (!outcome || outcome->mesh.faces.empty()) break;
        const double reached = outcome->deviation.rms() / goal.tolerance;
        const bool enough = outcome->holds && reached > kEnough;
        if (outcome->holds && (!best || outcome->bytes < best->bytes)) best = std::move(outcome);
        if (enough || !(reached > 0)) break;
        most *= std::clamp(kAim / reached, 0.6, 1.5);
    }
    return best;
}

}  // namespace pfgeom
