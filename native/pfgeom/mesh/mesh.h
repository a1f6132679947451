// Stage 1, the public header: polygon meshes in and out, checked and searchable.
#pragma once

#include "pfgeom/mesh/bvh.h"            // IWYU pragma: export
#include "pfgeom/mesh/file.h"           // IWYU pragma: export
#include "pfgeom/mesh/prepare.h"        // IWYU pragma: export
#include "pfgeom/mesh/sample.h"         // IWYU pragma: export
#include "pfgeom/mesh/triangle_mesh.h"  // IWYU pragma: export
