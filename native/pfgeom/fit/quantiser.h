// Rate-distortion-optimal quantisation of one level's form factors: integer coordinate descent on the exact
// quadratic residual, with an adaptive estimate of what each integer costs among its neighbours.
// Source: Ramchandran, Vetterli, "Rate-distortion optimal fast thresholding", IEEE TIP 3(5), 1994, and the
// RDOQ of video coders; departure: the transform is not orthogonal, so a decision moves the residual of its
// neighbours. Measured gain over plain rounding: 24 % of the bytes at equal rms.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/eval/surroundings.h"
#include "pfgeom/fit/columns.h"

#include <vector>

namespace pfgeom {

class Quantiser {
  public:
    Quantiser(Level& level, const Columns& columns, const LevelSamples& samples,
              const Surroundings& surroundings);

    /// Σ of squared residuals now.
    double distortion() const;
    /// Real-valued Gauss-Seidel sweeps with a ridge of 5 % of the mean energy, then plain rounding into
    /// level.z.
    void relax(int sweeps, const Task& task);
    /// Integer sweeps: minimises distortion + lambda · bits. Returns the estimated bits.
    double optimise(int sweeps, double lambda, const Task& task);

  private:
    double residual(std::int32_t s) const {
        const auto i = static_cast<std::size_t>(s);
        const double v = value_[i];
        return v < lo_[i] ? lo_[i] - v : v > hi_[i] ? hi_[i] - v : 0.0;
    }
    double slope(std::size_t i) const;
    void move(std::size_t i, double change);
    void measure_costs();
    std::size_t cost_bin(std::size_t i) const;
    std::int32_t best(std::size_t i, double lambda) const;

    Level& level_;
    const Columns& columns_;
    const Surroundings& surroundings_;
    std::vector<double> value_;
    std::vector<float> lo_, hi_;
    std::vector<std::uint32_t> first_;  // neighbours both ways
    std::vector<Neighbour> both_;
    std::vector<float> costs_;
};

}  // namespace pfgeom
