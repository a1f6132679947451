// A closed mesh as a set-operation tree: regions, their quadrics in integers, points with their side, and the
// tree that tells them apart. Points do not prove a tolerance: who certifies the tree hands back the points
// that it gets wrong, and only the leaves that they contradict grow.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/fit/tree_builder.h"
#include "pfgeom/fit/whole_checks.h"
#include "pfgeom/function/set_tree.h"
#include "pfgeom/mesh/bvh.h"
#include "pfgeom/segment/exact_patches.h"

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace pfgeom {

struct TreeFitOptions {
    double tolerance = 0;         ///< in the cube's units
    double fit_share = 0.75;      ///< of the tolerance: what a region's quadric may miss its points by
    double quantise_share = 0.9;  ///< … once it is rounded to integers
    double tube_share = 0.97;     ///< from what distance on the side of a point counts
    /// For parts that stand askew, in which cuts across axes are of little help: the outermost of parallel
    /// planes are paired first (SegmentOptions::outermost_first), and questions may ask separators
    /// (tree_seams.h).
    bool askew = false;
    std::size_t most_regions = 1000;  ///< a shape with more is for another representation
    double most_bits = std::numeric_limits<double>::infinity();  ///< and so is one whose tree takes so many
    int effort = 1;                                              ///< 0 fast, 1 normal, 2 best
    std::span<const ExactPatch> exact = {};                      ///< the mesh's
    std::vector<Spot> held;  ///< around these, whole quadrics move by so much less
    std::uint64_t seed = 1;
};

/// A tree, and what it takes to mend it.
struct TreeFit {
    SetTree tree;
    double bits = 0;  ///< estimate of the tree's code
    std::vector<Region> regions;
    double whole = 0;  ///< share of the surface that whole quadrics serve
    /// Then few samples do, and one setting: there are hardly any seams.
    bool mostly_whole() const { return whole >= 0.9; }

    RawTree raw;
    std::vector<QuantisedQuadric> quadrics;  ///< that questions may ask, used or not; separators last
    std::vector<std::int32_t> patches;       ///< of each face: its quadric
    SampleTable samples;
    BuildOptions build;
};

/// A point whose side the tree must get right.
struct KnownSide {
    Vec3 point;
    bool inside = false;
};

/// `mesh` lies in the cube [-1,1]³, closed and oriented outwards; `bvh` is the mesh's. Nothing if the surface
/// falls into too many regions; regions, and no nodes, if the tree takes too many bits.
TreeFit fit_set_tree(const TriangleMesh& mesh, const Bvh& bvh, const TreeFitOptions& options,
                     const Task& task = {});

/// The same regions once more, with other shares of the tolerance or other points held.
void refit_set_tree(TreeFit& fit, const TriangleMesh& mesh, const Bvh& bvh, const TreeFitOptions& options,
                    const Task& task = {});

/// Adds points outside the tube; grows the leaves that they contradict.
void repair_set_tree(TreeFit& fit, const Bvh& bvh, std::span<const KnownSide> points, const Task& task = {});

}  // namespace pfgeom
