// The generated meshes of the determinism test. Made with + - × ÷ and sqrt alone: the input must not depend
// on the machine either.
#pragma once

#include "pfgeom/mesh/triangle_mesh.h"

#include <string>
#include <vector>

namespace scenes {

struct Scene {
    std::string name;
    pfgeom::TriangleMesh mesh;
    double tolerance = 1e-3;  ///< a share of the diagonal
};

std::vector<Scene> all();

}  // namespace scenes
