// A set tree in a stream: box, then the nodes depth first, each quadric where it is first asked. References
// are ranked by how recently a quadric was asked, those that are certain in the cell or were asked on the
// path last or not at all.
#pragma once

#include "pfgeom/codec/backoff_model.h"
#include "pfgeom/codec/codec_stream.h"
#include "pfgeom/function/set_tree.h"

namespace pfgeom {

/// Codes `tree` (well formed, function/check.h) or reads into it. `model` may have seen other trees. Reading
/// fails the stream where the tree would be deeper than kMaxTreeDepth or larger than the bytes account for.
void code_set_tree(CodecStream& stream, BackoffModel& model, SetTree& tree);

}  // namespace pfgeom
