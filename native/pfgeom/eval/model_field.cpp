#include "pfgeom/eval/model_field.h"

#include "pfgeom/eval/mesh_part.h"
#include "pfgeom/eval/solid_field.h"
#include "pfgeom/eval/tree_field.h"
#include "pfgeom/mesh/bvh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace pfgeom {
namespace {

// An inside-out solid's root is a complement; what it encloses counts as inside all the same.
Solid without_outer_complement(const Solid& solid) {
    Solid inner = solid;
    if (!inner.nodes.empty() && inner.nodes.back().kind == SetNode::Kind::complement &&
        inner.nodes.back().a == static_cast<std::int32_t>(inner.nodes.size()) - 2) {
        inner.nodes.pop_back();
    }
    return inner;
}

// A sheet as the solid that is empty around it: min(-|surface|, trim), which is zero on the sheet alone.
Solid nothing_but(const Sheet& sheet) {
    using Kind = SetNode::Kind;
    return {{{Kind::function, sheet.surface},
             {Kind::complement, 0},
             {Kind::intersect, 0, 1},
             {Kind::function, sheet.trim},
             {Kind::intersect, 2, 3}}};
}

// Curved faces are divided until they are this share of the default mesh's chord tolerance from the surface.
constexpr double kChordShare = 0.25;

}  // namespace

// One object with its copies; value and gradient are in the world's units.
struct ModelField::Part {
    Frame frame;
    std::vector<Similarity> copies;
    std::int32_t cavity_of = -1;
    std::unique_ptr<ScalarField> solid;  // in the frame's cube, which holds it
    std::optional<Bvh> bvh;
    Box box;

    Part(const Model& model, const Object& object)
        : frame(object.frame), copies(copies_of(object)), cavity_of(object.cavity_of) {
        const Vec3 h{frame.half(), frame.half(), frame.half()};
        box = {frame.centre() - h, frame.centre() + h};
        if (const auto* s = std::get_if<Solid>(&object.shape)) {
            solid = std::make_unique<SolidField>(model, without_outer_complement(*s));
        } else if (const auto* sheet = std::get_if<Sheet>(&object.shape)) {
            solid = std::make_unique<SolidField>(model, nothing_but(*sheet));
        } else if (const auto* tree = std::get_if<SetTree>(&object.shape)) {
            solid = std::make_unique<TreeField>(*tree);
            box = {frame.to_world(tree->box().lo), frame.to_world(tree->box().hi)};
        } else if (std::holds_alternative<MeshPart>(object.shape)) {
            bvh.emplace(mesh_of(object, {.chord = kChordShare * chord_of(model, object)}));
            box = bvh->bounds();
        }
    }

    Jet in_place(const Vec3& p) const {
        if (bvh) return distance_jet(p);
        if (!solid) return {-1e30, {}};
        Jet jet;
        jet.value = solid->value_and_gradient(frame.to_local(p), jet.gradient) * frame.half();
        // Outside of its cube a solid is empty.
        if (const double most = most_beyond_cube(p); most < 0) jet.value = std::min(jet.value, most);
        return jet;
    }

    double most_beyond_cube(const Vec3& p) const {
        const Vec3 local = frame.to_local(p);
        const double beyond = std::max({std::abs(local.x), std::abs(local.y), std::abs(local.z)}) - 1;
        return -beyond * frame.half();
    }

    // Far copies need not be asked.
    bool cannot_exceed(const Vec3& p, double value) const {
        if (bvh) {
            const Vec3 nearest = max(box.lo, min(p, box.hi));
            constexpr double kRounded = 1 - 1e-9;
            return -kRounded * norm(p - nearest) < value;
        }
        const double most = most_beyond_cube(p);
        return most < 0 && most <= value;
    }

    Jet distance_jet(const Vec3& p) const {
        const ClosestPoint c = bvh->closest(p);
        const double d = std::sqrt(c.squared_distance);
        const bool inside = std::abs(bvh->winding_number(p)) > 0.5;
        const Vec3 away = normalized(p - c.point);
        return inside ? Jet{d, away} : Jet{-d, -away};
    }

    // Union of the copies.
    Jet jet(const Vec3& p) const {
        Jet best{-std::numeric_limits<double>::infinity(), {}};
        for (const Similarity& s : copies) {
            const Vec3 local = s.apply_inverse(p);
            if (cannot_exceed(local, best.value / s.scale)) continue;
            Jet j = in_place(local);
            j.value *= s.scale;
            j.gradient = s.turn(j.gradient);
            if (j.value > best.value) best = j;
        }
        return best;
    }
};

ModelField::ModelField(const Model& model) {
    for (const Object& object : model.objects) parts_.push_back(std::make_unique<Part>(model, object));
}
ModelField::~ModelField() = default;
ModelField::ModelField(ModelField&&) noexcept = default;
ModelField& ModelField::operator=(ModelField&&) noexcept = default;

namespace {

template <class Parts>
Jet union_of(const Parts& parts, const Vec3& p) {
    std::vector<Jet> jets;
    jets.reserve(parts.size());
    for (const auto& part : parts) jets.push_back(part->jet(p));
    // Cavities stand behind what they are taken out of.
    for (std::size_t i = parts.size(); i-- > 0;) {
        if (parts[i]->cavity_of < 0) continue;
        Jet& outer = jets[static_cast<std::size_t>(parts[i]->cavity_of)];
        if (-jets[i].value < outer.value) outer = {-jets[i].value, -jets[i].gradient};
    }
    Jet best{-1e30, {}};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (parts[i]->cavity_of < 0 && jets[i].value > best.value) best = jets[i];
    }
    return best;
}

}  // namespace

double ModelField::value(const Vec3& world) const {
    return union_of(parts_, world).value;
}

Vec3 ModelField::gradient(const Vec3& world) const {
    return union_of(parts_, world).gradient;
}

Box ModelField::bounds() const {
    Box all;
    for (const auto& part : parts_) {
        for (const Similarity& s : part->copies) {
            for (int corner = 0; corner < 8; ++corner) {
                all.grow(s.apply({(corner & 1) != 0 ? part->box.hi.x : part->box.lo.x,
                                  (corner & 2) != 0 ? part->box.hi.y : part->box.lo.y,
                                  (corner & 4) != 0 ? part->box.hi.z : part->box.lo.z}));
            }
        }
    }
    return all;
}

}  // namespace pfgeom
