#include "pfgeom/algebra/algebra.h"

#include "pfgeom/algebra/closed.h"
#include "pfgeom/algebra/merge.h"
#include "pfgeom/algebra/promise.h"
#include "pfgeom/base/error.h"
#include "pfgeom/eval/model_field.h"
#include "pfgeom/function/check.h"

#include <algorithm>
#include <string>

namespace pfgeom {
namespace {

using Kind = CombinationStep::Kind;

// What the steps say of the whole. A result without a surface has the size of its operands.
void finish(Model& model, double least_diagonal) {
    if (const std::string flaw = find_flaw(model); !flaw.empty()) throw InvalidInput(flaw);
    model.promise = promise_of(model.combination, combination_tree(model));
    const Box box = ModelField(model).bounds();
    const double diagonal =
        box.lo.x <= box.hi.x && box.lo.y <= box.hi.y && box.lo.z <= box.hi.z ? box.diagonal() : 0;
    model.diagonal = diagonal > 0 ? diagonal : least_diagonal;
}

Model combined(const Model& a, const Model& b, Kind kind) {
    require_closed(a);
    require_closed(b);
    Model both;
    append_operands(a, both);
    append_operands(b, both);
    both.combination.steps.push_back({kind, -1});
    if (a.world_transform == b.world_transform) both.world_transform = a.world_transform;
    both.diagonal = std::max(a.diagonal, b.diagonal);
    finish(both, both.diagonal);
    return both;
}

}  // namespace

Model operator|(const Model& a, const Model& b) {
    return combined(a, b, Kind::unite);
}

Model operator&(const Model& a, const Model& b) {
    return combined(a, b, Kind::intersect);
}

Model operator-(const Model& a, const Model& b) {
    return combined(a, b, Kind::subtract);
}

// One after another are one.
Model transformed(const Model& model, const Affine& map) {
    if (const std::string flaw = find_flaw(map); !flaw.empty()) throw InvalidInput(flaw);
    Model image;
    append_operands(model, image);
    Combination& c = image.combination;
    if (c.steps.back().kind == Kind::transform) {
        c.transforms.back() = composed(map, c.transforms.back());
    } else {
        c.transforms.push_back(map);
        c.steps.push_back({Kind::transform, static_cast<std::int32_t>(c.transforms.size()) - 1});
    }
    image.names = model.names;
    image.world_transform = model.world_transform;
    image.face_groups = model.face_groups;
    image.materials = model.materials;
    image.diagonal = model.diagonal;
    finish(image, model.diagonal * most_stretch(map));
    return image;
}

Model transformed(const Model& model, const Similarity& map) {
    return transformed(model, affine_of(map));
}

}  // namespace pfgeom
