// Where an object's copies lie (docs/FORMAT.md, section 5, "Placements"): only in streams of version 2.
#pragma once

#include "pfgeom/codec/codec_stream.h"
#include "pfgeom/function/placement.h"

namespace pfgeom {

constexpr std::size_t kRecentTurns = 64;  ///< that a placement can have again

/// `scale_code`: of the object's frame. In normal form (function/placement.h); a reader's result need not be.
void code_placements(CodecStream& stream, Placements& placements, int scale_code);

}  // namespace pfgeom
