// Context mixing for the coefficients and flags of .pfg files, in integer arithmetic: a bit is predicted by
// several adaptive probabilities, one for each of its contexts, and by features; an online logistic regression
// weighs them. Every step is an integer operation on tables that are themselves exactly reproducible.
// Source: Mahoney, "Adaptive weighing of context models for lossless data compression", FIT TR CS-2005-16.
// Departures: real-valued features beside the contexts, two weight sets whose outputs are averaged, and the
// confidence of young slots (measured: 10 % fewer bytes than an order-0 coder, docs/RESULTS.md).
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "pfgeom/codec/entropy.h"

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
        std::uint32_t kind = 0;         ///< what the bit means: contexts and weights of kinds are disjoint (< 256)
        std::uint32_t weight_set_a = 0;  ///< < 4096
        std::uint32_t weight_set_b = 0;  ///< < 4096
    };

    /// Codes one bit. Every call with the same kind must pass as many contexts (< 24 bits each) and features
    /// (units of 1/kStretchOne, within ±8 * kStretchOne).
    int code(EntropyCoder& coder, int bit, const Where& where, std::span<const std::uint32_t> contexts,
             std::span<const int> features = {});

    /// A non-negative integer < 2^31: exponent by unary bits, then the mantissa, all adaptive under `context`.
    std::uint32_t code_uint(EntropyCoder& coder, std::uint32_t value, std::uint32_t kind, std::uint32_t context = 0);
    /// The same for signed values.
    std::int32_t code_int(EntropyCoder& coder, std::int32_t value, std::uint32_t kind, std::uint32_t context = 0);

    /// Estimated cost of what was coded so far under each kind, in bits (statistics for reports only).
    const std::vector<double>& spent_bits() const { return spent_; }

  private:
    struct Slot {
        std::uint32_t p = 1U << 31;  // probability of a one, 32-bit fixed point
        std::uint32_t count = 0;
    };
    struct Weights {
        std::vector<std::int32_t> w;  // 16.16
        std::uint32_t count = 0;
    };
    Weights& weights(std::uint64_t key, std::size_t contexts, std::size_t inputs);
    static void learn(Weights& set, std::span<const int> inputs, int dot, int bit);

    std::unordered_map<std::uint64_t, Slot> slots_;
    std::unordered_map<std::uint64_t, Weights> weight_sets_;
    std::vector<double> spent_;
    std::vector<Slot*> active_;
    std::vector<int> inputs_;
};

}  // namespace pfgeom
