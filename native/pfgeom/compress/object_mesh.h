// The mesh of one object of a model.
#pragma once

#include "pfgeom/compress/compress.h"

namespace pfgeom {

/// Where its frame puts it; patterns lie there, too.
TriangleMesh mesh_in_place(const Model& model, const Object& object, const MeshOptions& options,
                           const Task& task);

/// A mirrored copy's faces are turned round.
TriangleMesh copy_of(const TriangleMesh& mesh, const Similarity& s);

/// How far a border between materials may be from where it is, so that faces do not become slivers; in the
/// mesh's units.
double border_snap(const Model& model);

/// Materials of the mesh in place; cuts it along their borders.
std::vector<std::int32_t> paint_mesh(TriangleMesh& mesh, const Object& object, const Paint& paint,
                                     double snap, const Task& task);

}  // namespace pfgeom
