// What encoder and decoder know about each coefficient of a level before it is coded: the field of the levels
// before, and the neighbours that come earlier in the order. In integers (sixteenths of a quantiser step),
// since the coder's contexts are made of them.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/eval/function_field.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

struct Neighbour {
    std::int32_t index = 0;   ///< < the coefficient's own
    std::int32_t weight = 0;  ///< 256 / (0.3 + d²), d the distance in spacings
};

struct Surroundings {
    std::vector<std::uint32_t> first;               ///< #C + 1
    std::vector<Neighbour> neighbours;              ///< nearest first
    std::vector<std::int32_t> parent, grandparent;  ///< mean |form factor| there, of the last two levels
    std::vector<std::int32_t> parent_sum, grandparent_sum;  ///< their signed displacement
    std::vector<std::int32_t> bend;  ///< curvature · h² / 8: how far the surface bends away within a spacing
    std::vector<std::int32_t> value;  ///< F / h in sixteenths, for lattice nodes; 0 on the surface

    std::span<const Neighbour> of(std::size_t i) const {
        return std::span(neighbours).subspan(first[i], first[i + 1] - first[i]);
    }
};

/// `field`: the levels before `level`, whose centres are known and whose z are not needed.
Surroundings survey(const FunctionField& field, const Level& level, const Task& task);

}  // namespace pfgeom
