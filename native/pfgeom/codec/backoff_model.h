// Adaptive bits for small files: a few hundred symbols in many contexts, where every context must be of use
// from its second bit on. A chain of contexts, from the coarse to the fine, each of which starts from what
// the one before it says: p_k = (ones_k + c p_{k-1}) / (seen_k + c), p_0 given by the caller. Source: MacKay
// and Peto, "A hierarchical Dirichlet language model", Natural Language Engineering 1, 1995, for two symbols.
// Integers only.
#pragma once

#include "pfgeom/codec/entropy.h"
#include "pfgeom/codec/flat_map.h"

#include <cstddef>
#include <cstdint>
#include <initializer_list>

namespace pfgeom {

class BackoffModel {
  public:
    /// One bit. `kind` < 2^16 keeps apart what bits mean; the first context is the coarsest. Memory grows
    /// with the number of different (kind, place, context), which callers keep small.
    int code(EntropyCoder& coder, int bit, std::uint32_t kind, Probability prior,
             std::initializer_list<std::uint32_t> contexts);

    /// One of `count` > 0 things, the likely ones first; about evenly likely until it is known better.
    std::size_t choose(EntropyCoder& coder, std::size_t choice, std::size_t count, std::uint32_t kind);

  private:
    struct Seen {
        std::uint16_t ones = 0, all = 0;
    };
    FlatMap<Seen> seen_;
};

}  // namespace pfgeom
