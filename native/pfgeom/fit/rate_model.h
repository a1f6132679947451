// What each integer of a level would cost: an adaptive estimate by the magnitudes around it and of the level
// before. Kinder than the coder, which sees only one side of the neighbours, and much faster.
#pragma once

#include "pfgeom/eval/surroundings.h"
#include "pfgeom/function/model.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

class RateModel {
  public:
    RateModel(const Level& level, const Surroundings& surroundings);

    /// Estimates all costs from the level's z of now.
    void measure();
    /// Of z at coefficient i, given its neighbours' z of now.
    double bits(std::size_t i, std::int32_t z) const { return costs_[bin(i) * kClasses + class_of(z)]; }
    /// Estimate of the whole level.
    double total() const;
    /// Earlier and later ones.
    std::span<const Neighbour> neighbours(std::size_t i) const {
        return std::span(neighbours_).subspan(first_[i], first_[i + 1] - first_[i]);
    }

  private:
    static constexpr std::size_t kNearBins = 8, kParentBins = 5, kClasses = 18;
    static std::size_t class_of(std::int32_t z);
    std::size_t bin(std::size_t i) const;

    const Level& level_;
    std::vector<std::uint8_t> parent_bin_;
    std::vector<std::uint32_t> first_;
    std::vector<Neighbour> neighbours_;
    std::vector<double> costs_;
};

}  // namespace pfgeom
