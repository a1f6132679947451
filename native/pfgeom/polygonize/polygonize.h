// The public header of the way back: a scalar field's zero set as a closed 2-manifold triangle mesh.
#pragma once

#include "pfgeom/base/limits.h"
#include "pfgeom/base/task.h"
#include "pfgeom/eval/scalar_field.h"
#include "pfgeom/function/model.h"
#include "pfgeom/function/set_tree.h"
#include "pfgeom/mesh/triangle_mesh.h"

#include <cstddef>

namespace pfgeom {

class CutSolid;

struct PolygonizeOptions {
    double tolerance = 1e-3;  ///< aimed distance between mesh and zero set, in the field's units
    int min_depth = 4;        ///< cells are never larger than 2 / 2^min_depth
    int max_depth = 10;       ///< nor smaller than 2 / 2^max_depth; min == max: a uniform grid
    std::size_t max_cells = Limits{}.polygon_cells;
    std::size_t max_faces = Limits{}.polygon_faces;
    /// Of trees: where a wall no higher than this stands between surfaces that face the same way the mesh
    /// leads from the one to the other without it. What folds are narrower go, too.
    double highest_step = 0;
};

/// Throws InvalidInput where an option makes no sense.
void check(const PolygonizeOptions& options);

/// Zero set of `field` within the cube [-1,1]³, outside of which the field counts as negative (the surface is
/// closed there). Adaptive; vertices lie on the zero set; triangles are counter-clockwise seen from outside
/// (where the field is < 0); every edge has exactly two faces, in opposite directions, every vertex one fan.
/// The same field and options give the same mesh for any number of threads, bit for bit.
/// Not guaranteed: freedom from self-intersections; features smaller than a cell of max_depth.
/// Throws LimitExceeded (a cap, named) and Cancelled.
TriangleMesh polygonize(const ScalarField& field, const PolygonizeOptions& options, const Task& task = {});

/// The surface of a set tree (`complement` is not applied), with its creases and corners as edges and
/// vertices of the mesh; the same promises. Walls and grooves show though they are much thinner than the
/// cells; those thinner than the tolerance may have holes where they are bent.
TriangleMesh polygonize(const SetTree& tree, const PolygonizeOptions& options, const Task& task = {});

/// Any solid made for cutting (polygonize/cut_solid.h), likewise.
TriangleMesh polygonize(const CutSolid& solid, const PolygonizeOptions& options, const Task& task = {});

/// The surface of a solid of the model, in its cube: of one function its zero set, of more with the creases
/// in which they meet; those of functions with perturbations are met to within the tolerance only.
TriangleMesh polygonize(const Model& model, const Solid& solid, const PolygonizeOptions& options,
                        const Task& task = {});

/// The surface of a model's combination within the frame's cube, in the cube's coordinates: as of trees, with
/// creases where the operands' surfaces cross. Creases of a smooth operand, of which mesh parts are, are met
/// to within the tolerance only. Throws InvalidInput if an object is a sheet.
TriangleMesh polygonize_combination(const Model& model, const Frame& frame, const PolygonizeOptions& options,
                                    const Task& task = {});

/// The zero set of `surface` in the cube where `trim` is >= 0. Its border, except where the cube ends it,
/// lies on both zero sets. The rest as for trees.
TriangleMesh polygonize_sheet(const Quadric& surface, const Quadric& trim, const PolygonizeOptions& options,
                              const Task& task = {});

}  // namespace pfgeom
