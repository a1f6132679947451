// Least squares with a few dozen unknowns: normal equations, by L D Lᵀ in an order that is written out.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace pfgeom {

class DenseSystem {
  public:
    struct Term {
        std::size_t unknown;
        double factor;
    };

    explicit DenseSystem(std::size_t unknowns)
        : n_(unknowns), matrix_(unknowns * unknowns, 0.0), right_(unknowns, 0.0) {}

    /// + weight · (Σ factor · unknown - value)²
    void add(std::span<const Term> terms, double value, double weight) {
        for (const Term& a : terms) {
            for (const Term& b : terms) {
                if (b.unknown <= a.unknown)
                    matrix_[a.unknown * n_ + b.unknown] += weight * a.factor * b.factor;
            }
            right_[a.unknown] += weight * a.factor * value;
        }
    }

    /// The least squares, with `damping` times the mean of the diagonal added to it. Unknowns that nothing
    /// speaks of are zero.
    std::vector<double> solve(double damping) const {
        std::vector<double> f = matrix_, x = right_;
        double trace = 0;
        for (std::size_t i = 0; i < n_; ++i) trace += matrix_[i * n_ + i];
        if (!(trace > 0)) return std::vector<double>(n_, 0.0);
        for (std::size_t i = 0; i < n_; ++i) {
            f[i * n_ + i] += damping * trace / static_cast<double>(n_);
            for (std::size_t j = 0; j <= i; ++j) {
                double sum = f[i * n_ + j];
                for (std::size_t k = 0; k < j; ++k) sum -= f[i * n_ + k] * f[k * n_ + k] * f[j * n_ + k];
                f[i * n_ + j] = i == j ? sum : sum / f[j * n_ + j];
            }
            for (std::size_t k = 0; k < i; ++k) x[i] -= f[i * n_ + k] * x[k];
        }
        for (std::size_t i = n_; i-- > 0;) {
            x[i] /= f[i * n_ + i];
            for (std::size_t k = i + 1; k < n_; ++k) x[i] -= f[k * n_ + i] * x[k];
        }
        return x;
    }

  private:
    std::size_t n_;
    std::vector<double> matrix_, right_;  // the lower triangle
};

}  // namespace pfgeom
