// A closed 2-manifold whose faces know the quadrics that they lie on.
#pragma once

#include "pfgeom/polygonize/surface_mesh.h"
#include "pfgeom/polygonize/tree_boundary.h"

namespace pfgeom {

struct LabelledMesh {
    SurfaceMesh mesh;
    std::vector<Label> label;  ///< by face

    Label label_at(std::int32_t half_edge) const { return label[half_edge / 3]; }
    /// Do its faces lie on different quadrics?
    bool crease(std::int32_t half_edge) const {
        return label_at(half_edge) != label_at(mesh.twin(half_edge));
    }
    /// Of the faces around from(h), each once.
    std::vector<Label> labels_around(std::int32_t half_edge) const;
    /// Cuts the edge at a new vertex; returns it.
    std::int32_t split(std::int32_t half_edge, const Vec3& point);
    void compact();
};

/// Where more than two faces meet at an edge, or several fans at a vertex, the inside is cut apart there.
LabelledMesh manifold_of(TreeBoundary&& boundary);

}  // namespace pfgeom
