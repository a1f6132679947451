#include "pfgeom/compress/mend_tree.h"

#include "pfgeom/base/parallel.h"
#include "pfgeom/base/random.h"
#include "pfgeom/report/tree_bound.h"

#include <algorithm>
#include <cmath>
#include <optional>
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
// to so much less there: leaves that grow would cut the pit out of them one after the other. Steps of 0.4
// took three times with a certificate each where one of 0.06 does, at the same bytes.
constexpr int kMostHolds = 4;
constexpr double kHold = 0.06;
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
    Mender(TreeCandidate& tree, const TreeTarget& target, double certified)
        : fit_(tree.fit),
          options_(tree.options),
          proved_(tree.proved),
          target_(target),
          certified_(certified) {}

    bool ended() const { return given_up_ || proved_ > 0; }
    bool certified() const { return proved_ > 0; }
    double bits() const { return fit_.bits; }

    // A certificate, and the repair of what it finds.
    void round(const Task& task) {
        // What nearly held the last time often holds now: then the rough look is not needed.
        std::optional<TreeBound> exact;
        if (nearly_) exact = prove(task);
        if (certified()) return;
        TreeBound bound = rough_bound(task);
        if (hopeless(bound)) return give_up();
        nearly_ = nearly_holds(bound);
        if (nearly_ && !exact) exact = prove(task);
        if (certified()) return;
        if (exact) {
            append(exact->counter_examples, bound.counter_examples);
            append(exact->missed, bound.missed);
        }
        if (bound.counter_examples.empty() && bound.missed.empty()) return give_up();
        if (bound.counter_examples.empty() && fit_.mostly_whole() && holds_ < kMostHolds)
            return hold(bound.missed, task);
        repair_set_tree(fit_, target_.bvh, evidence(bound), task);
        if (++rounds_ == kMostRounds) give_up();
    }

  private:
    void give_up() { given_up_ = true; }

    // Where counter-examples are looked for.
    double reach() const { return (rounds_ < kCalmRound ? 1 : kCalmShare) * options_.tolerance; }

    TreeBound bound_of(double reach, const TreeBoundOptions& options, const Task& task) const {
        return bound_tree(fit_.tree, target_.mesh, target_.bvh, reach, options, task);
    }

    TreeBound rough_bound(const Task& task) const {
        TreeBoundOptions rough;
        rough.finest = kRoughest;
        rough.labels = kLabels;
        rough.max_cells = kMostCells;
        rough.max_unresolved = kMostUnresolved;
        return bound_of(reach(), rough, task);
    }

    TreeBound prove(const Task& task) {
        TreeBoundOptions fine;
        fine.labels = 0;
        TreeBound bound = bound_of(kProofShare * certified_, fine, task);
        if (bound.holds(certified_)) proved_ = bound.proved;
        return bound;
    }

    bool hopeless(const TreeBound& bound) const {
        return !bound.sides_defined || bound.counts.unresolved > kMostUnresolved ||
               (rounds_ >= kHopefulRounds && bound.counter_examples.size() > kFew);
    }

    bool nearly_holds(const TreeBound& bound) const {
        return bound.missed.empty() &&
               std::ranges::all_of(bound.counter_examples, [&](const LabelledPoint& p) {
                   return p.distance <= kProofShare * certified_;
               });
    }

    // Until it makes a difference. Nothing else was wrong.
    void hold(const std::vector<LabelledPoint>& missed, const Task& task) {
        nearly_ = true;
        const SetTree before = fit_.tree;
        while (holds_ < kMostHolds && fit_.tree == before) {
            ++holds_;
            held_ *= kHold;
            for (const LabelledPoint& p : missed) options_.held.push_back({p.point, held_});
            refit_set_tree(fit_, target_.mesh, target_.bvh, options_, task);
        }
    }

    static void append(const std::vector<LabelledPoint>& more, std::vector<LabelledPoint>& list) {
        list.insert(list.end(), more.begin(), more.end());
    }

    // All that the certificate has labelled; about its counter-examples, whose cells are small, points beside
    // them as well: else the next one lies there.
    std::vector<KnownSide> evidence(const TreeBound& bound) {
        std::vector<KnownSide> points;
        for (const auto* list : {&bound.counter_examples, &bound.missed, &bound.labels}) {
            for (const LabelledPoint& p : *list) points.push_back({p.point, p.inside});
        }
        const std::size_t count = std::min(bound.counter_examples.size(), kMostJittered);
        for (std::size_t i = 0; i < kBeside * count; ++i) {
            const LabelledPoint& known = bound.counter_examples[i % count];
            Vec3 p = known.point;
            for (int axis = 0; axis < 3; ++axis) p[axis] += kJitter * reach() * (2 * random_.uniform() - 1);
            const SignedClosest closest = target_.distance(p, known.face);
            if (std::abs(closest.distance) > reach()) points.push_back({p, closest.distance > 0});
        }
        return points;
    }

    TreeFit& fit_;
    TreeFitOptions& options_;
    double& proved_;
    const TreeTarget& target_;
    double certified_;
    bool given_up_ = false;
    bool nearly_ = false;  // at the last rough look, but for what has been mended by holding
    int rounds_ = 0;
    Random random_{1};
    int holds_ = 0;
    double held_ = 1;
};

}  // namespace

void mend_trees(std::span<TreeCandidate> trees, const TreeTarget& target, double certified, double most_bits,
                const Task& task) {
    std::vector<Mender> menders;
    for (TreeCandidate& tree : trees) menders.emplace_back(tree, target, certified);
    std::vector<Mender*> open;
    for (Mender& mender : menders) open.push_back(&mender);
    for (;;) {
        std::erase_if(open, [&](const Mender* m) { return m->ended() || m->bits() > most_bits; });
        if (open.empty()) return;
        const int threads = std::max(1, thread_count(task) / static_cast<int>(open.size()));
        parallel_chunks(open.size(), 1, task,
                        [&](std::size_t i, std::size_t) { open[i]->round(quiet(task, threads)); });
        for (const Mender* m : open)
            if (m->certified()) most_bits = std::min(most_bits, m->bits());
    }
}

}  // namespace pfgeom
