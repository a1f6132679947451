// Context mixing for the coefficients and flags of .pfg files, in integer arithmetic: a bit is predicted by
// several adaptive probabilities, one for each of its contexts, and by features; an online logistic
// regression weighs them. Every step is an integer operation on tables that are themselves exactly
// reproducible. Source: Mahoney, "Adaptive weighing of context models for lossless data compression", FIT TR
// CS-2005-16. Departures: real-valued features beside the contexts, two weight sets whose outputs are
// averaged, the confidence of young slots (measured: 10 % fewer bytes than an order-0 coder,
// docs/RESULTS.md), and memory that grows with the bytes of the stream only.
#pragma once

#include "pfgeom/codec/entropy.h"
#include "pfgeom/codec/flat_map.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

/// ln(p / (1-p)) in units of 1/kStretchOne, for p in (0,1) in 1/65536; exact table, no libm.
constexpr int kStretchOne = 1024;
int stretch(Probability p);
Probability squash(int stretched);

/// log2(1 + x / 16) in units of 1/16 for x >= 0: piecewise linear between powers of two; integers only.
int log2_sixteenths(std::uint32_t x);

class ContextMixer {
  public:
    /// Which part of the mixer a bit uses.
    struct Where {
        std::uint32_t kind = 0;  ///< what the bit means: contexts and weights of kinds are disjoint (< 256)
        std::uint32_t weight_set_a = 0;  ///< < 4096
        std::uint32_t weight_set_b = 0;  ///< < 4096
    };

    /// Codes one bit. Every call with the same kind must pass as many contexts (1 .. 16, < 24 bits each) and
    /// features (up to 16, units of 1/kStretchOne, within ±8 * kStretchOne).
    int code(EntropyCoder& coder, int bit, const Where& where, std::span<const std::uint32_t> contexts,
             std::span<const int> features = {});

    /// Any unsigned integer: exponent by unary bits, then the mantissa, adaptive under `context` (< 2^18).
    /// Uses `kind` and `kind` + 1.
    std::uint32_t code_uint(EntropyCoder& coder, std::uint32_t value, std::uint32_t kind,
                            std::uint32_t context = 0);
    /// The same for signed values.
    std::int32_t code_int(EntropyCoder& coder, std::int32_t value, std::uint32_t kind,
                          std::uint32_t context = 0);

    /// Estimated cost of what was coded so far under each kind, in bits (statistics for reports only).
    const std::vector<double>& spent_bits() const { return spent_; }

  private:
    static constexpr std::size_t kMostContexts = 16, kMostInputs = 32;

    struct Slot {
        std::uint32_t p = 1U << 31;  // probability of a one, 32-bit fixed point
        std::uint32_t count = 0;     // of bits seen, no longer counted at kSlowest
    };
    struct WeightSet {
        std::uint32_t first = 0;  // row of weights_
        std::uint32_t count =
            0;  // of bits seen, no longer counted at kManyBits; 0 and not in weights_ if new
        bool made = false;
    };
    Slot& slot(std::uint64_t key, std::size_t allowed);
    WeightSet& weight_set(std::uint64_t key, std::size_t allowed, std::size_t contexts, std::size_t inputs);
    int dot(const WeightSet& set, std::span<const int> inputs) const;
    void learn(WeightSet& set, std::span<const int> inputs, int dot, int bit);

    FlatMap<Slot> slots_;
    FlatMap<WeightSet> sets_;
    std::vector<std::int32_t> weights_;  // 16.16
    std::vector<double> spent_;
};

}  // namespace pfgeom
