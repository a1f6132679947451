// The proof that a set-operation tree and a closed mesh bound the same solid within a tolerance, or points
// where they do not.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/function/set_tree.h"
#include "pfgeom/mesh/bvh.h"
#include "pfgeom/mesh/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace pfgeom {

/// A point and its side of the mesh.
struct LabelledPoint {
    Vec3 point;
    double distance = 0;     ///< to the mesh, >= 0
    std::int32_t face = -1;  ///< the closest
    bool inside = false;     ///< of the mesh
};

struct TreeBoundOptions {
    static constexpr std::int64_t kAnyNumber = std::numeric_limits<std::int64_t>::max();

    /// Cells at the border of the tube are not split below this share of the tolerance; what they leave open
    /// is added to `proved`. 1/64 proves the tolerance itself on clean models; 1/16 while repairing.
    double finest = 1.0 / 64;
    /// A cell outside the tube in which the tree might give both labels, yet no wrong point is found, is
    /// given up at this share of the tolerance.
    double give_up = 1.0 / 32;
    std::int64_t max_cells = 32'000'000;       ///< then: not certified
    std::int64_t max_unresolved = kAnyNumber;  ///< cells given up; then: not certified
    std::size_t per_leaf = 500;                ///< counter-examples kept of each wrong leaf, drawn evenly
    std::size_t labels = 60'000;               ///< labelled points kept, drawn evenly
    bool mesh_to_model = true;                 ///< false: only that the tree is right outside the tube
};

struct TreeBoundCounts {
    std::int64_t cells = 0, queries = 0, slabs = 0;  ///< of the octree
    std::int64_t wrong = 0;                          ///< counter-examples met
    std::int64_t unresolved = 0;                     ///< cells given up
    std::int64_t pieces = 0;                         ///< of the mesh
    std::int64_t missed = 0;                         ///< pieces without a change within the tolerance
    std::int64_t lost = 0;                           ///< of these, without one within twice the tolerance

    TreeBoundCounts& operator+=(const TreeBoundCounts& other);
};

struct TreeBound {
    /// Proved: no point further than `proved` from the mesh is on the wrong side of the tree's surface, and
    /// no point of the mesh is further than that from a change of the tree's label.
    bool certified = false;
    /// At least the tolerance. Without a certificate: of those cells and pieces that could be decided.
    double proved = 0;
    bool sides_defined = true;  ///< false: the mesh is no closed, oriented manifold without crossings
    bool complete =
        true;  ///< false: not all was looked at: too many cells, or enough found wrong or given up

    std::vector<LabelledPoint> counter_examples;  ///< further away than the tolerance, on the wrong side
    std::vector<LabelledPoint> missed;  ///< near mesh points without a sign change: the label missing
    std::vector<LabelledPoint> labels;  ///< others further away than the tolerance, met on the way
    /// Rows of leaves that a cell given up might reach with the wrong label and no certified cell needs.
    std::vector<std::int32_t> suspects;
    TreeBoundCounts counts;

    bool holds(double wanted) const { return certified && proved <= wanted; }
};

/// `mesh`: in the tree's cube, with `bvh` its hierarchy. Inside is what the mesh encloses, whichever way its
/// normals point; accordingly, SetTree::complement is not applied. Does not depend on the number of threads.
TreeBound bound_tree(const SetTree& tree, const TriangleMesh& mesh, const Bvh& bvh, double tolerance,
                     const TreeBoundOptions& options, const Task& task);

}  // namespace pfgeom
