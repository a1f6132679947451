// The geometry that encoder and decoder both derive from what is already known: where a level's perturbations
// sit. Nothing of it is stored. The bits must be the same on every machine: fixed formulas, + - × ÷ sqrt
// only.
//
// Levels below HierarchyHead::first_sheet are lattices: one ball at each node in a band around the surface,
// so that the topology comes out right. Finer levels only displace the surface: one ball for each cell that
// it crosses, moved onto it by Newton steps, thinned to 0.65 h. Where a part is too thin for that, flagged
// cells get lattice nodes again. Measured gains of each choice: docs/HIERARCHY.md.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/eval/function_field.h"
#include "pfgeom/function/model.h"

#include <cstdint>
#include <vector>

namespace pfgeom {

/// Coarsest and finest level of a hierarchy.
constexpr int kFirstLevel = 2, kLastLevel = 11;
/// Finest level that may have thin cells.
constexpr int kLastThinLevel = 8;

/// Base ellipsoid: k (1 - Σ (x/a)²) with gradients near one on its surface.
Quadric base_of(const HierarchyHead& head);

/// Depth, radius and step of a level; no centres yet.
Level empty_level(const HierarchyHead& head, int depth);

/// Work that deriving may still do: counted, not timed, so that a small file cannot ask for much on any
/// machine.
struct DeriveBudget {
    std::int64_t centres = INT64_MAX;  ///< places that may still be derived
    std::int64_t balls = INT64_MAX;    ///< form factors that may still be other than zero
    std::int64_t cells = INT64_MAX;    ///< that may be held at a time
    std::int64_t probes = INT64_MAX;   ///< cells that may still be looked at

    /// What a stream of so many bytes may ask for, such that decoding stays within 16 KiB of memory a byte.
    /// Real files need 5-25 centres, 1-3 balls, 3-10 cells and 100-250 probes a byte.
    static DeriveBudget of_bytes(std::size_t bytes);
    bool exceeded() const { return centres < 0 || balls < 0 || probes < 0; }
};

/// A cell of the octree over [-1,1]³ and the field at its centre.
struct ProbedCell {
    CellIndex index;  ///< 0 .. 2^depth - 1 each
    Jet jet;
};

inline Vec3 cell_centre(const CellIndex& c, double size) {
    return {-1 + (c.x + 0.5) * size, -1 + (c.y + 0.5) * size, -1 + (c.z + 0.5) * size};
}

/// Cells of level `depth` - 1 near the surface: those that may be flagged as thin. In Morton order.
/// Empty once the budget is exceeded.
std::vector<ProbedCell> thin_candidates(const FunctionField& field, int depth, DeriveBudget& budget,
                                        const Task& task);

/// Fills centres, scale and lattice of `level`, given its depth and thin flags. `cells`: the result of
/// thin_candidates if level.thin is not empty. Meaningless once the budget is exceeded.
void place_centres(const FunctionField& field, const HierarchyHead& head,
                   const std::vector<ProbedCell>& cells, Level& level, DeriveBudget& budget,
                   const Task& task);

/// Mixes depth, centres and scales into a running checksum: equal exactly if the derived geometry is.
std::uint32_t fingerprint(const Level& level, std::uint32_t seed);

}  // namespace pfgeom
