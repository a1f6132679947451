#include "pfgeom/fit/rate_model.h"

#include "pfgeom/base/reproducible.h"

#include <algorithm>
#include <bit>
#include <cstdlib>

namespace pfgeom {
namespace {

// Bins of magnitudes, even on the scale of log(1 + 8 a).
constexpr std::array<double, 7> kNearLimits{0.080, 0.21, 0.43, 0.78, 1.36, 2.3, 3.9};
constexpr std::array<double, 4> kParentLimits{0.17, 0.58, 1.6, 3.9};

}  // namespace

RateModel::RateModel(const Level& level, const Surroundings& surroundings) : level_(level) {
    const std::size_t n = level.centres.size();
    first_.assign(n + 1, 0);
    for (std::size_t i = 0; i < n; ++i) {
        for (const Neighbour& e : surroundings.of(i)) {
            ++first_[i + 1];
            ++first_[static_cast<std::size_t>(e.index) + 1];
        }
    }
    for (std::size_t i = 0; i < n; ++i) first_[i + 1] += first_[i];
    neighbours_.resize(first_.back());
    std::vector<std::uint32_t> at(first_.begin(), first_.end() - 1);
    parent_bin_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double parent = surroundings.parent[i] / 16.0;
        parent_bin_[i] = static_cast<std::uint8_t>(
            std::ranges::count_if(kParentLimits, [=](double x) { return parent >= x; }));
        for (const Neighbour& e : surroundings.of(i)) {
            neighbours_[at[i]++] = e;
            neighbours_[at[static_cast<std::size_t>(e.index)]++] = {static_cast<std::int32_t>(i), e.weight};
        }
    }
}

std::size_t RateModel::class_of(std::int32_t z) {
    return static_cast<std::size_t>(std::bit_width(static_cast<std::uint32_t>(std::abs(z))));
}

std::size_t RateModel::bin(std::size_t i) const {
    std::int64_t magnitude = 0, weight = 0;
    for (const Neighbour& e : neighbours(i)) {
        magnitude += std::int64_t{e.weight} * std::abs(level_.z[static_cast<std::size_t>(e.index)]);
        weight += e.weight;
    }
    std::size_t near = 0;
    for (const double limit : kNearLimits)
        near += static_cast<double>(magnitude) >= limit * static_cast<double>(weight);
    return (weight > 0 ? near * kParentBins : 0) + parent_bin_[i];
}

void RateModel::measure() {
    constexpr std::size_t kBins = kNearBins * kParentBins;
    std::vector<double> counts(kBins * kClasses, 0);
    std::array<double, kClasses> all{};
    all.fill(0.2);
    double total = 0.2 * kClasses;
    for (std::size_t i = 0; i < level_.z.size(); ++i) {
        const std::size_t c = class_of(level_.z[i]);
        ++counts[bin(i) * kClasses + c];
        ++all[c];
        ++total;
    }
    costs_.assign(kBins * kClasses, 0);
    for (std::size_t b = 0; b < kBins; ++b) {
        double sum = 0;
        for (std::size_t c = 0; c < kClasses; ++c) {
            counts[b * kClasses + c] += 4 * all[c] / total;
            sum += counts[b * kClasses + c];
        }
        for (std::size_t c = 0; c < kClasses; ++c) {
            const double signs = c > 0 ? 1 + 0.97 * static_cast<double>(c - 1) : 0;  // sign and mantissa
            costs_[b * kClasses + c] = reproducible_log2(sum / counts[b * kClasses + c]) + signs;
        }
    }
}

double RateModel::total() const {
    double sum = 0;
    for (std::size_t i = 0; i < level_.z.size(); ++i) sum += bits(i, level_.z[i]);
    return sum;
}

}  // namespace pfgeom
