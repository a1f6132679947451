// Rate-distortion-optimal quantisation of one level's form factors: integer coordinate descent on the exact
// quadratic residual, with an adaptive estimate of what each integer costs among its neighbours.
// Source: Ramchandran, Vetterli, "Rate-distortion optimal fast thresholding", IEEE TIP 3(5), 1994, and the
// RDOQ of video coders; departures: the balls overlap, so a decision moves the residual of its neighbours,
// and exchanges between two neighbours leave the local minima that single decisions end in. Measured gains at
// equal rms: 24 % of the bytes over plain rounding, exchanges another 5 to 6 %.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/fit/columns.h"
#include "pfgeom/fit/rate_model.h"

#include <cstdint>
#include <vector>

namespace pfgeom {

class Quantiser {
  public:
    Quantiser(Level& level, const Columns& columns, const LevelSamples& samples,
              const Surroundings& surroundings);

    /// Σ of squared residuals now.
    double distortion() const;
    /// Real-valued Gauss-Seidel sweeps with a ridge of 5 % of the mean energy, then rounding into level.z.
    void relax(int sweeps, const Task& task);
    /// Integer sweeps: minimises distortion + lambda · bits. Returns the estimated bits.
    /// `zones`: the samples' intervals are wide, so that most residuals are zero and no quadratic tells what
    /// a change does: each is evaluated.
    double optimise(int sweeps, double lambda, bool zones, const Task& task);

  private:
    struct Change {
        std::size_t i = 0;
        std::int32_t by = 0;
        double saved = 0;  ///< of distortion + lambda · bits
    };
    double residual(std::int32_t s, double change = 0) const {
        const auto i = static_cast<std::size_t>(s);
        const double v = value_[i] + change;
        return v < lo_[i] ? lo_[i] - v : v > hi_[i] ? hi_[i] - v : 0.0;
    }
    double error(std::size_t i, double change) const;
    double slope(std::size_t i) const;
    double jump(std::size_t i, std::int32_t by) const {
        return level_.reconstruct(level_.z[i] + by) - level_.reconstruct(level_.z[i]);
    }
    double saving(std::size_t j, std::int32_t by, double slope, double lambda) const;
    void move(std::size_t i, double change);
    void apply(std::size_t i, std::int32_t by);
    double improve(std::size_t i, double lambda);
    double improve_in_zones(std::size_t i, double lambda);
    Change partner(std::size_t i, std::int32_t by, double lambda) const;
    bool exchange(std::size_t i, double lambda);
    bool rebuild(std::size_t i, double lambda);
    bool revise(std::size_t i, int sweep, double lambda);

    Level& level_;
    const Columns& columns_;
    RateModel rate_;
    bool zones_ = false;
    std::vector<double> value_;
    std::vector<float> lo_, hi_;
    std::vector<std::uint8_t> settled_;  // not worth another look until a neighbour changes
    std::vector<float> column_;          // scratch: one column, spread over the samples
    std::vector<std::int32_t> undo_;     // scratch: z of neighbours
};

}  // namespace pfgeom
