// Source: the paper's perturbations (eq. 4, 5) as a multilevel basis of compactly supported bumps. Departure:
// the supports are chosen (eval/derive.h), so that the form factors enter linearly and each level is one
// sparse least-squares system, solved directly; nothing iterates over unknown shapes.
#include "pfgeom/fit/hierarchy.h"

#include "pfgeom/base/parallel.h"
#include "pfgeom/base/random.h"
#include "pfgeom/eval/derive.h"
#include "pfgeom/eval/surroundings.h"
#include "pfgeom/fit/columns.h"
#include "pfgeom/fit/quantiser.h"

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

constexpr double kLeastGradient = 0.1;
constexpr std::size_t kSamplesPerCentre = 16, kLeastSamples = 30'000;
// With a dead zone: once fewer than this share of the samples is out of `enough`, the levels mend. Excesses
// are small then, and so must be the weight of the bits.
constexpr double kMendShare = 0.1, kMendLambda = 0.002;
constexpr int kLatticeSweeps = 25, kSheetSweeps = 12, kIntegerSweeps = 12;

class Fitter {
  public:
    Fitter(const FitTarget& target, const HierarchyOptions& options, const Task& task)
        : target_(target), options_(options), task_(task), field_(Quadric{}) {}

    HierarchyFit run() {
        HierarchyFit fit;
        fit.function.head = head();
        fit.function.base = base_of(fit.function.head);
        field_ = FunctionField(fit.function.base);
        jets_.resize(target_.points.size());
        parallel_chunks(jets_.size(), 4096, task_, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) jets_[i] = field_.jet(target_.points[i]);
        });
        lambda_ = natural_lambda(fit.function.head);
        for (int depth = kFirstLevel; depth <= options_.last_level; ++depth) {
            if (!affordable(fit)) break;
            Level level = empty_level(fit.function.head, depth);
            if (!fit_level(fit.function.head, level, fit.bits)) break;
            fit.function.levels.push_back(std::move(level));
            estimate_error(fit);
            if (fit.max <= options_.enough) break;
            mending_ = options_.mend_zone > 0 && share_out_ < kMendShare;
            if (fit.bits > options_.most_bits) {
                fit.function.levels.clear();
                return fit;
            }
        }
        return fit;
    }

  private:
    HierarchyHead head() const {
        HierarchyHead head;
        for (int d = 0; d < 3; ++d) {
            const double code = std::floor(target_.half_extent[d] * 256);
            head.axes[static_cast<std::size_t>(d)] = static_cast<std::uint8_t>(std::clamp(code, 12.0, 255.0));
        }
        head.step_code = static_cast<std::uint8_t>(std::clamp(options_.step_code, 0, 255));
        head.ratio_code = static_cast<std::uint8_t>(options_.ratio_code);
        head.first_sheet = static_cast<std::uint8_t>(options_.first_sheet);
        return head;
    }

    // Whether a reader would still derive the next level, which has about four times the centres of the last.
    static bool affordable(const HierarchyFit& fit) {
        if (fit.function.levels.empty()) return true;
        double centres = 4.0 * static_cast<double>(fit.function.levels.back().centres.size());
        for (const Level& level : fit.function.levels) centres += static_cast<double>(level.centres.size());
        const auto bytes = static_cast<std::size_t>(fit.bits / 8);
        return centres <= static_cast<double>(DeriveBudget::of_bytes(bytes).centres);
    }

    // The slope -dD/dbits of a uniform quantiser with level 7's step: D per coefficient is step² / 12 of its
    // share of the surface, and 6 dB cost a bit.
    double natural_lambda(const HierarchyHead& head) const {
        const Level seventh = empty_level(head, 7);
        const double share = 3.14159265358979 * seventh.radius * seventh.radius / 7 / target_.area;
        return options_.lambda * 0.13 * seventh.step * seventh.step * share;
    }

    bool fit_level(const HierarchyHead& head, Level& level, double& bits) {
        const bool sheet = level.depth >= head.first_sheet;
        DeriveBudget unlimited;
        std::vector<ProbedCell> cells;
        if (sheet && level.depth <= std::min(options_.last_thin, kLastThinLevel)) {
            cells = thin_candidates(field_, level.depth, unlimited, task_);
            level.thin = thin_flags(cells, level.depth);
        }
        place_centres(field_, head, cells, level, unlimited, task_);
        if (level.centres.empty()) return false;
        const Surroundings surroundings = survey(field_, level, task_);
        const LevelSamples samples = level_samples(level, sheet);
        const Columns columns = make_columns(level, samples, task_);
        Quantiser quantiser(level, columns, samples, surroundings);
        const double scale = 1 / static_cast<double>(surface_samples_), before = quantiser.distortion();
        quantiser.relax(sheet ? kSheetSweeps : kLatticeSweeps, task_);
        const bool zones = sheet && options_.dead_zone > 0;
        const double lambda = mending_ ? kMendLambda * lambda_ : lambda_;
        const double level_bits = quantiser.optimise(kIntegerSweeps, lambda / scale, zones, task_);
        const double gain = scale * (before - quantiser.distortion());
        if (sheet && gain < lambda * level_bits) return false;
        if (sheet && !zones && level.depth > 6 && gain < 0.01 * scale * before) return false;
        bits += level_bits;
        const LevelField added(level);
        parallel_chunks(jets_.size(), 4096, task_, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) added.add_jet(target_.points[i], jets_[i]);
        });
        field_.add(level);
        return true;
    }

    // A cell is flagged where several of its samples have the wrong sign a little off the surface.
    std::vector<std::uint8_t> thin_flags(const std::vector<ProbedCell>& cells, int depth) const {
        const double h = std::ldexp(2.0, -depth), size = 2 * h, reach = 0.6 * h;
        CellTable index;
        for (std::size_t i = 0; i < cells.size(); ++i)
            index[cells[i].index.key()] = static_cast<std::int32_t>(i);
        struct Vote {
            std::int32_t wrong = 0, all = 0;
        };
        std::vector<std::uint8_t> wrong(target_.points.size());
        parallel_chunks(target_.points.size(), 1024, task_, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; i += 2) {
                const Vec3 out = target_.points[i] + reach * target_.normals[i],
                           in = target_.points[i] - reach * target_.normals[i];
                wrong[i] = (field_.value(out) > 0 && target_.signed_distance(out) < -0.3 * h) ||
                           (field_.value(in) < 0 && target_.signed_distance(in) > 0.3 * h);
            }
        });
        std::vector<Vote> votes(cells.size());
        for (std::size_t i = 0; i < target_.points.size(); i += 2) {
            const std::int32_t cell =
                index.find(CellIndex::of(target_.points[i] + Vec3{1, 1, 1}, 1 / size).key());
            if (cell < 0) continue;
            ++votes[static_cast<std::size_t>(cell)].all;
            votes[static_cast<std::size_t>(cell)].wrong += wrong[i];
        }
        std::vector<std::uint8_t> flags(cells.size());
        bool any = false;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            flags[i] = votes[i].wrong >= 3 && votes[i].wrong > 0.03 * votes[i].all;
            any |= flags[i] != 0;
        }
        if (!any) flags.clear();
        return flags;
    }

    LevelSamples level_samples(const Level& level, bool sheet) {
        const std::size_t n = target_.points.size();
        const std::size_t wanted = std::max(kLeastSamples, level.centres.size() * kSamplesPerCentre);
        const std::size_t stride = std::max<std::size_t>(1, n / wanted);
        const double zone = !sheet ? 0 : mending_ ? options_.mend_zone : options_.dead_zone;
        LevelSamples samples;
        for (std::size_t i = 0; i < n; i += stride) {
            const double length = sheet ? std::max(kLeastGradient, norm(jets_[i].gradient)) : 1.0;
            samples.add(target_.points[i], jets_[i].value, 1 / length, -zone * length, zone * length);
        }
        surface_samples_ = samples.points.size();
        add_off_surface(level, sheet, samples);
        return samples;
    }

    // Around lattice nodes, points off the surface keep the field from collapsing and from false sheets: F
    // must lie in [0.7 d, 1.3 d + 0.1 h] of their distance d. Half of them along the normals of samples, half
    // anywhere.
    void add_off_surface(const Level& level, bool sheet, LevelSamples& samples) {
        std::vector<std::size_t> nodes;
        for (std::size_t i = 0; i < level.centres.size(); ++i) {
            if (level.lattice[i] != 0) nodes.push_back(i);
        }
        if (nodes.empty()) return;
        const double h = std::ldexp(2.0, -level.depth);
        const std::vector<std::size_t> close =
            sheet ? samples_near(level, nodes) : std::vector<std::size_t>{};
        const std::size_t count = sheet ? std::min(surface_samples_, nodes.size() * 24) : surface_samples_;
        Random random(static_cast<std::uint64_t>(level.depth));
        std::vector<Vec3> points(count);
        for (std::size_t i = 0; i < count; ++i) {
            if (i % 2 == 0) {
                const Vec3& c = level.centres[nodes[random.below(nodes.size())]];
                const double x = random.uniform() - 0.5, y = random.uniform() - 0.5,
                             z = random.uniform() - 0.5;
                points[i] = c + 3 * h * Vec3{x, y, z};
            } else {
                const std::size_t j = sheet && !close.empty() ? close[random.below(close.size())]
                                                              : random.below(target_.points.size());
                const double side = i % 4 == 1 ? -1 : 1;
                points[i] =
                    target_.points[j] + (side * h * (0.2 + 1.5 * random.uniform())) * target_.normals[j];
            }
        }
        std::vector<double> distance(count), value(count);
        parallel_chunks(count, 256, task_, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                distance[i] = target_.signed_distance(points[i]);
                value[i] = field_.value(points[i]);
            }
        });
        for (std::size_t i = 0; i < count; ++i) {
            const double a = std::abs(distance[i]);
            const double low = std::min(0.7 * a, h), high = a > 2 * h ? 1e3 : 1.3 * a + 0.1 * h;
            if (distance[i] > 0)
                samples.add(points[i], value[i], 1, low, high);
            else
                samples.add(points[i], value[i], 1, -high, -low);
        }
    }

    std::vector<std::size_t> samples_near(const Level& level, const std::vector<std::size_t>& nodes) const {
        std::vector<Vec3> centres;
        centres.reserve(nodes.size());
        for (const std::size_t i : nodes) centres.push_back(level.centres[i]);
        const BallGrid grid(centres, level.radius);
        std::vector<std::size_t> close;
        for (std::size_t i = 0; i < target_.points.size(); i += 3) {
            bool hit = false;
            grid.near(target_.points[i], [&hit](std::int32_t, double, const Vec3&) { hit = true; });
            if (hit) close.push_back(i);
        }
        return close;
    }

    void estimate_error(HierarchyFit& fit) {
        double sum = 0, out = 0;
        fit.max = 0;
        for (const Jet& jet : jets_) {
            const double e = std::abs(jet.value) / std::max(0.05, norm(jet.gradient));
            sum += e * e;
            fit.max = std::max(fit.max, e);
            out += e > options_.enough ? 1 : 0;
        }
        share_out_ = out / static_cast<double>(jets_.size());
        fit.rms = std::sqrt(sum / static_cast<double>(jets_.size()));
    }

    const FitTarget& target_;
    const HierarchyOptions& options_;
    const Task& task_;
    FunctionField field_;
    std::vector<Jet> jets_;  // of the field at the target's points
    double lambda_ = 0;
    std::size_t surface_samples_ = 0;
    double share_out_ = 1;  // of the samples, after the last level
    bool mending_ = false;
};

}  // namespace

HierarchyFit fit_hierarchy(const FitTarget& target, const HierarchyOptions& options, const Task& task) {
    return Fitter(target, options, task).run();
}

}  // namespace pfgeom
