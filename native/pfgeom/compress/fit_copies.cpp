#include "pfgeom/compress/fit_copies.h"

#include "pfgeom/base/parallel.h"
#include "pfgeom/codec/codec.h"
#include "pfgeom/compress/place_copies.h"
#include "pfgeom/mesh/mesh.h"
#include "pfgeom/segment/natural_axes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <span>
#include <tuple>
#include <utility>

namespace pfgeom {
namespace {

// Of the tolerance, what the pattern leaves to the placements' rounding: much where many copies share one
// pattern. A halved share costs each copy some six bits, and a part of twenty quadrics eighty at a tolerance
// that is halved. Which tolerance makes another tree of a pattern is its own affair, so half the share is
// tried as well (100 bolts and 20 brackets at 1e-3 and 1e-4: 785 and 1,465 bytes with the first, 846 and
// 1,443 with 0.5 of it at most).
std::array<double, 2> shares_of_placements(std::size_t copies) {
    const auto n = static_cast<double>(copies);
    const double share = std::clamp(n / (n + 20), 0.15, 0.75);
    return {share, share / 2};
}
// The rounding is tried at so many times its share: pattern and placement are seldom at their worst in the
// same place.
constexpr double kRoundings[] = {1.6, 1.25, 1, 0.7};
// What a file takes beside its one object, and a mesh alone beside a mesh in a larger one: bytes.
constexpr std::size_t kHead = 24;
constexpr std::size_t kLeastGain = 8;

class CopiesFit {
  public:
    CopiesFit(const CopyGroup& group, const CopiesGoal& goal, const Task& task)
        : goal_(goal), task_(task), group_(group) {}

    std::optional<FittedCopies> run() {
        lay_out_pattern();
        const std::size_t tries = goal_.effort == Effort::fast ? 1 : 2;
        const std::array<double, 2> shares = shares_of_placements(group_.size());
        for (const double share : std::span(shares).first(tries)) {
            if (group_.size() > 1 && fit_pattern(share)) place_and_prove(share * goal_.tolerance);
            if (of_pattern_.candidate != "tree") break;  // others change little by little
        }
        return std::move(best_);
    }

  private:
    // The first island in its natural pose, with the middle of its box in the origin.
    void lay_out_pattern() {
        pattern_ = extract_island(goal_.prepared, first());
        Similarity turn;
        turn.rows = natural_axes(pattern_);
        for (Vec3& v : pattern_.vertices) v = turn.apply(v);
        const Vec3 middle = bounds(pattern_).centre();
        for (Vec3& v : pattern_.vertices) v = v - middle;
        turn.translation = -middle;
        const Similarity back = inverse_of(turn);
        for (const Copy& copy : group_) places_.push_back(composed(copy.place, back));
    }

    const Island& first() const { return goal_.prepared.islands[group_.front().island]; }

    Goal goal_for(const TriangleMesh& mesh, const Bvh& bvh, double tolerance) const {
        const bool inward = first().closed && first().signed_volume < 0;
        return {mesh,   bvh,          tolerance,     goal_.metric, goal_.prepared.diagonal,
                inward, goal_.effort, goal_.painted, true};
    }

    // Within what the share leaves.
    bool fit_pattern(double share) {
        double largest = 1;
        for (const Similarity& s : places_) largest = std::max(largest, s.scale);
        const Bvh bvh(pattern_);
        const Goal goal = goal_for(pattern_, bvh, (1 - share) * goal_.tolerance / largest);
        std::optional<Outcome> outcome = fit_island(first(), goal, task_);
        if (!outcome) outcome = try_mesh(goal, {}, kAnyBytes, task_);
        if (!outcome->holds) return false;
        of_pattern_ = *std::move(outcome);
        alone_ = of_pattern_.bytes;
        // One quadric may hold with all of the tolerance where it does not with what placements leave of it.
        if (first().closed && first().oriented && of_pattern_.candidate != "quadric") {
            const auto whole = try_quadric(goal_for(pattern_, bvh, goal_.tolerance), task_);
            if (whole) alone_ = std::min(alone_, whole->bytes);
        }
        return true;
    }

    // With the coarsest rounding that holds, if that takes fewer bytes than the best so far.
    void place_and_prove(double error) {
        for (const double rounding : kRoundings) {
            if (!place(rounding * error) || !pays()) return;
            prove_copies();
            if (keep()) return;
        }
        if (!best_ && leave_out_missed() && place(kRoundings[std::size(kRoundings) - 1] * error) && pays()) {
            prove_copies();
            keep();
        }
    }

    bool keep() {
        if (!result_.outcome.holds) return false;
        best_ = std::move(result_);
        return true;
    }

    bool place(double error) {
        const PlacedCopies placed =
            place_copies(places_, bounds(pattern_), of_pattern_.object.frame.centre(), error);
        if (placed.placements.empty()) return false;
        result_.outcome = of_pattern_;
        result_.outcome.object.placements = placed.placements;
        result_.islands.clear();
        for (const std::size_t i : placed.order) result_.islands.push_back(group_[i].island);
        return true;
    }

    Model model_of_copies() const {
        const Bvh none{TriangleMesh{}};
        return model_of(goal_for(pattern_, none, goal_.tolerance), result_.outcome);
    }

    // Against as many islands one by one. Functions of parts that stand askew have more integers: planes
    // four instead of two, cylinders ten instead of four or five.
    bool pays() {
        result_.outcome.bytes = encode(model_of_copies()).size();
        const std::size_t one = alone_ - std::min(alone_, kHead);
        const std::size_t more = of_pattern_.candidate == "tree" && stand_askew() ? 2 : 1;
        const std::size_t single = kHead + group_.size() * more * one;
        return result_.outcome.bytes + kLeastGain < single &&
               (!best_ || result_.outcome.bytes < best_->outcome.bytes);
    }

    bool stand_askew() const {
        return std::any_of(places_.begin(), places_.end(), [](const Similarity& s) {
            return std::any_of(s.rows.begin(), s.rows.end(), [](const Vec3& row) {
                return std::max({std::abs(row.x), std::abs(row.y), std::abs(row.z)}) < 1 - 1e-9;
            });
        });
    }

    // On the bytes: the outcome holds if every copy does.
    void prove_copies() {
        Outcome& all = result_.outcome;
        all.holds = false;
        missed_.assign(result_.islands.size(), 1);
        const Result<Model> decoded = decode(encode(model_of_copies()));
        if (!decoded) return;
        all.functions = decoded->functions;
        all.object = decoded->objects.front();
        all.mesh = to_mesh(*decoded, {.thin = !goal_.painted}, quiet(task_, task_.threads));
        std::vector<Measured> measured(result_.islands.size());
        std::vector<double> bounds(result_.islands.size());
        parallel_chunks(measured.size(), 1, task_, [&](std::size_t i, std::size_t) {
            std::tie(measured[i], bounds[i]) = measure_copy(i, quiet(task_, 1));
        });
        all.deviation = {};
        all.bound_functions = 0;
        for (std::size_t i = 0; i < measured.size(); ++i) {
            missed_[i] = measured[i].holds ? 0 : 1;
            take_maximum(measured[i].deviation, all.deviation);
            all.bound_functions = std::max(all.bound_functions, bounds[i]);
        }
        all.deviation.certified = std::all_of(measured.begin(), measured.end(),
                                              [](const Measured& m) { return m.deviation.certified; });
        if (std::any_of(bounds.begin(), bounds.end(), [](double b) { return b == 0; }))
            all.bound_functions = 0;
        all.holds = std::count(missed_.begin(), missed_.end(), 0) == std::ssize(missed_);
    }

    // The deviation, and what is then proved of the functions' own surface there; 0: nothing.
    std::pair<Measured, double> measure_copy(std::size_t i, const Task& task) const {
        const Island& island = goal_.prepared.islands[result_.islands[i]];
        const TriangleMesh mesh = extract_island(goal_.prepared, island);
        const Bvh bvh(mesh);
        const Goal goal = goal_for(mesh, bvh, goal_.tolerance);
        Measured measured = measure(goal, mesh_of_copy(i), task);
        if (!measured.holds || of_pattern_.bound_functions == 0) return {measured, 0};
        // The surface is so far from the pattern, and the pattern, placed, so far from the island.
        const Similarity s = placement(i);
        const double near = s.scale * of_pattern_.bound_functions;
        DeviationOptions options;
        options.samples = 0;
        const Deviation moved = measure_deviation(mesh, placed(pattern_, s), options, task);
        const double bound = near + moved.max_bound();
        if (goal_.metric == Metric::max && bound > goal_.tolerance) measured.holds = false;
        return {measured, moved.certified ? bound : 0};
    }

    Similarity placement(std::size_t i) const {
        const Object& object = result_.outcome.object;
        return object.placements.similarity(i, object.frame.centre());
    }

    static TriangleMesh placed(TriangleMesh mesh, const Similarity& s) {
        for (Vec3& v : mesh.vertices) v = s.apply(v);
        return mesh;
    }

    TriangleMesh mesh_of_copy(std::size_t i) const {
        const TriangleMesh& all = result_.outcome.mesh;
        const std::size_t n = result_.islands.size();
        const std::size_t vertices = all.vertices.size() / n, faces = all.faces.size() / n;
        TriangleMesh mesh;
        const auto first = static_cast<std::ptrdiff_t>(i * vertices);
        mesh.vertices.assign(all.vertices.begin() + first,
                             all.vertices.begin() + first + static_cast<std::ptrdiff_t>(vertices));
        for (std::size_t f = i * faces; f < (i + 1) * faces; ++f) {
            Triangle t = all.faces[f];
            for (std::int32_t& v : t) v -= static_cast<std::int32_t>(first);
            mesh.faces.push_back(t);
        }
        return mesh;
    }

    // Copies that are no copies at this tolerance are for themselves. Are there others?
    bool leave_out_missed() {
        const CopyGroup group = std::move(group_);
        const std::vector<Similarity> places = std::move(places_);
        group_.clear();
        places_.clear();
        for (std::size_t i = 0; i < group.size(); ++i) {
            const auto at = std::find(result_.islands.begin(), result_.islands.end(), group[i].island);
            if (missed_[static_cast<std::size_t>(at - result_.islands.begin())] != 0) continue;
            group_.push_back(group[i]);
            places_.push_back(places[i]);
        }
        return group_.size() >= 2 && group_.size() < group.size();
    }

    const CopiesGoal& goal_;
    const Task& task_;
    CopyGroup group_;
    TriangleMesh pattern_;
    std::vector<Similarity> places_;  // of the pattern, as exactly as they are known
    Outcome of_pattern_;
    std::size_t alone_ = 0;  // bytes of an island by itself
    std::vector<int> missed_;
    FittedCopies result_;
    std::optional<FittedCopies> best_;
};

}  // namespace

std::optional<FittedCopies> fit_copies(const CopyGroup& group, const CopiesGoal& goal, const Task& task) {
    return CopiesFit(group, goal, task).run();
}

}  // namespace pfgeom
