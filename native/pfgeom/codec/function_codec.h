// The functions of a model: base quadric, perturbations, hierarchy.
#pragma once

#include "pfgeom/codec/codec_stream.h"
#include "pfgeom/function/model.h"

#include <vector>

namespace pfgeom {

void code_function(CodecStream& stream, Function& function);

}  // namespace pfgeom
