// A set-operation tree: fitted to points, mended until it is certified, then proved like every candidate on
// its bytes and its default mesh.
#include "pfgeom/base/parallel.h"
#include "pfgeom/compress/candidate.h"
#include "pfgeom/compress/mend_tree.h"
#include "pfgeom/compress/mesh_code.h"
#include "pfgeom/fit/set_tree.h"
#include "pfgeom/fit/target.h"
#include "pfgeom/mesh/islands.h"

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

namespace pfgeom {
namespace {

// A large island is tried if so much of its area is an exact tessellation: parts and unions of ellipsoids
// have 0.9 to 1, scans less than 0.1.
constexpr std::size_t kLarge = 40'000;  // faces
constexpr double kTessellated = 0.5;
// Of the tolerance, what the tree is certified to. The chords of the default mesh may take more than the
// rest: they are longest where the quadrics are not at their worst, and the mesh is measured. Shorter ones
// come next.
constexpr double kTreeShare = 0.97;
constexpr double kChordShares[] = {0.25, 0.1};
constexpr int kMostProofs = 3;
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
// Where none of them can be certified. First of all they would change what is asked where it is not needed:
// at 5e-4 tri-plate_holes takes 371 bytes instead of 276.
constexpr Shares kOtherwise[] = {{0.75, 0.93, 0.985, true}, {0.6, 0.85, 0.95, true}};

TriangleMesh outwards_in_cube(const Goal& goal, const Frame& frame) {
    TriangleMesh mesh = in_cube(goal.mesh, frame);
    if (goal.inward) {
        for (Triangle& t : mesh.faces) std::swap(t[1], t[2]);
    }
    return mesh;
}

class TreeSearch {
  public:
    TreeSearch(const Goal& goal, std::size_t most_bytes, const Task& task)
        : goal_(goal),
          most_bytes_(most_bytes),
          task_(task),
          frame_(Frame::around(goal.bvh.bounds())),
          target_(outwards_in_cube(goal, frame_), task) {}

    std::optional<Outcome> run() const {
        if (target_.mesh.faces.size() > kLarge && exact_share(target_.mesh, target_.exact) < kTessellated)
            return {};
        return goal_.metric == Metric::max ? by_max() : by_rms();
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

    std::optional<Outcome> by_max() const {
        double share = kTreeShare;
        for (int proof = 0; proof < kMostProofs; ++proof) {
            const std::optional<Certified> found = smallest(share, goal_.tolerance);
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

    // The maximum that has this rms is searched for.
    std::optional<Outcome> by_rms() const {
        std::optional<Outcome> best;
        double most = kMaxOverRms * goal_.tolerance;
        for (int proof = 0; proof < kMostProofs; ++proof) {
            const std::optional<Certified> found = smallest(kTreeShare, most);
            if (!found) break;
            Outcome outcome = prove_tree(*found, kChordOfRms * goal_.tolerance);
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
    std::optional<Certified> smallest(double share, double tolerance) const {
        const double certified = tolerance / frame_.half();
        const std::size_t settings = goal_.effort == Effort::fast ? 1 : std::size(kShares);
        for (const auto& shares : {std::span(kShares), std::span(kOtherwise)}) {
            if (auto found = smallest_of(shares.first(settings), share * certified, certified)) return found;
        }
        return {};
    }

    // Of the settings, the certified tree with the fewest bits. They are mended side by side.
    std::optional<Certified> smallest_of(std::span<const Shares> settings, double tolerance,
                                         double certified) const {
        std::vector<Candidate> fits;
        for (const Shares& shares : settings) {
            const TreeFitOptions options = options_for(shares, tolerance);
            fits.push_back({fit_set_tree(target_.mesh, target_.bvh, options, task_), options});
            if (fits.back().fit.tree.nodes.empty()) return {};
            if (fits.back().fit.mostly_whole()) break;  // no seams that want other shares
        }
        const double most_bits = 8.0 * static_cast<double>(most_bytes_);
        std::vector<std::optional<double>> bounds(fits.size());
        const int threads = std::max(1, thread_count(task_) / static_cast<int>(fits.size()));
        parallel_chunks(fits.size(), 1, task_, [&](std::size_t i, std::size_t) {
            auto& [fit, options] = fits[i];
            if (fit.bits < most_bits)
                bounds[i] = mend_tree(fit, options, target_, certified, most_bits, quiet(task_, threads));
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

    TreeFitOptions options_for(const Shares& shares, double tolerance) const {
        TreeFitOptions options;
        options.tolerance = tolerance;
        options.effort = static_cast<int>(goal_.effort);
        options.fit_share = shares.fit;
        options.quantise_share = shares.quantise;
        options.tube_share = shares.tube;
        options.askew = shares.askew;
        options.most_regions = std::clamp<std::size_t>(most_bytes_ / kBytesOfRegion, 1, kMostRegions);
        options.exact = target_.exact;
        return options;
    }

    // An island is one piece, and so must its mesh be. Within the tube a tree may leave bits of surface by
    // themselves: they break no promise, but nobody wants them (a pebble's tree of 688 bytes left one of two
    // tolerances).
    Outcome prove_tree(const Certified& found, double chord) const {
        Outcome outcome;
        outcome.candidate = "tree";
        outcome.bound_functions = found.bound * frame_.half();
        SetTree tree = found.tree;
        tree.complement = goal_.inward;
        outcome.object.frame = frame_;
        outcome.object.shape = std::move(tree);
        outcome.object.mesh_code = mesh_code_for(goal_, chord);
        prove(goal_, outcome, task_);
        if (!in_one_piece(outcome.mesh)) return {};
        return outcome;
    }

    const Goal& goal_;
    std::size_t most_bytes_;
    const Task& task_;
    Frame frame_;
    TreeTarget target_;
};

}  // namespace

std::optional<Outcome> try_tree(const Goal& goal, std::size_t most_bytes, const Task& task) {
    return TreeSearch(goal, most_bytes, task).run();
}

}  // namespace pfgeom
