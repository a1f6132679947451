// Models are an algebra: unions, intersections, differences and images of models are models. Operands keep
// their functions and frames; no polygons are made. The public header of this stage.
#pragma once

#include "pfgeom/function/model.h"

namespace pfgeom {

/// Inside is what is inside of a or b; a and b; a but not b. The value at a point is max(a, b), min(a, b),
/// min(a, -b) of the operands', exactly; the surface is that between inside and outside. An operand that is
/// met again is kept once. Names, labels and a place in the world that the operands do not share are dropped.
/// Throws InvalidInput if an operand has an open surface, which has no inside.
Model operator|(const Model& a, const Model& b);
Model operator&(const Model& a, const Model& b);
Model operator-(const Model& a, const Model& b);

/// The image of the model; open surfaces may be moved, too. Throws InvalidInput if the map cannot be
/// inverted.
Model transformed(const Model& model, const Affine& map);
Model transformed(const Model& model, const Similarity& map);

}  // namespace pfgeom
