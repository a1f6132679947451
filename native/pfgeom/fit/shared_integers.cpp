#include "pfgeom/fit/shared_integers.h"

#include "pfgeom/base/parallel.h"
#include "pfgeom/base/random.h"
#include "pfgeom/base/reproducible.h"
#include "pfgeom/fit/family_rounding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <utility>

namespace pfgeom {
namespace {

// Measured on the coder: that a quadric is like another one, and for each integer whether it is the same.
constexpr double kLikeBits = 1, kBitsOfChoice = 0.8;  // times log2 of those it can be like
constexpr double kSameBits = 0.7, kTurnedBits = 0.4, kOtherBits = 1.3;
// The same integer is tried where it is so close to what least squares want: in units, or as a share of it.
constexpr double kClose = 3, kCloseShare = 0.1;
// Of the limits at the checks. What shares goes to the end of its room, and the mesh of such a tree has none
// for its chords: at 1, tri-plate_holes at 1e-3 takes 199 bytes instead of 164, since its mesh misses by 0.4
// % of the tolerance; at 0.9 less is shared (273 bytes become 277 at 5e-4).
constexpr double kRoom = 0.95;
constexpr double kLeastScale = 0.55, kMostScale = 1.75;
constexpr int kRounds = 3;  // eight find no more on fandisk and tri-plate_holes
// Who comes first decides who can follow: of 16 orders the best takes 1 to 5 % fewer bits than the first.
// Many quadrics take long, and find others like them anyway.
constexpr std::size_t kMostPairs = 65536;  // of quadrics, over all orders

/// The quadrics of one region that share integers with one other quadric.
class LikeSearch {
  public:
    LikeSearch(const FamilyRounding& rounding, const TreeQuadric& like, int resolution,
               std::vector<CheckPoint>& points, QuantisedQuadric& best)
        : rounding_(rounding), like_(like), resolution_(resolution), points_(points), best_(best), q_(like) {}

    // At the scales at which one of the integers is exactly the same. True if `best` became better.
    bool run(double bits) {
        if (rounding_.family().kind == FamilyKind::axis_plane) {
            walk(0, 1, {}, bits);
            return better_;
        }
        for (std::size_t i = 0; i < rounding_.size(); ++i) {
            const double wanted = std::abs(rounding_.best()[i]);
            if (like_.n[i] == 0 || wanted == 0) continue;
            const double scale = std::abs(value_of(like_.n[i], i)) / wanted;
            if (scale > kLeastScale && scale < kMostScale) walk(0, scale, {}, bits);
        }
        return better_;
    }

  private:
    double value_of(std::int32_t n, std::size_t i) const {
        return std::ldexp(static_cast<double>(n), -rounding_.exponent(like_, i, resolution_));
    }

    // Integers from i on, each the same or as it would be alone.
    void walk(std::size_t i, double scale, const Vector10& error, double bits) {
        if (bits >= best_.bits) return;
        if (i == rounding_.size()) return end(bits);
        const double wanted = rounding_.wanted(i, scale, error);
        const double n = std::ldexp(wanted, rounding_.exponent(like_, i, resolution_));
        const std::int32_t same = (n < 0) == (like_.n[i] < 0) ? like_.n[i] : -like_.n[i];
        if (std::abs(same - n) <= std::max(kClose, kCloseShare * std::abs(n)) || rounding_.is_direction(i))
            go_on(i, same, scale, error, bits + kSameBits + (same != 0 ? kTurnedBits : 0));
        const double alone = std::floor(n + 0.5);
        if (rounding_.is_direction(i) || alone == same || std::abs(alone) > kMostQuadricInteger) return;
        const auto integer = static_cast<std::int32_t>(alone);
        go_on(i, integer, scale, error, bits + kOtherBits + integer_bits(integer));
    }

    void go_on(std::size_t i, std::int32_t n, double scale, Vector10 error, double bits) {
        q_.n[i] = n;
        error[i] = value_of(n, i) - scale * rounding_.best()[i];
        walk(i + 1, scale, error, bits);
    }

    void end(double bits) {
        q_.quadric = expand(q_, resolution_);
        if (!rounding_.faces_inwards(q_.quadric) || !passes_in_turn(q_.quadric, points_)) return;
        best_.quadric = q_;
        best_.bits = bits;
        better_ = true;
    }

    const FamilyRounding& rounding_;
    const TreeQuadric& like_;
    int resolution_;
    std::vector<CheckPoint>& points_;
    QuantisedQuadric& best_;
    TreeQuadric q_;
    bool better_ = false;
};

//// Improves one quadric at a time. What others are written after stays as it is, so that no two are written
/// after each other. The places of quadrics are places in an order.
class Sharing {
  public:
    Sharing(const std::vector<RegionChecks>& checks, const std::vector<QuantisedQuadric>& quadrics,
            const std::vector<std::size_t>& order, int resolution, double normal_weight)
        : resolution_(resolution),
          normal_weight_(normal_weight),
          after_(order.size(), kNone),
          followers_(order.size(), 0),
          bits_(kLikeBits + kBitsOfChoice * reproducible_log2(static_cast<double>(order.size()) + 1)) {
        for (const std::size_t r : order) {
            checks_.push_back(checks[r]);
            for (CheckPoint& p : checks_.back().points) p.limit *= kRoom;
            quadrics_.push_back(quadrics[r]);
        }
    }

    // First each after those before it, then each after any other.
    std::vector<QuantisedQuadric> run(const Task& task) {
        for (int round = 0; round < kRounds; ++round) {
            bool changed = false;
            for (std::size_t r = 0; r < quadrics_.size(); ++r)
                changed = improve(r, round == 0 ? r : quadrics_.size(), task) || changed;
            if (!changed && round > 0) break;
        }
        return std::move(quadrics_);
    }

  private:
    static constexpr std::size_t kNone = SIZE_MAX;

    // Among the first `count`.
    bool improve(std::size_t r, std::size_t count, const Task& task) {
        if (followers_[r] > 0) return false;
        std::array<std::vector<std::size_t>, kQuadricFamilies> others;
        for (std::size_t k = 0; k < count; ++k) {
            if (k != r) others[quadrics_[k].quadric.family].push_back(k);
        }
        const QuadricSystem system = checks_[r].sums.system();
        std::size_t found = kNone;
        for (std::size_t f = 0; f < kQuadricFamilies; ++f) {
            if (others[f].empty()) continue;
            task.check();
            const FamilyRounding rounding(static_cast<std::uint8_t>(f), system, normal_weight_);
            const Quadric best = rounding.best_quadric();
            if (!rounding.faces_inwards(best) || !passes_in_turn(best, checks_[r].points)) continue;
            for (const std::size_t k : others[f]) {
                LikeSearch search(rounding, quadrics_[k].quadric, resolution_, checks_[r].points,
                                  quadrics_[r]);
                if (search.run(bits_)) found = k;
            }
        }
        if (found == kNone) return false;
        if (after_[r] != kNone) --followers_[after_[r]];
        after_[r] = found;
        ++followers_[found];
        return true;
    }

    std::vector<RegionChecks> checks_;
    std::vector<QuantisedQuadric> quadrics_;
    int resolution_;
    double normal_weight_;
    std::vector<std::size_t> after_;  // which one it is written after
    std::vector<int> followers_;
    double bits_;
};

double bits_of(const std::vector<QuantisedQuadric>& quadrics) {
    double sum = 0;
    for (const QuantisedQuadric& q : quadrics) sum += q.bits;
    return sum;
}

// The first as they are, the others shuffled.
std::vector<std::vector<std::size_t>> orders_of(std::size_t size, std::size_t count) {
    Random random(1);
    std::vector<std::size_t> order(size);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::vector<std::vector<std::size_t>> orders{order};
    while (orders.size() < count) {
        for (std::size_t i = size; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
        orders.push_back(order);
    }
    return orders;
}

}  // namespace

void share_integers(const std::vector<RegionChecks>& checks, int resolution, double normal_weight,
                    std::size_t tries, std::vector<QuantisedQuadric>& quadrics, const Task& task) {
    const std::size_t size = quadrics.size();
    const std::size_t affordable = kMostPairs / std::max<std::size_t>(size * size, 1);
    const auto orders = orders_of(size, std::clamp<std::size_t>(affordable, 1, tries));
    std::vector<std::vector<QuantisedQuadric>> found(orders.size());
    parallel_chunks(orders.size(), 1, task, [&](std::size_t t, std::size_t) {
        found[t] = Sharing(checks, quadrics, orders[t], resolution, normal_weight).run(quiet(task, 1));
    });
    const auto best = static_cast<std::size_t>(std::ranges::min_element(found, {}, bits_of) - found.begin());
    for (std::size_t i = 0; i < size; ++i) quadrics[orders[best][i]] = found[best][i];
}

}  // namespace pfgeom
