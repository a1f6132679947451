// Models as operands of set operations: what a model is besides the union of its objects. The operands stay
// as they are, each with its objects, their frames and its promise; only the operations are added.
#pragma once

#include "pfgeom/function/affine.h"
#include "pfgeom/function/promise.h"

#include <cstdint>
#include <vector>

namespace pfgeom {

/// What was a model of its own.
struct Operand {
    std::int32_t objects = 0;  ///< so many of the model's, after those of the operands before
    double diagonal = 0;
    Promise promise;

    friend bool operator==(const Operand&, const Operand&) = default;
};

/// One step of an expression in postfix notation (Łukasiewicz), which no bytes can make a circle of: an
/// operand is pushed, an operation takes what is on top.
struct CombinationStep {
    enum class Kind : std::uint8_t {
        operand,    ///< `row` of the operands
        unite,      ///< of the two on top: max
        intersect,  ///< min
        subtract,   ///< the one below without the one on top: min(a, -b)
        transform   ///< of the one on top: `row` of the transforms
    };
    Kind kind = Kind::operand;
    std::int32_t row = -1;

    friend bool operator==(const CombinationStep&, const CombinationStep&) = default;
};

/// Empty: the model is the union of its objects. Operands stand in the order of their first use, transforms
/// in that of their only one.
struct Combination {
    static constexpr int kMostSteps = 1 << 14, kMostDepth = 512;

    std::vector<Operand> operands;
    std::vector<Affine> transforms;
    std::vector<CombinationStep> steps;

    bool empty() const { return steps.empty(); }
    friend bool operator==(const Combination&, const Combination&) = default;
};

/// A combination as a tree: transforms are moved down to the operands.
struct CombinationNode {
    CombinationStep::Kind kind = CombinationStep::Kind::operand;  ///< never `transform`
    std::int32_t a = -1, b = -1;                                  ///< nodes, which stand before
    std::int32_t first = 0, last = 0;                             ///< operand: rows of Model::objects
    double diagonal = 0;                                          ///< operand: its own
    bool moved = false;                                           ///< operand: `place` is not the identity
    Affine place{};                                               ///< operand: from its space to the model's

    bool is_operand() const { return kind == CombinationStep::Kind::operand; }
};

}  // namespace pfgeom
