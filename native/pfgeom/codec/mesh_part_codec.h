// The coded control mesh: connectivity with positions predicted from it, then the bulges of its edges.
#pragma once

#include "pfgeom/base/limits.h"
#include "pfgeom/base/status.h"
#include "pfgeom/codec/entropy.h"
#include "pfgeom/codec/mixer.h"
#include "pfgeom/function/model.h"

namespace pfgeom {

/// Puts faces and vertices into the order in which they are coded, so that encode(canonical) = canonical and
/// a decoded part equals the part that was encoded. Drops unused vertices.
MeshPart canonical(const MeshPart& part);

/// Codes `part` (canonical) or reads into it. Any face list without repeated corners is allowed
/// (non-manifold, mixed orientation, duplicates). `budget_bytes`: bytes of the stream; counts beyond what
/// they can hold give limit_exceeded. `curved`: with a bulge on each edge. Kinds 128..191 of the mixer are
/// this codec's.
FormatStatus code_mesh_part(EntropyCoder& coder, ContextMixer& mixer, MeshPart& part, bool curved,
                            std::size_t budget_bytes);

}  // namespace pfgeom
