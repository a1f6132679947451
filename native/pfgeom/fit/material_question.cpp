#include "pfgeom/fit/material_question.h"

#include "pfgeom/base/sort_unique.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace pfgeom {
namespace {

// Candidates are compared on so many samples.
constexpr std::size_t kMostLookedAt = 3000;
// Directions of borders that are tried in a cell.
constexpr std::size_t kMostBorders = 12;
// Positions of cuts that are tried whatever the samples say: of so many bits at most.
constexpr int kCoarseBits = 4;

struct Direction {
    int axis = 0, bits = -1;  ///< bits < 0: without tilt, of any number of bits
    std::array<std::int32_t, 2> tilt{};
    friend bool operator==(const Direction&, const Direction&) = default;
};

/// A sample along a direction.
struct Along {
    double s = 0;
    std::uint32_t material = 0;  ///< counted in the cell, from 0
};

class QuestionSearch {
  public:
    QuestionSearch(const MaterialCell& cell, std::span<const MaterialSample> samples,
                   std::span<const BorderPiece> borders, const MaterialFit& options)
        : cell_(cell), samples_(samples), borders_(borders), options_(options) {
        const Vec3 size = cell.box.extent();
        half_ = std::max({size.x, size.y, size.z}) / 2;
        while (fine_ < kMostPlaneBits && std::ldexp(half_, -fine_) > options.least / 2) ++fine_;
        choose_samples();
    }

    std::optional<MaterialNode> run() {
        if (materials_.size() < 2) return {};
        for (int axis = 0; axis < 3; ++axis) look_along({axis, -1, {}});
        add_border_directions();
        add_discriminants();
        for (const Direction& d : directions_) look_along(d);
        if (best_score_ <= 0) return {};
        return best_;
    }

  private:
    void choose_samples() {
        std::vector<std::uint32_t> forced;
        for (const std::uint32_t i : cell_.samples) {
            if (samples_[i].forced()) forced.push_back(i);
        }
        const std::size_t step = 1 + forced.size() / kMostLookedAt;
        for (std::size_t k = 0; k < forced.size(); k += step) chosen_.push_back(forced[k]);
        for (const std::uint32_t i : chosen_) materials_.push_back(samples_[i].material);
        sort_unique(materials_);
        for (const std::uint32_t i : chosen_) {
            const auto at = std::lower_bound(materials_.begin(), materials_.end(), samples_[i].material);
            local_.push_back(static_cast<std::uint32_t>(at - materials_.begin()));
        }
    }

    // The plane across d, coarse and fine.
    void add_direction(const Vec3& d) {
        Direction direction;
        for (int axis = 1; axis < 3; ++axis) {
            if (std::abs(d[axis]) > std::abs(d[direction.axis])) direction.axis = axis;
        }
        if (!(std::abs(d[direction.axis]) > 0)) return;
        const double u = d[(direction.axis + 1) % 3] / d[direction.axis];
        const double v = d[(direction.axis + 2) % 3] / d[direction.axis];
        for (const int bits : {3, fine_}) {
            direction.bits = bits;
            const double one = std::ldexp(1.0, bits);
            direction.tilt = {static_cast<std::int32_t>(std::floor(u * one + 0.5)),
                              static_cast<std::int32_t>(std::floor(v * one + 0.5))};
            if (direction.tilt[0] == 0 && direction.tilt[1] == 0) continue;  // tried as a cut
            if (std::find(directions_.begin(), directions_.end(), direction) == directions_.end())
                directions_.push_back(direction);
        }
    }

    void add_border_directions() {
        const std::size_t n = cell_.borders.size(), step = 1 + n / kMostBorders;
        for (std::size_t i = 0; i < n; i += step) add_direction(borders_[cell_.borders[i]].across);
    }

    // Between the two materials with the most samples: Fisher's, the difference of the means where the spread
    // within them counts little.
    void add_discriminants() {
        std::vector<std::pair<std::size_t, std::uint32_t>> sizes;
        for (std::uint32_t m = 0; m < materials_.size(); ++m)
            sizes.emplace_back(static_cast<std::size_t>(std::count(local_.begin(), local_.end(), m)), m);
        std::sort(sizes.begin(), sizes.end(), [](const auto& a, const auto& b) {
            return a.first != b.first ? a.first > b.first : a.second < b.second;
        });
        const std::uint32_t a = sizes[0].second, b = sizes[1].second;
        const Vec3 mean_a = mean_of(a), mean_b = mean_of(b);
        std::array<double, 6> spread{};  // xx yy zz xy xz yz
        for (std::size_t k = 0; k < chosen_.size(); ++k) {
            if (local_[k] != a && local_[k] != b) continue;
            const Vec3 d = samples_[chosen_[k]].p - (local_[k] == a ? mean_a : mean_b);
            const std::array<double, 6> products{d.x * d.x, d.y * d.y, d.z * d.z,
                                                 d.x * d.y, d.x * d.z, d.y * d.z};
            for (std::size_t i = 0; i < 6; ++i) spread[i] += products[i];
        }
        const double some = 1e-3 * (spread[0] + spread[1] + spread[2]);
        for (std::size_t i = 0; i < 3; ++i) spread[i] += some;
        add_direction(solve(spread, mean_a - mean_b));
    }

    Vec3 mean_of(std::uint32_t material) const {
        Vec3 sum;
        double count = 0;
        for (std::size_t k = 0; k < chosen_.size(); ++k) {
            if (local_[k] == material) sum += samples_[chosen_[k]].p, count += 1;
        }
        return sum / count;
    }

    static Vec3 solve(const std::array<double, 6>& m, const Vec3& right) {
        const Vec3 x{m[0], m[3], m[4]}, y{m[3], m[1], m[5]}, z{m[4], m[5], m[2]};
        const double volume = dot(x, cross(y, z));
        if (!(std::abs(volume) > 0)) return {};
        return Vec3{dot(right, cross(y, z)), dot(x, cross(right, z)), dot(x, cross(y, right))} / volume;
    }

    void look_along(const Direction& d) {
        MaterialNode plane;
        plane.axis = static_cast<std::uint8_t>(d.axis);
        plane.bits = static_cast<std::uint8_t>(std::max(d.bits, 0));
        plane.tilt = d.tilt;
        derive(plane, cell_.box);  // with the offset 0
        along_.clear();
        for (std::size_t k = 0; k < chosen_.size(); ++k)
            along_.push_back({dot(plane.normal, samples_[chosen_[k]].p) - plane.level, local_[k]});
        std::sort(along_.begin(), along_.end(), [](const Along& a, const Along& b) {
            return a.s != b.s ? a.s < b.s : a.material < b.material;
        });
        sweep();
        if (d.bits >= 0) return try_gaps(plane, d.bits);
        for (int bits = 1; bits <= kCoarseBits; ++bits) try_lines(plane, bits);
        for (int bits = 5; bits <= fine_; ++bits) try_gaps(plane, bits);
    }

    // settled_[i]: by how much less the materials are mixed (Gini) if the first i are apart from the others.
    void sweep() {
        const std::size_t n = along_.size();
        std::vector<double> below(materials_.size()), above(materials_.size());
        for (const Along& a : along_) above[a.material] += 1;
        double squares_below = 0, squares_above = 0;
        for (const double count : above) squares_above += count * count;
        const double whole = squares_above / static_cast<double>(n);
        settled_.assign(n + 1, 0);
        for (std::size_t i = 0; i + 1 < n; ++i) {
            double &b = below[along_[i].material], &a = above[along_[i].material];
            squares_below += 2 * b + 1, b += 1;
            squares_above -= 2 * a - 1, a -= 1;
            const auto first = static_cast<double>(i + 1);
            settled_[i + 1] =
                squares_below / first + squares_above / (static_cast<double>(n) - first) - whole;
        }
    }

    double unit(int bits) const { return std::ldexp(half_, -bits); }

    void try_lines(MaterialNode plane, int bits) {
        const std::int32_t most = (1 << bits) - 1;
        for (std::int32_t offset = -most; offset <= most; offset += 1) {
            if (bits > 1 && offset % 2 == 0) continue;  // of fewer bits
            const double at = offset * unit(bits);
            const auto first = std::lower_bound(along_.begin(), along_.end(), at,
                                                [](const Along& a, double s) { return a.s < s; });
            offer(plane, bits, offset, static_cast<std::size_t>(first - along_.begin()));
        }
    }

    // Between neighbours of different materials, where a position of so many bits lies there.
    void try_gaps(MaterialNode plane, int bits) {
        const std::int32_t most = ((plane.is_cut() ? 1 : 3) << bits) - 1;
        for (std::size_t i = 1; i < along_.size(); ++i) {
            const Along &a = along_[i - 1], &b = along_[i];
            if (a.material == b.material || !(settled_[i] > 0)) continue;
            const double middle = std::floor((a.s + b.s) / 2 / unit(bits) + 0.5), at = middle * unit(bits);
            if (!(a.s < at && at <= b.s) || std::abs(middle) > most) continue;
            offer(plane, bits, static_cast<std::int32_t>(middle), i);
        }
    }

    void offer(MaterialNode& plane, int bits, std::int32_t offset, std::size_t first) {
        const int cost = 4 + bits + (plane.is_cut() ? 1 : 3 + 2 * bits);
        const double score = settled_[first] / (cost + options_.plane_weight);
        if (score <= best_score_) return;
        best_score_ = score;
        best_ = plane;
        best_.bits = static_cast<std::uint8_t>(bits);
        best_.offset = offset;
    }

    const MaterialCell& cell_;
    std::span<const MaterialSample> samples_;
    std::span<const BorderPiece> borders_;
    const MaterialFit& options_;
    double half_ = 1;
    int fine_ = 3;
    std::vector<std::uint32_t> chosen_, local_;  // rows of samples; the number of their material
    std::vector<std::int32_t> materials_;        // of the cell, rising
    std::vector<Direction> directions_;
    std::vector<Along> along_;
    std::vector<double> settled_;
    MaterialNode best_;
    double best_score_ = 0;
};

}  // namespace

std::optional<MaterialNode> find_material_question(const MaterialCell& cell,
                                                   std::span<const MaterialSample> samples,
                                                   std::span<const BorderPiece> borders,
                                                   const MaterialFit& options) {
    return QuestionSearch(cell, samples, borders, options).run();
}

}  // namespace pfgeom
