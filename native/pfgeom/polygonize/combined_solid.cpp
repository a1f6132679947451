#include "pfgeom/polygonize/combined_solid.h"

#include "pfgeom/base/error.h"
#include "pfgeom/eval/distance_field.h"
#include "pfgeom/eval/function_field.h"
#include "pfgeom/eval/mesh_part.h"
#include "pfgeom/eval/solid_field.h"
#include "pfgeom/polygonize/placed_field.h"
#include "pfgeom/polygonize/polygonize.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace pfgeom {
namespace {

using Kind = CombinationStep::Kind;

// Of the solid; some 50 bytes each with what refers to them.
constexpr std::size_t kMostNodes = 1 << 22;
// Cells in which a field may be zero are at most this share of what it fills, as those of polygonize.cpp at
// its default least depth.
constexpr double kLargestCell = 1.0 / 16;

class Builder {
  public:
    Builder(const Model& model, const Affine& world, const Task& task)
        : model_(model),
          task_(task),
          world_(world),
          functions_(model.functions.size()),
          meshes_(model.objects.size()) {}

    CutSolid whole() {
        tree_ = combination_tree(model_);
        add(static_cast<std::int32_t>(tree_.size()) - 1);
        return finished();
    }
    CutSolid of(const Solid& solid) {
        add_solid(solid, {}, 0);
        return finished();
    }

  private:
    CutSolid finished() {
        out_.finish();
        return std::move(out_);
    }
    std::size_t push(const SolidNode& node) {
        if (nodes().size() >= kMostNodes)
            throw LimitExceeded("polygonize: the combination has more than " + std::to_string(kMostNodes) +
                                " nodes");
        nodes().push_back(node);
        return nodes().size() - 1;
    }
    std::vector<SolidNode>& nodes() { return out_.nodes(); }
    // What is added next is the low child or the second operand.
    void turn_to_low(std::size_t node) { nodes()[node].low = static_cast<std::int32_t>(nodes().size()); }

    void add(std::int32_t index);
    void add_operand(const CombinationNode& operand);
    void add_object(std::int32_t object, const CombinationNode& operand);
    void add_copies(std::int32_t object, const CombinationNode& operand);
    void add_shape(std::int32_t object, double diagonal, const Affine& back);
    void add_tree(const SetTree& tree, const Affine& cube);
    void add_solid(const Solid& solid, const Affine& cube, int sides);
    void add_node(const Solid& solid, std::int32_t index, const Affine& cube);
    void add_mesh(std::int32_t object, double diagonal, const Affine& back);
    void add_question(std::int32_t question);
    std::int32_t question_of(std::int32_t function, const Affine& cube);
    template <class Add>
    void add_union(std::size_t first, std::size_t last, Add add);

    const Model& model_;
    const Task& task_;
    std::vector<CombinationNode> tree_;  // of the whole model
    Affine world_;                       // from the common cube
    std::vector<std::shared_ptr<const FunctionField>> functions_;
    std::vector<std::shared_ptr<const DistanceField>> meshes_;
    std::map<std::int32_t, std::int32_t> asked_;  // function -> question, in the present copy
    CutSolid out_;
};

void Builder::add(std::int32_t index) {
    const CombinationNode& node = tree_[static_cast<std::size_t>(index)];
    if (node.is_operand()) return add_operand(node);
    const bool unites = node.kind == Kind::unite;
    const std::size_t at = push({unites ? SolidNode::kUnite : SolidNode::kIntersect, -1, false});
    add(node.a);
    turn_to_low(at);
    if (node.kind == Kind::subtract) push({SolidNode::kComplement, -1, false});
    add(node.b);
}

// Halves, so that many are not deep.
template <class Add>
void Builder::add_union(std::size_t first, std::size_t last, Add add) {
    if (last - first == 1) return add(first);
    const std::size_t at = push({SolidNode::kUnite, -1, false}), middle = first + (last - first) / 2;
    add_union(first, middle, add);
    turn_to_low(at);
    add_union(middle, last, add);
}

void Builder::add_operand(const CombinationNode& operand) {
    std::vector<std::int32_t> outer;
    for (std::int32_t i = operand.first; i < operand.last; ++i)
        if (model_.objects[static_cast<std::size_t>(i)].cavity_of < 0) outer.push_back(i);
    if (outer.empty()) {
        push({});
        return;
    }
    add_union(0, outer.size(), [&](std::size_t i) { add_object(outer[i], operand); });
}

// Without its cavities, in the order in which ModelField takes them out: those of a cavity count if they
// stand behind it.
void Builder::add_object(std::int32_t object, const CombinationNode& operand) {
    task_.check();
    std::vector<std::int32_t> hollows;
    const bool hollow = model_.objects[static_cast<std::size_t>(object)].cavity_of >= 0;
    for (std::int32_t i = hollow ? object + 1 : operand.first; i < operand.last; ++i)
        if (model_.objects[static_cast<std::size_t>(i)].cavity_of == object) hollows.push_back(i);
    if (hollows.empty()) return add_copies(object, operand);
    const std::size_t at = push({SolidNode::kIntersect, -1, false});
    add_copies(object, operand);
    turn_to_low(at);
    push({SolidNode::kComplement, -1, false});
    add_union(0, hollows.size(), [&](std::size_t i) { add_object(hollows[i], operand); });
}

void Builder::add_copies(std::int32_t object, const CombinationNode& operand) {
    const std::vector<Similarity> copies = copies_of(model_.objects[static_cast<std::size_t>(object)]);
    const Affine own = operand.moved ? composed(inverse_of(operand.place), world_) : world_;
    add_union(0, copies.size(), [&](std::size_t i) {
        const bool moved = !(copies[i] == Similarity{});
        add_shape(object, operand.diagonal, moved ? composed(inverse_of(affine_of(copies[i])), own) : own);
    });
}

// `back`: from the common cube to the world in which the object lies in its frame.
void Builder::add_shape(std::int32_t object, double diagonal, const Affine& back) {
    const Object& o = model_.objects[static_cast<std::size_t>(object)];
    asked_.clear();
    if (std::holds_alternative<MeshPart>(o.shape)) return add_mesh(object, diagonal, back);
    const Affine cube = composed(inverse_of(affine_of(o.frame)), back);
    if (const auto* tree = std::get_if<SetTree>(&o.shape)) return add_tree(*tree, cube);
    if (const auto* solid = std::get_if<Solid>(&o.shape))
        return add_solid(without_outer_complement(*solid), cube, 0);
    throw InvalidInput("object " + std::to_string(object) + " is an open sheet, which has no inside");
}

void Builder::add_tree(const SetTree& tree, const Affine& cube) {
    const TreePruner pruner(tree);
    const auto first = static_cast<std::int32_t>(out_.questions());
    for (std::size_t i = 0; i < pruner.questions(); ++i)
        out_.add(substituted(pruner.quadric(static_cast<std::int32_t>(i)), cube));
    const auto root = static_cast<std::int32_t>(nodes().size());
    for (const PrunedNode& node : pruner.whole()) {
        const bool leaf = node.question < 0;
        push({leaf ? SolidNode::kLeaf : first + node.question, leaf ? -1 : root + node.low, node.inside});
    }
}

// Outside of its cube a solid is empty: the cube's sides are asked before it.
void Builder::add_solid(const Solid& solid, const Affine& cube, int sides) {
    if (sides == 6) return add_node(solid, static_cast<std::int32_t>(solid.nodes.size()) - 1, cube);
    const Vec3 towards = cube.rows[static_cast<std::size_t>(sides / 2)] * (sides % 2 == 0 ? 1.0 : -1.0);
    const double at = cube.translation[sides / 2] * (sides % 2 == 0 ? 1.0 : -1.0);
    const Quadric side{{0, 0, 0, 0, 0, 0, towards.x, towards.y, towards.z, 1 + at}};
    const std::size_t node = push({out_.add(side), -1, false});
    add_solid(solid, cube, sides + 1);
    turn_to_low(node);
    push({});
}

void Builder::add_node(const Solid& solid, std::int32_t index, const Affine& cube) {
    const SetNode& node = solid.nodes[static_cast<std::size_t>(index)];
    switch (node.kind) {
        case SetNode::Kind::function:
            return add_question(question_of(node.a, cube));
        case SetNode::Kind::complement:
            push({SolidNode::kComplement, -1, false});
            return add_node(solid, node.a, cube);
        case SetNode::Kind::unite:
        case SetNode::Kind::intersect:
        case SetNode::Kind::decide: {
            const std::int32_t question = node.kind == SetNode::Kind::decide  ? question_of(node.f, cube)
                                          : node.kind == SetNode::Kind::unite ? SolidNode::kUnite
                                                                              : SolidNode::kIntersect;
            const std::size_t at = push({question, -1, false});
            add_node(solid, node.a, cube);
            turn_to_low(at);
            return add_node(solid, node.b, cube);
        }
        case SetNode::Kind::inside:
        case SetNode::Kind::outside:
            break;
    }
    push({SolidNode::kLeaf, -1, node.kind == SetNode::Kind::inside});
}

void Builder::add_question(std::int32_t question) {
    const std::size_t at = push({question, -1, false});
    push({SolidNode::kLeaf, -1, true});
    turn_to_low(at);
    push({});
}

std::int32_t Builder::question_of(std::int32_t function, const Affine& cube) {
    const auto [place, fresh] = asked_.try_emplace(function, -1);
    if (!fresh) return place->second;
    const Function& f = model_.functions[static_cast<std::size_t>(function)];
    if (f.is_quadric()) return place->second = out_.add(substituted(f.base, cube));
    auto& field = functions_[static_cast<std::size_t>(function)];
    if (!field) field = std::make_shared<FunctionField>(f);
    return place->second = out_.add(SmoothQuestion{std::make_shared<PlacedField>(field, cube),
                                                   2 * kLargestCell / most_stretch(cube), 0});
}

void Builder::add_mesh(std::int32_t object, double diagonal, const Affine& back) {
    auto& mesh = meshes_[static_cast<std::size_t>(object)];
    if (!mesh) {
        // The mesh of values at points, so that both have the same inside.
        const Object& o = model_.objects[static_cast<std::size_t>(object)];
        mesh = std::make_shared<DistanceField>(mesh_for_values(o, diagonal), task_);
    }
    const Vec3 extent = mesh->bounds().extent();
    const double size = std::max({extent.x, extent.y, extent.z});
    const double stretch = most_stretch(back);
    add_question(out_.add(
        SmoothQuestion{std::make_shared<PlacedField>(mesh, back), size * kLargestCell / stretch, stretch}));
}

}  // namespace

CutSolid combined_solid(const Model& model, const Frame& frame, const Task& task) {
    return Builder(model, affine_of(frame), task).whole();
}

CutSolid combined_solid(const Model& model, const Solid& solid, const Task& task) {
    return Builder(model, {}, task).of(solid);
}

TriangleMesh polygonize(const Model& model, const Solid& solid, const PolygonizeOptions& options,
                        const Task& task) {
    if (solid.nodes.size() == 1) return polygonize(SolidField(model, solid), options, task);
    return polygonize(combined_solid(model, solid, task), options, task);
}

TriangleMesh polygonize_combination(const Model& model, const Frame& frame, const PolygonizeOptions& options,
                                    const Task& task) {
    return polygonize(combined_solid(model, frame, task), options, task);
}

}  // namespace pfgeom
