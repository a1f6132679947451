// The mesh of one object of a model.
#pragma once

#include "pfgeom/compress/compress.h"

#include <span>

namespace pfgeom {

/// Depths of cells that meshes of one object are made with.
constexpr int kLeastDepth = 3, kMostDepth = 10;
/// The depth at which cells of a cube of half edge `half` are no larger than `size`.
int depth_for(double half, double size);

/// Of its copies.
double largest_scale(const Object& object);

/// Objects of one shape, where they lie without the transforms of an operand, and what is asked of their
/// mesh.
struct ObjectsToMesh {
    std::span<const Object> list;
    double diagonal = 0;
    MeshOptions options{};

    double largest_half() const;
    /// What the pattern may miss so that none of its copies misses more.
    double chord_for(const Object& object) const;
    /// The longest cell or edge of the pattern.
    double cell_for(const Object& object) const;
    bool thin() const { return options.thin && !options.tolerance && !options.resolution; }
};

/// Where its frame puts it; patterns lie there, too.
TriangleMesh mesh_in_place(const Model& model, const ObjectsToMesh& all, const Object& object,
                           const Task& task);

void turn_faces(TriangleMesh& mesh);

/// A mirrored copy's faces are turned round.
TriangleMesh copy_of(TriangleMesh mesh, const Similarity& s);

/// How far a border between materials may be from where it is, so that faces do not become slivers; in the
/// mesh's units.
double border_snap(const Model& model);

/// Materials of the mesh in place; cuts it along their borders.
std::vector<std::int32_t> paint_mesh(TriangleMesh& mesh, const Object& object, const Paint& paint,
                                     double snap, const Task& task);

}  // namespace pfgeom
