// The materials of a model's surface, fitted to those of the input's faces.
#pragma once

#include "pfgeom/compress/compress.h"
#include "pfgeom/mesh/face_materials.h"
#include "pfgeom/mesh/prepare.h"

#include <cstddef>
#include <vector>

namespace pfgeom {

struct PaintGoal {
    const TriangleMesh& input;
    const FaceMaterials& materials;
    const PreparedMesh& prepared;
    /// For each object, for each of its copies: rows of prepared.islands.
    const std::vector<std::vector<std::vector<std::size_t>>>& islands;
    double tolerance = 0;  ///< in the mesh's units
    Effort effort = Effort::normal;
};

/// `model`: as decoded. Its default mesh is measured against the input's materials.
MaterialMap paint_model(const Model& model, const PaintGoal& goal, PaintReport& report, const Task& task);

}  // namespace pfgeom
