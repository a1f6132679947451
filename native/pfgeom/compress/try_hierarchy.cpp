// The search for the coarsest quantiser that holds the tolerance: fits are steered by the error at their own
// samples, and every candidate is then proved on its bytes, which calibrates the next estimate.
#include "pfgeom/base/reproducible.h"
#include "pfgeom/compress/hierarchy_search.h"
#include "pfgeom/compress/mesh_code.h"
#include "pfgeom/eval/derive.h"
#include "pfgeom/fit/hierarchy.h"

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

constexpr int kMostFits = 8, kMostProofs = 4, kMostFitsOfMax = 4;
// From this fit on what is below the aim will do: the error can jump across it (a casting: 0.93 to 1.01).
constexpr int kLateFit = 4;
constexpr double kChordOfMax = 0.12;  // of the tolerance

// Fine levels have more centres, and with too few samples they are fitted to the samples instead of the
// surface (armadillo near 1e-4: 500k samples instead of 200k save 3 %).
std::size_t sample_count(const Goal& goal) {
    const double fine = std::clamp(2e-4 * goal.diagonal / goal.tolerance, 1.0, 2.5);
    const double count = std::clamp(20.0 * static_cast<double>(goal.mesh.faces.size()), 8e3, 2e5);
    return static_cast<std::size_t>(fine * count);
}

// Finds the fineness at which the error is as wanted: error falls by about 6.7 % an eighth of an octave.
class Secant {
  public:
    explicit Secant(double fineness) : fineness_(fineness) {}
    double fineness() const { return fineness_; }

    void step(double error, double wanted) {
        const double log_error = reproducible_log2(error);
        if (seen_ && std::abs(fineness_ - last_fineness_) > 0.2) {
            slope_ = std::clamp((last_error_ - log_error) / (fineness_ - last_fineness_), 0.04, 0.2);
        }
        seen_ = true;
        last_fineness_ = fineness_;
        last_error_ = log_error;
        fineness_ += std::clamp((log_error - reproducible_log2(wanted)) / slope_, -24.0, 24.0);
    }

  private:
    double fineness_, last_fineness_ = 0, last_error_ = 0, slope_ = 0.094;
    bool seen_ = false;
};

class Search {
  public:
    Search(const Goal& goal, const ClosedIsland& closed, const Finish& finish, std::size_t most_bytes,
           const Task& task)
        : goal_(goal),
          finish_(finish),
          task_(task),
          target_(closed.mesh, sample_count(goal), closed.own_faces, closed.fit_closing),
          tolerance_(goal.tolerance / target_.frame.half()) {
        options_.most_bits = 8.0 * static_cast<double>(most_bytes);
        options_.last_thin = kLastThinLevel;
        // The finer, the less a bit is worth: at 1e-4 of the diagonal half the weight saves 5 % (fertility,
        // rocker-arm); at 2e-4 it costs 3 %.
        base_lambda_ *= std::clamp(goal.tolerance / (2e-4 * goal.diagonal), 0.5, 1.0);
    }

    std::optional<Outcome> run() {
        if (finish_ && target_.inside_out) return {};  // sheets and cuts are not turned
        return goal_.metric == Metric::rms ? search_rms() : search_max();
    }

  private:
    // Quantiser of level 7 in eighths of an octave below the cube's unit, as a real number: the integer part
    // is the step, the fraction raises lambda.
    void set_fineness(double fineness) {
        const double code = std::ceil(std::clamp(fineness, 8.0, 250.0));
        options_.step_code = static_cast<int>(code);
        // One eighth of an octave of the step changes the rms by 6.7 %, and so does 1.46 times the lambda
        // (igea).
        options_.lambda = base_lambda_ * (1 + 0.46 * (code - std::clamp(fineness, 8.0, 250.0)));
    }

    std::optional<Outcome> search_rms() {
        constexpr double kBand = 0.012;
        const double aim = finish_ ? 0.981 : 0.991;  // just below what prove() takes
        Secant secant(-8 * reproducible_log2(tolerance_ / 0.3));
        double bias = 1.015;  // measured rms over that of the fit's own samples: the mesh adds its chords
        std::optional<Outcome> best;
        int proofs = 0;
        for (int fits = 0; fits < kMostFits && proofs < kMostProofs; ++fits) {
            set_fineness(secant.fineness());
            const HierarchyFit fit = fit_hierarchy(target_, options_, task_);
            if (fit.function.levels.empty()) break;
            const double expected = fit.rms * bias / tolerance_;
            const bool late = fits + 1 == kMostFits || (fits >= kLateFit && expected < aim);
            if (std::abs(expected - aim) <= kBand || late) {
                const Outcome outcome = prove_fit(fit, 0.5 * goal_.tolerance);
                ++proofs;
                if (outcome.mesh.faces.empty()) break;
                const double reached = outcome.deviation.rms() / goal_.tolerance;
                if (outcome.holds && (!best || outcome.bytes < best->bytes)) best = outcome;
                if (reached > 3 || (outcome.holds && reached > aim - kBand)) break;
                bias = reached * tolerance_ / fit.rms;
            }
            secant.step(fit.rms, aim * tolerance_ / bias);
        }
        return best;
    }

    // Errors within the dead zone cost nothing; what is left beyond it after the last level is estimated at
    // the samples, and corrected by what the proof measures.
    std::optional<Outcome> search_max() {
        constexpr double kZone = 0.6, kMend = 0.8, kEnough = 0.9, kHopeless = 1.6;
        target_.add_vertices(goal_.mesh);
        base_lambda_ = 0.2;
        double share = 1, last = 1e300;
        for (int fits = 0; fits < kMostFitsOfMax; ++fits) {
            const double aim = share * tolerance_;
            set_fineness(-8 * reproducible_log2(aim));
            options_.dead_zone = kZone * aim;
            options_.mend_zone = kMend * aim;
            options_.enough = kEnough * aim;
            const HierarchyFit fit = fit_hierarchy(target_, options_, task_);
            if (fit.function.levels.empty()) break;
            double worst = fit.max / tolerance_;
            if (worst < kHopeless) {
                Outcome outcome = prove_fit(fit, kChordOfMax * goal_.tolerance);
                if (outcome.holds) return outcome;
                if (outcome.mesh.faces.empty()) break;
                worst = outcome.deviation.max() / goal_.tolerance;
            }
            if (worst > 30 || worst > 0.97 * last) break;  // what is left does not yield to finer steps
            last = worst;
            share *= std::clamp(0.97 / worst, 0.6, 0.93);
        }
        return {};
    }

    Outcome prove_fit(const HierarchyFit& fit, double chord) {
        Outcome outcome;
        outcome.candidate = "hierarchy";
        outcome.functions = {fit.function};
        outcome.object.frame = target_.frame;
        outcome.object.shape = single_function(goal_.inward);
        outcome.object.mesh_code = mesh_code_for(goal_, chord);
        if (finish_) finish_(outcome);
        prove(goal_, outcome, task_);
        return outcome;
    }

    const Goal& goal_;
    const Finish& finish_;
    const Task& task_;
    FitTarget target_;
    double tolerance_;  // in the cube's units
    double base_lambda_ = 0.3;
    HierarchyOptions options_;
};

}  // namespace

std::optional<Outcome> search_hierarchy(const Goal& goal, const ClosedIsland& closed, const Finish& finish,
                                        std::size_t most_bytes, const Task& task) {
    return Search(goal, closed, finish, most_bytes, task).run();
}

std::optional<Outcome> try_hierarchy(const Goal& goal, std::size_t most_bytes, const Task& task) {
    return search_hierarchy(goal, {goal.mesh, goal.mesh.faces.size(), true}, {}, most_bytes, task);
}

}  // namespace pfgeom
