#include "pfgeom/compress/place_copies.h"

#include "pfgeom/codec/placement_codec.h"
#include "pfgeom/function/frame.h"
#include "pfgeom/function/moved_box.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace pfgeom {
namespace {

// Eighths of octaves of the turns' steps, up to Placements::kMostSteps.
constexpr int kFinestTurn = 8 * 20;
// Of the error, what the scales may take.
constexpr double kScaleShare = 0.25;
// Half the diagonal of a cell of places, in steps.
constexpr double kHalfDiagonal = 0.8660254037844387;

using Turn = std::array<std::int32_t, 4>;

class CopyPlacer {
  public:
    CopyPlacer(std::span<const Similarity> places, const Box& box, const Vec3& centre, double error)
        : places_(places), centre_(centre), error_(error), turns_(places.size()) {
        for (unsigned i = 0; i < 8; ++i) {
            corners_[i] = corner_of(box, i) - centre;
            radius_ = std::max(radius_, norm(corners_[i]));
        }
        for (const Similarity& s : places) turns_of_.push_back(turn_of(s));
    }

    PlacedCopies run() {
        PlacedCopies result;
        if (!choose_scales() || !choose_steps() || !set_places()) return result;
        result.order.resize(places_.size());
        std::iota(result.order.begin(), result.order.end(), std::size_t{0});
        std::stable_sort(result.order.begin(), result.order.end(), [this](std::size_t a, std::size_t b) {
            return p_.list[a].place[0] < p_.list[b].place[0];
        });
        normalise(p_);
        result.placements = std::move(p_);
        if (!find_flaw(result.placements).empty()) result = {};
        return result;
    }

  private:
    static bool is_mirrored(const Similarity& s) { return dot(s.rows[0], cross(s.rows[1], s.rows[2])) < 0; }

    // What is left when a reflection in x came first.
    static std::array<Vec3, 3> turn_of(const Similarity& s) {
        std::array<Vec3, 3> rows = s.rows;
        if (is_mirrored(s)) {
            for (Vec3& row : rows) row.x = -row.x;
        }
        return rows;
    }

    bool choose_scales() {
        p_.list.resize(places_.size());
        const auto grows = [](const Similarity& s) { return s.scale != 1; };
        if (std::any_of(places_.begin(), places_.end(), grows)) {
            const double steps = std::ceil(radius_ / (2 * kScaleShare * error_));
            if (!(steps <= Placements::kMostSteps)) return false;
            p_.scale_steps = static_cast<std::int32_t>(steps);
        }
        for (std::size_t i = 0; i < places_.size(); ++i) {
            const double scale = std::floor(places_[i].scale * p_.scale_steps + 0.5);
            if (!(scale <= Placements::kMostScale)) return false;
            p_.list[i].scale = std::max(1, static_cast<std::int32_t>(scale));
            p_.list[i].mirrored = is_mirrored(places_[i]);
        }
        return true;
    }

    // Finer turns leave the places coarser steps; the product of both says how many bits a copy takes.
    bool choose_steps() {
        double fewest = 0;
        std::int32_t turn_steps = 0;
        for (int code = 0; code <= kFinestTurn; ++code) {
            const auto steps = static_cast<std::int32_t>(std::floor(exp2_eighths(code) + 0.5));
            const double left = error_ - worst_turn(steps);
            if (left <= 0) continue;
            const double bits = steps / left;
            if (turn_steps == 0 || bits < fewest) fewest = bits, turn_steps = steps;
            if (left > 0.95 * error_) break;
        }
        if (turn_steps == 0) return false;
        p_.turn_steps = turn_steps;
        const double worst = worst_turn(turn_steps);
        set_turns(worst);
        int code = 8 * std::ilogb(error_) + 16;
        while (code >= Frame::kMinScale && kHalfDiagonal * exp2_eighths(code) > error_ - worst) --code;
        p_.step_code = code;
        return code >= Frame::kMinScale;
    }

    // How far the corners of the box move.
    double error_of(std::size_t i, const Turn& turn) const {
        const std::array<Vec3, 3> rounded =
            rotation_of({static_cast<double>(turn[0]), static_cast<double>(turn[1]),
                         static_cast<double>(turn[2]), static_cast<double>(turn[3])});
        const double scale = static_cast<double>(p_.list[i].scale) / p_.scale_steps;
        double worst = 0;
        for (const Vec3& corner : corners_) {
            const Vec3 p{p_.list[i].mirrored ? -corner.x : corner.x, corner.y, corner.z};
            Vec3 off;
            for (int k = 0; k < 3; ++k) {
                const auto row = static_cast<std::size_t>(k);
                off[k] = scale * dot(rounded[row], p) - places_[i].scale * dot(turns_of_[i][row], p);
            }
            worst = std::max(worst, squared_norm(off));
        }
        return std::sqrt(worst);
    }

    double worst_turn(std::int32_t steps) {
        double worst = 0;
        for (std::size_t i = 0; i < places_.size() && worst < error_; ++i) {
            turns_[i] = quantise_turn(turns_of_[i], steps);
            worst = std::max(worst, error_of(i, turns_[i]));
        }
        return worst;
    }

    // Where a turn that another copy has will do, it costs next to nothing.
    void set_turns(double most) {
        std::vector<Turn> recent;
        for (std::size_t i = 0; i < places_.size(); ++i) {
            const auto known = std::find_if(recent.rbegin(), recent.rend(),
                                            [&](const Turn& turn) { return error_of(i, turn) <= most; });
            p_.list[i].turn = known == recent.rend() ? turns_[i] : *known;
            if (known == recent.rend()) recent.push_back(turns_[i]);
            if (recent.size() > kRecentTurns) recent.erase(recent.begin());
        }
    }

    bool set_places() {
        const double step = exp2_eighths(p_.step_code);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto k = static_cast<int>(axis);
            std::vector<double> at;
            for (const Similarity& s : places_) at.push_back(std::floor(s.apply(centre_)[k] / step + 0.5));
            const auto [least, most] = std::minmax_element(at.begin(), at.end());
            if (!(std::abs(*least) < static_cast<double>(Frame::kMaxOffset)) ||
                !(*most - *least < Placements::kMostPlace)) {
                return false;
            }
            p_.origin[axis] = static_cast<std::int64_t>(*least);
            for (std::size_t i = 0; i < at.size(); ++i)
                p_.list[i].place[axis] = static_cast<std::int32_t>(at[i] - *least);
        }
        return true;
    }

    std::span<const Similarity> places_;
    Vec3 centre_;
    double error_;
    std::vector<Turn> turns_;
    std::vector<std::array<Vec3, 3>> turns_of_;
    std::array<Vec3, 8> corners_;
    double radius_ = 0;
    Placements p_;
};

}  // namespace

PlacedCopies place_copies(std::span<const Similarity> places, const Box& box, const Vec3& centre,
                          double error) {
    return CopyPlacer(places, box, centre, error).run();
}

}  // namespace pfgeom
