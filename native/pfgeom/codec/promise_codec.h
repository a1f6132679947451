// The head of the stream: the input's diagonal and what was promised and measured. Eight to ten bytes.
#pragma once

#include "pfgeom/codec/codec_stream.h"
#include "pfgeom/function/model.h"

namespace pfgeom {

/// Rounds up the diagonal (by less than one part in 65,000), the bounds and the rms (3 %, but never from
/// below the tolerance to above it). A tolerance that is a decimal of up to three digits, as a share of the
/// diagonal or as a length, stays exactly that.
void code_promise(CodecStream& stream, double& diagonal, Promise& promise);

}  // namespace pfgeom
