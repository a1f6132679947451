// What can become of an island: candidates behind one interface, each of which proves itself on the bytes
// that it would put into the file. The cheapest that holds the tolerance wins.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/compress/compress.h"
#include "pfgeom/function/model.h"
#include "pfgeom/mesh/bvh.h"
#include "pfgeom/mesh/prepare.h"
#include "pfgeom/report/deviation.h"
#include "pfgeom/segment/mirror.h"

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace pfgeom {

constexpr std::size_t kAnyBytes = std::numeric_limits<std::size_t>::max();

/// A mesh to be represented, and how well.
struct Goal {
    const TriangleMesh& mesh;  ///< one island, or several together
    const Bvh& bvh;            ///< of `mesh`
    double tolerance = 0;      ///< in the mesh's units
    Metric metric = Metric::max;
    double diagonal = 0;  ///< of the whole input
    bool inward = false;  ///< closed, and its normals point inwards
    Effort effort = Effort::normal;
    bool painted = false;     ///< the model gets materials
    bool is_pattern = false;  ///< others place it: it gets no placements of its own
};

/// A representation that was written, read back, polygonized and measured.
struct Outcome {
    std::string candidate;            ///< "quadric", "sheet", "tree", "hierarchy", "cut hierarchy" or "mesh"
    std::vector<Function> functions;  ///< of the one object; its nodes count from 0
    Object object;
    std::size_t bytes = 0;  ///< as a file of its own
    TriangleMesh mesh;      ///< the default mesh
    Deviation deviation;
    bool holds = false;
    double bound_functions = 0;  ///< proved of the functions' own surface, in the mesh's units; 0: not known
};

/// One ellipsoid.
std::optional<Outcome> try_quadric(const Goal& goal, const Task& task);
/// One quadric cut by another, for an island with a border.
std::optional<Outcome> try_sheet(const Goal& goal, const Task& task);
/// How many bytes a tree may take that takes `bytes` before it is mended, which only makes it larger.
using TreeLimit = std::function<std::size_t(std::size_t bytes)>;
/// A set-operation tree over quadrics, for a closed island that is made of them. Gives up when it needs more
/// than `most_bytes`.
std::optional<Outcome> try_tree(const Goal& goal, const TreeLimit& most_bytes, const Task& task);
/// Base quadric + hierarchy of perturbations, for a closed island. Gives up when it needs more than
/// `most_bytes`.
std::optional<Outcome> try_hierarchy(const Goal& goal, std::size_t most_bytes, const Task& task);
/// The same where quadrics cut it: faces between creases that lie on one become operands of an intersection,
/// and the hierarchy is fitted to the rest. Nothing if there are no such faces.
std::optional<Outcome> try_cut_hierarchy(const Goal& goal, std::size_t most_bytes, const Task& task);
/// A hierarchy for an island with borders: they are closed, and the function's surface is cut along them.
std::optional<Outcome> try_open_hierarchy(const Goal& goal, std::size_t most_bytes, const Task& task);
/// What the simplified and coded mesh would take with flat faces, at a small part of the work.
struct MeshEstimate {
    std::size_t least = 0;   ///< hardly ever fewer bytes than this where the shape is made of quadrics
    std::size_t likely = 0;  ///< hardly ever more than this
    std::optional<Mirror> mirror;

    /// A half takes about half as much.
    std::size_t least_mirrored() const { return mirror ? least / 2 : least; }
};
MeshEstimate estimate_mesh(const Goal& goal, const Task& task);

/// Simplified and coded mesh, its faces flat or curved: any shape; holds, unless it needs more than
/// `most_bytes`. An estimate that is not known is made where it is needed.
Outcome try_mesh(const Goal& goal, std::optional<MeshEstimate> known, std::size_t most_bytes,
                 const Task& task);

/// The cheapest candidate that holds, for an oriented island that is closed, or a manifold with a border.
/// Nothing: it is for a mesh part.
std::optional<Outcome> fit_island(const Island& island, const Goal& goal, const Task& task);

/// A file of this one object.
Model model_of(const Goal& goal, const Outcome& outcome);

/// Of two certified deviations.
void take_maximum(const Deviation& more, Deviation& deviation);

/// How far the default mesh is from the goal's, and whether that is within its tolerance. The maximum is
/// proved where it is what counts.
struct Measured {
    Deviation deviation;
    bool holds = false;
};
Measured measure(const Goal& goal, const TriangleMesh& mesh, const Task& task);

/// Encodes a model of this one object, decodes it, polygonizes and measures: fills bytes, mesh, deviation,
/// holds. The maximum is proved where it is what counts.
void prove(const Goal& goal, Outcome& outcome, const Task& task);

}  // namespace pfgeom
