// The bulges of a curved mesh part, coded when all of its flat mesh is known: predicted from the normals at
// the ends of the edge and from the bulges of edges around that are coded already.
#pragma once

#include "pfgeom/base/status.h"
#include "pfgeom/codec/entropy.h"
#include "pfgeom/codec/mixer.h"
#include "pfgeom/function/model.h"

namespace pfgeom {

/// Codes part.bulges, or reads as many as its faces have edges.
FormatStatus code_bulges(EntropyCoder& coder, ContextMixer& mixer, MeshPart& part);

}  // namespace pfgeom
