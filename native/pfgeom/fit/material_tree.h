// A material tree from points of the surface whose materials are known.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/function/material_map.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

struct MaterialSample {
    Vec3 p;  ///< in the object's cube
    std::int32_t material = 0;
    std::array<std::int32_t, 3> others{-1, -1, -1};  ///< near a border: what would do as well; -1: none

    bool forced() const { return others[0] < 0; }
    bool allows(std::int32_t m) const {
        return m == material || m == others[0] || m == others[1] || m == others[2];
    }
};

/// A piece of a border: the plane through it that stands upright on the surface.
struct BorderPiece {
    Vec3 p, across;
};

struct MaterialFit {
    double least = 1e-3;      ///< what is smaller than this does not matter, in the cube's units
    double plane_weight = 8;  ///< in bits: how much a question may take for what it settles
    Box cell = root_cell();   ///< that the tree is of
};

/// Greedy: the question that settles most for its bits, until all that the leaves' samples allow is there.
MaterialTree fit_material_tree(std::span<const MaterialSample> samples, std::span<const BorderPiece> borders,
                               const MaterialFit& options, const Task& task);

/// Its nodes in order, without questions whose answers are one material.
MaterialTree without_idle_questions(const MaterialTree& tree);

}  // namespace pfgeom
