#include "pfgeom/compress/mend_tree.h"

#include "pfgeom/base/random.h"
#include "pfgeom/report/tree_bound.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pfgeom {
namespace {

// What is not nearly mended after kHopefulRounds is hopeless: with more counter-examples than kFew, or more
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
// Cells at the border of the tube while there is something to mend: finer ones cost time and find no more.
constexpr double kRoughest = 1.0 / 16;
// Of what is certified, where the final certificate looks: what its cells leave open then stays below it.
constexpr double kProofShare = 0.985;
// Labels that a certificate gives besides: more make mending slower, not better.
constexpr std::size_t kLabels = 10'000;
// Points beside a counter-example, and how far away, in tolerances.
constexpr std::size_t kBeside = 3, kMostJittered = 10'000;
constexpr double kJitter = 0.7;

class Mender {
  public:
    Mender(TreeFit& fit, TreeFitOptions& options, const TreeTarget& target, double certified,
           const Task& task)
        : fit_(fit), options_(options), target_(target), certified_(certified), task_(task) {}

    std::optional<double> run(double most_bits) {
        for (int round = 0; round < kMostRounds;) {
            const double reach = (round < kCalmRound ? 1 : kCalmShare) * options_.tolerance;
            TreeBound bound = rough_bound(reach);
            if (!bound.sides_defined || bound.counts.unresolved > kMostUnresolved) return {};
            if (round >= kHopefulRounds && bound.counter_examples.size() > kFew) return {};
            if (nearly_holds(bound)) {
                TreeBoundOptions fine;
                fine.labels = 0;
                const TreeBound exact = bound_of(kProofShare * certified_, fine);
                if (exact.holds(certified_)) return exact.proved;
                append(exact.counter_examples, bound.counter_examples);
                append(exact.missed, bound.missed);
            }
            if (bound.counter_examples.empty() && bound.missed.empty()) return {};
            if (bound.counter_examples.empty() && fit_.mostly_whole() && holds_ < kMostHolds) {
                hold(bound.missed);
                continue;
            }
            ++round;
            repair_set_tree(fit_, target_.bvh, evidence(bound, reach), task_);
            if (fit_.bits > most_bits) return {};
        }
        return {};
    }

  private:
    TreeBound bound_of(double reach, const TreeBoundOptions& options) const {
        return bound_tree(fit_.tree, target_.mesh, target_.bvh, reach, options, task_);
    }

    TreeBound rough_bound(double reach) const {
        TreeBoundOptions rough;
        rough.finest = kRoughest;
        rough.labels = kLabels;
        rough.max_cells = kMostCells;
        return bound_of(reach, rough);
    }

    bool nearly_holds(const TreeBound& bound) const {
        return bound.missed.empty() &&
               std::ranges::all_of(bound.counter_examples, [&](const LabelledPoint& p) {
                   return p.distance <= kProofShare * certified_;
               });
    }

    void hold(const std::vector<LabelledPoint>& missed) {
        ++holds_;
        held_ *= kHold;
        for (const LabelledPoint& p : missed) options_.held.push_back({p.point, held_});
        refit_set_tree(fit_, target_.mesh, target_.bvh, options_, task_);
    }

    static void append(const std::vector<LabelledPoint>& more, std::vector<LabelledPoint>& list) {
        list.insert(list.end(), more.begin(), more.end());
    }

    // All that the certificate has labelled; about its counter-examples, whose cells are small, points beside
    // them as well: else the next one lies there.
    std::vector<KnownSide> evidence(const TreeBound& bound, double reach) {
        std::vector<KnownSide> points;
        for (const auto* list : {&bound.counter_examples, &bound.missed, &bound.labels}) {
            for (const LabelledPoint& p : *list) points.push_back({p.point, p.inside});
        }
        const std::size_t count = std::min(bound.counter_examples.size(), kMostJittered);
        for (std::size_t i = 0; i < kBeside * count; ++i) {
            const LabelledPoint& known = bound.counter_examples[i % count];
            Vec3 p = known.point;
            for (int axis = 0; axis < 3; ++axis) p[axis] += kJitter * reach * (2 * random_.uniform() - 1);
            const SignedClosest closest = target_.distance(p, known.face);
            if (std::abs(closest.distance) > reach) points.push_back({p, closest.distance > 0});
        }
        return points;
    }

    TreeFit& fit_;
    TreeFitOptions& options_;
    const TreeTarget& target_;
    double certified_;
    const Task& task_;
    Random random_{1};
    int holds_ = 0;
    double held_ = 1;
};

}  // namespace

std::optional<double> mend_tree(TreeFit& fit, TreeFitOptions& options, const TreeTarget& target,
                                double certified, double most_bits, const Task& task) {
    return Mender(fit, options, target, certified, task).run(most_bits);
}

}  // namespace pfgeom
