#include "pfgeom/fit/quantiser.h"

#include "pfgeom/base/reproducible.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace pfgeom {
namespace {

constexpr double kRidge = 0.05;       // of the mean energy (1 %: +1.6 % bytes)
constexpr double kRoundToZero = 0.6;  // values below this start as zero
constexpr std::size_t kNearBins = 8, kParentBins = 5, kClasses = 18;

std::size_t class_of(std::int32_t z) {
    return static_cast<std::size_t>(std::bit_width(static_cast<std::uint32_t>(std::abs(z))));
}

// min(n - 1, floor(s · log2(1 + 8 a))) for a magnitude a in sixteenths.
std::size_t magnitude_bin(double sixteenths, double s, std::size_t n) {
    const double b = s * reproducible_log2(1 + sixteenths / 2);
    return std::min(n - 1, static_cast<std::size_t>(b));
}

}  // namespace

Quantiser::Quantiser(Level& level, const Columns& columns, const LevelSamples& samples,
                     const Surroundings& surroundings)
    : level_(level), columns_(columns), surroundings_(surroundings) {
    const std::size_t n = level.centres.size();
    value_.resize(samples.values.size());
    lo_ = samples.lo;
    hi_ = samples.hi;
    for (std::size_t s = 0; s < value_.size(); ++s) {
        const double w = samples.weights[s];
        value_[s] = w * samples.values[s];
        lo_[s] = static_cast<float>(w * lo_[s]);
        hi_[s] = static_cast<float>(w * hi_[s]);
    }
    first_.assign(n + 1, 0);
    for (std::size_t i = 0; i < n; ++i) {
        for (const Neighbour& e : surroundings.of(i)) {
            ++first_[i + 1];
            ++first_[static_cast<std::size_t>(e.index) + 1];
        }
    }
    for (std::size_t i = 0; i < n; ++i) first_[i + 1] += first_[i];
    both_.resize(first_.back());
    std::vector<std::uint32_t> at(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < n; ++i) {
        for (const Neighbour& e : surroundings.of(i)) {
            both_[at[i]++] = e;
            both_[at[static_cast<std::size_t>(e.index)]++] = {static_cast<std::int32_t>(i), e.weight};
        }
    }
    level_.z.assign(n, 0);
}

double Quantiser::distortion() const {
    double sum = 0;
    for (std::size_t s = 0; s < value_.size(); ++s) {
        const double r = residual(static_cast<std::int32_t>(s));
        sum += r * r;
    }
    return sum;
}

double Quantiser::slope(std::size_t i) const {
    double sum = 0;
    for (std::uint32_t k = columns_.first[i]; k < columns_.first[i + 1]; ++k) {
        sum += columns_.entries[k].slope * residual(columns_.entries[k].sample);
    }
    return sum;
}

void Quantiser::move(std::size_t i, double change) {
    if (change == 0) return;
    for (std::uint32_t k = columns_.first[i]; k < columns_.first[i + 1]; ++k) {
        value_[static_cast<std::size_t>(columns_.entries[k].sample)] += change * columns_.entries[k].slope;
    }
}

void Quantiser::relax(int sweeps, const Task& task) {
    const std::size_t n = level_.z.size();
    double mean = 0;
    for (const double e : columns_.energy) mean += e / static_cast<double>(n);
    const double ridge = kRidge * mean;
    std::vector<double> y(n, 0);
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        for (std::size_t i = 0; i < n; ++i) {
            if (i % 1024 == 0) task.check();
            if (columns_.energy[i] <= 0) continue;
            const double change = (slope(i) - ridge * y[i]) / (columns_.energy[i] + ridge);
            y[i] += change;
            move(i, change);
        }
    }
    constexpr double kMost = 65535;
    for (std::size_t i = 0; i < n; ++i) {
        const double v = std::clamp(y[i], -kMost, kMost);
        level_.z[i] = std::abs(v) < kRoundToZero ? 0 : static_cast<std::int32_t>(std::floor(v + 0.5));
        move(i, level_.z[i] - y[i]);
    }
}

std::size_t Quantiser::cost_bin(std::size_t i) const {
    std::int64_t magnitude = 0, weight = 0;
    for (std::uint32_t k = first_[i]; k < first_[i + 1]; ++k) {
        magnitude +=
            std::int64_t{both_[k].weight} * std::abs(level_.z[static_cast<std::size_t>(both_[k].index)]);
        weight += both_[k].weight;
    }
    const double near = weight > 0 ? 16.0 * static_cast<double>(magnitude) / static_cast<double>(weight) : 0;
    return magnitude_bin(near, 1.4, kNearBins) * kParentBins +
           magnitude_bin(surroundings_.parent[i], 0.8, kParentBins);
}

void Quantiser::measure_costs() {
    constexpr std::size_t kBins = kNearBins * kParentBins;
    std::vector<double> counts(kBins * kClasses, 0);
    std::array<double, kClasses> all{};
    all.fill(0.2);
    double total = 0.2 * kClasses;
    for (std::size_t i = 0; i < level_.z.size(); ++i) {
        const std::size_t c = class_of(level_.z[i]);
        ++counts[cost_bin(i) * kClasses + c];
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
            const double bits = reproducible_log2(sum / counts[b * kClasses + c]) + signs;
            costs_[b * kClasses + c] = static_cast<float>(bits);
        }
    }
}

std::int32_t Quantiser::best(std::size_t i, double lambda) const {
    const double energy = columns_.energy[i];
    if (energy <= 0) return 0;
    const std::int32_t now = level_.z[i];
    const double ideal = std::clamp(now + slope(i) / energy, -65534.0, 65534.0);
    const auto below = static_cast<std::int32_t>(std::floor(ideal));
    const float* cost = &costs_[cost_bin(i) * kClasses];
    std::int32_t choice = now;
    double least = 1e300;
    for (const std::int32_t z : {now, below, below + 1, below > 0 ? below - 1 : below + 2, 0}) {
        const double total = energy * (z - ideal) * (z - ideal) + lambda * cost[class_of(z)];
        if (total < least - 1e-15 * std::abs(least)) {
            least = total;
            choice = z;
        }
    }
    return choice;
}

double Quantiser::optimise(int sweeps, double lambda, const Task& task) {
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        measure_costs();
        std::size_t changes = 0;
        for (std::size_t i = 0; i < level_.z.size(); ++i) {
            if (i % 1024 == 0) task.check();
            const std::int32_t z = best(i, lambda);
            if (z == level_.z[i]) continue;
            move(i, z - level_.z[i]);
            level_.z[i] = z;
            ++changes;
        }
        if (changes == 0) break;
    }
    measure_costs();
    double bits = 0;
    for (std::size_t i = 0; i < level_.z.size(); ++i) {
        bits += costs_[cost_bin(i) * kClasses + class_of(level_.z[i])];
    }
    return bits;
}

}  // namespace pfgeom
