#include "pfgeom/fit/quantiser.h"

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

constexpr double kRidge = 0.05;  // of the mean energy (1 %: +1.6 % bytes)
constexpr double kRoundToZero =
    0.4;  // values below this start as zero (0.5: +0.1 %, 0.6: +1 %, 0.75: +3.5 %)
constexpr std::int32_t kMost = 65535;     // of a magnitude
constexpr int kFirstExchange = 2;         // sweep
constexpr std::int32_t kMostRebuilt = 1;  // magnitude (3: the same)
constexpr double kLeastSaved = 1e-9;      // of lambda: below is rounding

}  // namespace

Quantiser::Quantiser(Level& level, const Columns& columns, const LevelSamples& samples,
                     const Surroundings& surroundings)
    : level_(level), columns_(columns), rate_(level, surroundings), lo_(samples.lo), hi_(samples.hi) {
    value_.resize(samples.values.size());
    column_.resize(samples.values.size());
    for (std::size_t s = 0; s < value_.size(); ++s) {
        const double w = samples.weights[s];
        value_[s] = w * samples.values[s];
        lo_[s] = static_cast<float>(w * lo_[s]);
        hi_[s] = static_cast<float>(w * hi_[s]);
    }
    level_.z.assign(level.centres.size(), 0);
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
    for (const Columns::Entry& e : columns_.of(i)) sum += e.slope * residual(e.sample);
    return sum;
}

// Σ of the squared residuals in column i once its coefficient has changed by so much.
double Quantiser::error(std::size_t i, double change) const {
    double sum = 0;
    for (const Columns::Entry& e : columns_.of(i)) {
        const double r = residual(e.sample, change * e.slope);
        sum += r * r;
    }
    return sum;
}

void Quantiser::move(std::size_t i, double change) {
    if (change == 0) return;
    for (const Columns::Entry& e : columns_.of(i))
        value_[static_cast<std::size_t>(e.sample)] += change * e.slope;
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
    for (std::size_t i = 0; i < n; ++i) {
        const double v = std::clamp(y[i], -1.0 * kMost, 1.0 * kMost);
        const auto magnitude = static_cast<std::int32_t>(std::floor(std::abs(v) + 0.5));
        level_.z[i] = std::abs(v) < kRoundToZero ? 0 : std::max(magnitude, 1) * (v < 0 ? -1 : 1);
        move(i, level_.reconstruct(level_.z[i]) - y[i]);
    }
}

void Quantiser::apply(std::size_t i, std::int32_t by) {
    if (by == 0) return;
    move(i, jump(i, by));
    level_.z[i] += by;
    settled_[i] = 0;
    for (const Neighbour& e : rate_.neighbours(i)) settled_[static_cast<std::size_t>(e.index)] = 0;
}

// Sets coefficient i to the best value, all others staying. Returns what that saves.
double Quantiser::improve(std::size_t i, double lambda) {
    const double energy = columns_.energy[i];
    const std::int32_t now = level_.z[i];
    if (energy <= 0) return 0;
    if (zones_) return improve_in_zones(i, lambda);
    const double ideal = std::clamp(level_.reconstruct(now) + slope(i) / energy, 1.0 - kMost, kMost - 1.0);
    const auto below = static_cast<std::int32_t>(std::floor(ideal));
    const auto price = [&](std::int32_t z) {
        const double error = level_.reconstruct(z) - ideal;
        return energy * error * error + lambda * rate_.bits(i, z);
    };
    const double before = price(now);
    std::int32_t choice = now;
    double least = before;
    for (const std::int32_t z : {below, below + 1, below > 0 ? below - 1 : below + 2, 0}) {
        const double total = price(z);
        if (total < least * (1 - 1e-15)) {
            least = total;
            choice = z;
        }
    }
    apply(i, choice - now);
    return before - least;
}

// The same by looking: a unit or two where the residuals push, one back, or none at all.
double Quantiser::improve_in_zones(std::size_t i, double lambda) {
    const std::int32_t now = level_.z[i];
    const double push = slope(i);
    if (now == 0 && push == 0) return 0;
    const std::int32_t on = push > 0 ? 1 : -1;
    const double before = error(i, 0) + lambda * rate_.bits(i, now);
    std::int32_t choice = now;
    double least = before;
    for (const std::int32_t z : {now + on, now + 2 * on, now - on, 0}) {
        if (z == now || std::abs(z) > kMost) continue;
        const double total = error(i, jump(i, z - now)) + lambda * rate_.bits(i, z);
        if (total < least * (1 - 1e-12)) {
            least = total;
            choice = z;
        }
    }
    apply(i, choice - now);
    return before - least;
}

// What changing coefficient j, where the residual has this slope, saves.
double Quantiser::saving(std::size_t j, std::int32_t by, double slope, double lambda) const {
    const double d = jump(j, by);
    const double gain = zones_ ? error(j, 0) - error(j, d) : (2 * slope - d * columns_.energy[j]) * d;
    return gain + lambda * (rate_.bits(j, level_.z[j]) - rate_.bits(j, level_.z[j] + by));
}

// The change of a neighbour that goes best with changing coefficient i, whose column is spread over the
// samples. None if both together save nothing.
Quantiser::Change Quantiser::partner(std::size_t i, std::int32_t by, double lambda) const {
    const double alone = saving(i, by, slope(i), lambda), d = jump(i, by);
    Change best;
    for (const Neighbour& e : rate_.neighbours(i)) {
        const auto j = static_cast<std::size_t>(e.index);
        if (columns_.energy[j] <= 0) continue;
        double slope_j = 0;
        for (const Columns::Entry& entry : columns_.of(j)) {
            const double answer = d * double{column_[static_cast<std::size_t>(entry.sample)]};
            slope_j += entry.slope * (residual(entry.sample) - answer);
        }
        const double ideal =
            level_.reconstruct(level_.z[j]) + std::clamp(slope_j / columns_.energy[j], -8.0, 8.0);
        const auto change = static_cast<std::int32_t>(std::floor(ideal + 0.5)) - level_.z[j];
        if (change == 0 || std::abs(level_.z[j] + change) > kMost) continue;
        const double saved = alone + saving(j, change, slope_j, lambda);
        if (saved > best.saved) best = {j, change, saved};
    }
    return best;
}

// Moves a unit of coefficient i to a neighbour where that saves most.
bool Quantiser::exchange(std::size_t i, double lambda) {
    const std::int32_t by = level_.z[i] > 0 ? -1 : 1;
    for (const Columns::Entry& e : columns_.of(i)) column_[static_cast<std::size_t>(e.sample)] = e.slope;
    const Change other = partner(i, by, lambda);
    for (const Columns::Entry& e : columns_.of(i)) column_[static_cast<std::size_t>(e.sample)] = 0;
    if (other.saved <= kLeastSaved * lambda) return false;
    apply(i, by);
    apply(other.i, other.by);
    return true;
}

// Takes coefficient i to zero, lets its neighbours answer one after the other, and undoes all of it unless
// that saves.
bool Quantiser::rebuild(std::size_t i, double lambda) {
    const std::int32_t old = level_.z[i];
    const auto neighbours = rate_.neighbours(i);
    undo_.clear();
    for (const Neighbour& e : neighbours) undo_.push_back(level_.z[static_cast<std::size_t>(e.index)]);
    double saved = saving(i, -old, slope(i), lambda);
    apply(i, -old);
    for (const Neighbour& e : neighbours) saved += improve(static_cast<std::size_t>(e.index), lambda);
    if (saved > kLeastSaved * lambda) return true;
    for (std::size_t k = 0; k < neighbours.size(); ++k) {
        const auto j = static_cast<std::size_t>(neighbours[k].index);
        apply(j, undo_[k] - level_.z[j]);
    }
    apply(i, old);
    return false;
}

// One look at coefficient i. True if anything changed.
bool Quantiser::revise(std::size_t i, int sweep, double lambda) {
    const std::int32_t old = level_.z[i], magnitude = std::abs(old);
    bool changed = !zones_ && sweep >= kFirstExchange && magnitude > 0 && exchange(i, lambda);
    if (!changed && sweep >= kFirstExchange && magnitude > 0 && magnitude <= kMostRebuilt)
        changed = rebuild(i, lambda);
    improve(i, lambda);
    return changed || level_.z[i] != old;
}

double Quantiser::optimise(int sweeps, double lambda, bool zones, const Task& task) {
    zones_ = zones;
    settled_.assign(level_.z.size(), 0);
    for (std::size_t i = 0; i < level_.z.size(); ++i) {
        if (columns_.energy[i] <= 0) apply(i, -level_.z[i]);
    }
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        rate_.measure();
        if (sweep <= kFirstExchange) std::fill(settled_.begin(), settled_.end(), 0);
        std::size_t changes = 0;
        for (std::size_t i = 0; i < level_.z.size(); ++i) {
            if (i % 256 == 0) task.check();
            if (settled_[i] != 0) continue;
            settled_[i] = 1;
            changes += revise(i, sweep, lambda) ? 1 : 0;
        }
        if (changes == 0 && sweep >= kFirstExchange) break;
    }
    rate_.measure();
    return rate_.total();
}

}  // namespace pfgeom
