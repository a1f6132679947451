#include "pfgeom/eval/model_field.h"

#include "pfgeom/eval/distance_field.h"
#include "pfgeom/eval/mesh_part.h"
#include "pfgeom/eval/solid_field.h"
#include "pfgeom/eval/tree_field.h"
#include "pfgeom/function/moved_box.h"
#include "pfgeom/function/trim.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace pfgeom {
namespace {

// A sheet as the solid that is empty around it: min(-|surface|, trim), which is zero on the sheet alone.
std::unique_ptr<ScalarField> nothing_but(const Model& model, const Sheet& sheet) {
    using Kind = SetNode::Kind;
    const Trim trim = trim_of(model, sheet);
    Model alone;
    alone.functions = {model.functions[static_cast<std::size_t>(sheet.surface)]};
    alone.functions.insert(alone.functions.end(), trim.functions.begin(), trim.functions.end());
    Solid solid{{{Kind::function, 0}, {Kind::complement, 0}, {Kind::intersect, 0, 1}}};
    append_trim(trim, 1, solid.nodes);
    solid.nodes.push_back({Kind::intersect, 2, static_cast<std::int32_t>(solid.nodes.size()) - 1});
    return std::make_unique<SolidField>(alone, solid);
}

using Kind = CombinationStep::Kind;

}  // namespace

// One object with its copies; value and gradient are in the world's units.
struct ModelField::Part {
    Frame frame;
    std::vector<Similarity> copies;
    std::int32_t cavity_of = -1;
    std::unique_ptr<ScalarField> solid;     // in the frame's cube, which holds it
    std::optional<DistanceField> distance;  // a mesh part's, in the world
    Box box;

    Part(const Model& model, const Object& object, double diagonal)
        : frame(object.frame), copies(copies_of(object)), cavity_of(object.cavity_of) {
        const Vec3 h{frame.half(), frame.half(), frame.half()};
        box = {frame.centre() - h, frame.centre() + h};
        if (const auto* s = std::get_if<Solid>(&object.shape)) {
            solid = std::make_unique<SolidField>(model, without_outer_complement(*s));
        } else if (const auto* sheet = std::get_if<Sheet>(&object.shape)) {
            solid = nothing_but(model, *sheet);
        } else if (const auto* tree = std::get_if<SetTree>(&object.shape)) {
            solid = std::make_unique<TreeField>(*tree);
            box = {frame.to_world(tree->box().lo), frame.to_world(tree->box().hi)};
        } else if (std::holds_alternative<MeshPart>(object.shape)) {
            distance.emplace(mesh_for_values(object, diagonal));
            box = distance->bounds();
        }
    }

    Jet in_place(const Vec3& p) const {
        if (!solid && !distance) return {-1e30, {}};
        Jet jet;
        if (distance) {
            jet.value = distance->value_and_gradient(p, jet.gradient);
            return jet;
        }
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
        if (distance) {
            const Vec3 nearest = max(box.lo, min(p, box.hi));
            constexpr double kRounded = 1 - 1e-9;
            return -kRounded * norm(p - nearest) < value;
        }
        const double most = most_beyond_cube(p);
        return most < 0 && most <= value;
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

    Box bounds() const {
        Box all;
        for (const Similarity& s : copies) all.grow(box_of_image(box, s));
        return all;
    }
};

// A node of the combination; one operand with all objects where there is none.
struct ModelField::Node {
    CombinationNode what;
    Box box{};           // of its surface, in the model's space
    double reach = 0;    // beyond the box the value is at most -reach times the distance, in the maximum norm
    Affine back{};       // operand: to its own space
    double stretch = 1;  // operand: values there times this are at most distances here

    double most_at(const Vec3& p) const {
        const Vec3 d = max(box.lo - p, p - box.hi);
        const double beyond = std::max({d.x, d.y, d.z});
        return beyond > 0 ? -reach * beyond : std::numeric_limits<double>::infinity();
    }
};

ModelField::ModelField(const Model& model) : parts_(model.objects.size()) {
    for (const CombinationNode& what : combination_tree(model)) {
        if (what.is_operand()) add_parts(model, what);
        nodes_.push_back(node_of(what));
    }
}
ModelField::~ModelField() = default;
ModelField::ModelField(ModelField&&) noexcept = default;
ModelField& ModelField::operator=(ModelField&&) noexcept = default;

const ModelField::Node& ModelField::node_at(std::int32_t index) const {
    return nodes_[static_cast<std::size_t>(index)];
}

// Operands that are used again are there already.
void ModelField::add_parts(const Model& model, const CombinationNode& operand) {
    for (std::int32_t i = operand.first; i < operand.last; ++i) {
        const auto row = static_cast<std::size_t>(i);
        if (!parts_[row]) parts_[row] = std::make_unique<Part>(model, model.objects[row], operand.diagonal);
    }
}

ModelField::Node ModelField::node_of(const CombinationNode& what) const {
    // The maximum norm of a turned box's distance, and rounding.
    constexpr double kTurned = 0.57735 * (1 - 1e-6);
    Node node{.what = what};
    if (!what.is_operand()) {
        const Node &a = node_at(what.a), &b = node_at(what.b);
        node.reach = std::min(a.reach, b.reach);
        node.box = a.box;
        if (what.kind == Kind::unite) node.box.grow(b.box);
        if (what.kind == Kind::intersect) node.box = {max(a.box.lo, b.box.lo), min(a.box.hi, b.box.hi)};
        return node;
    }
    node.reach = kTurned;
    for (std::int32_t i = what.first; i < what.last; ++i)
        node.box.grow(parts_[static_cast<std::size_t>(i)]->bounds());
    if (!what.moved) return node;
    node.back = inverse_of(what.place);
    node.stretch = 1 / most_stretch(node.back);
    node.reach *= node.stretch / most_stretch(what.place);
    node.box = box_of_image(node.box, what.place);
    return node;
}

// Cavities stand behind what they are taken out of.
Jet ModelField::operand_jet(std::int32_t first, std::int32_t last, const Vec3& p) const {
    const auto from = static_cast<std::size_t>(first), to = static_cast<std::size_t>(last);
    std::vector<Jet> jets;
    jets.reserve(to - from);
    for (std::size_t i = from; i < to; ++i) jets.push_back(parts_[i]->jet(p));
    for (std::size_t i = to; i-- > from;) {
        if (parts_[i]->cavity_of < 0) continue;
        Jet& outer = jets[static_cast<std::size_t>(parts_[i]->cavity_of) - from];
        const Jet& hollow = jets[i - from];
        if (-hollow.value < outer.value) outer = {-hollow.value, -hollow.gradient};
    }
    Jet best{-1e30, {}};
    for (std::size_t i = from; i < to; ++i) {
        if (parts_[i]->cavity_of < 0 && jets[i - from].value > best.value) best = jets[i - from];
    }
    return best;
}

// Max, min and min with the negative; what cannot matter is not asked. Recursion as deep as the combination,
// at most Combination::kMostDepth.
Jet ModelField::jet(std::int32_t index, const Vec3& p) const {
    const Node& node = node_at(index);
    const CombinationNode& what = node.what;
    if (what.is_operand()) {
        if (!what.moved) return operand_jet(what.first, what.last, p);
        const Jet there = operand_jet(what.first, what.last, node.back.apply(p));
        return {there.value * node.stretch, node.back.pull(there.gradient) * node.stretch};
    }
    const Node& other = node_at(what.b);
    if (what.kind == Kind::unite && node_at(what.a).most_at(p) < other.most_at(p)) {
        const Jet b = jet(what.b, p);
        if (node_at(what.a).most_at(p) < b.value) return b;
        const Jet a = jet(what.a, p);
        return a.value >= b.value ? a : b;
    }
    const Jet a = jet(what.a, p);
    if (what.kind == Kind::unite && other.most_at(p) < a.value) return a;
    if (what.kind == Kind::subtract && -other.most_at(p) > a.value) return a;
    Jet b = jet(what.b, p);
    if (what.kind == Kind::unite) return a.value >= b.value ? a : b;
    if (what.kind == Kind::subtract) b = {-b.value, -b.gradient};
    return a.value <= b.value ? a : b;
}

Jet ModelField::jet(const Vec3& p) const {
    return jet(static_cast<std::int32_t>(nodes_.size()) - 1, p);
}

double ModelField::value(const Vec3& world) const {
    return jet(world).value;
}

Vec3 ModelField::gradient(const Vec3& world) const {
    return jet(world).gradient;
}

Box ModelField::bounds() const {
    return nodes_.back().box;
}

}  // namespace pfgeom
