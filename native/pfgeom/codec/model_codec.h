// The stream of a whole model, in either direction.
#pragma once

#include "pfgeom/codec/codec_stream.h"
#include "pfgeom/function/model.h"

#include <vector>

namespace pfgeom {

/// Bits that the parts of a stream cost, by their place in the model.
struct StreamCost {
    std::vector<double> functions;
    /// Set expressions, sheets, mesh parts and placements, without frame, nesting and instances.
    std::vector<double> shapes;
};

/// Everything of `model` but what the optional sections hold. Mesh parts must be canonical.
void code_model(CodecStream& stream, Model& model, StreamCost* cost = nullptr);

/// The least version of the format that holds it.
int version_of(const Model& model);

/// The model with its mesh parts in the order in which they are coded.
Model canonical(const Model& model);

}  // namespace pfgeom
