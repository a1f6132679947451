#include "pfgeom/report/function_list.h"

#include "pfgeom/eval/tree_surface.h"
#include "pfgeom/function/moved_box.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>

namespace pfgeom {
namespace {

using Kind = QuadricKind;

bool has_angles(Kind kind) {
    return kind == Kind::circular_cone || kind == Kind::elliptic_cone || kind == Kind::crossing_planes;
}

// Where the functions of an object lie: in the first of its copies. What an operand's transform shears
// becomes other quadrics, in a cube of their own.
struct Place {
    Frame frame;
    Similarity first;
    std::optional<Affine> sheared;  // from the object's cube to this place's
    std::int32_t copies = 1;

    Place(const Object& object, const std::optional<Affine>& operand, std::int32_t uses)
        : frame(object.frame) {
        const std::vector<Similarity> all = copies_of(object);
        copies = uses * static_cast<std::int32_t>(all.size());
        first = all.front();
        if (!operand) return;
        const Affine moved = composed(*operand, affine_of(first));
        if (const std::optional<Similarity> whole = similarity_of(moved)) {
            first = *whole;
            return;
        }
        const Affine to_world = composed(moved, affine_of(frame));
        frame = Frame::around(box_of_image({{-1, -1, -1}, {1, 1, 1}}, to_world));
        first = {};
        sheared = composed(inverse_of(affine_of(frame)), to_world);
    }
    Quadric seen(const Quadric& quadric) const {
        return sheared ? substituted(quadric, inverse_of(*sheared)) : quadric;
    }
    std::vector<Vec3> seen(std::vector<Vec3> points) const {
        if (sheared)
            for (Vec3& p : points) p = sheared->apply(p);
        return points;
    }
    double half() const { return frame.half() * first.scale; }  // of the cube, in the world

    // From the cube to the world.
    QuadricShape in_world(QuadricShape shape) const {
        shape.centre = first.apply(frame.to_world(shape.centre));
        for (Vec3& axis : shape.axes) axis = first.turn(axis);
        if (has_angles(shape.kind)) return shape;  // tangents
        for (double& size : shape.sizes) size *= half();
        return shape;
    }
};

// Does the solid lie on the far side, seen from the centre or the axis? `inside`: is the positive side
// inside?
bool is_hollow(const QuadricShape& shape, const Quadric& quadric, std::span<const Vec3> points, bool inside) {
    const bool around_axis = shape.kind == Kind::circular_cylinder || shape.kind == Kind::circular_cone;
    if (!around_axis && shape.kind != Kind::sphere) return false;
    double outwards = 0;  // towards the positive side
    for (const Vec3& p : points) {
        Vec3 d = p - shape.centre;
        if (around_axis) d = d - dot(d, shape.axes[0]) * shape.axes[0];
        outwards += dot(normalized(quadric.gradient(p)), normalized(d));
    }
    return (outwards > 0) == inside;
}

// Where the quadric is: a sill's ellipsoid, ten times as long as wide, has few points on a grid of the whole
// cube, and a plane through them.
std::vector<Vec3> points_in_cube(const Quadric& quadric) {
    constexpr int kFirst = 48;
    std::vector<Vec3> points = points_on(quadric, {{-1, -1, -1}, {1, 1, 1}}, kFirst);
    if (points.empty()) return points;
    Box box;
    for (const Vec3& p : points) box.grow(p);
    const Vec3 spacing{2.0 / kFirst, 2.0 / kFirst, 2.0 / kFirst};
    return points_on(quadric, {max(box.lo - spacing, {-1, -1, -1}), min(box.hi + spacing, {1, 1, 1})});
}

class FunctionLister {
  public:
    FunctionLister(const Model& model, const Task& task)
        : model_(model), task_(task), row_(model.functions.size(), -1) {}

    std::vector<ListedFunction> run() {
        for (; object_ < static_cast<std::int32_t>(model_.objects.size()); ++object_) {
            const Object& object = model_.objects[static_cast<std::size_t>(object_)];
            if (std::holds_alternative<MeshPart>(object.shape)) continue;
            const Place place = place_of(object);
            if (const auto* tree = std::get_if<SetTree>(&object.shape)) add(*tree, place);
            if (const auto* solid = std::get_if<Solid>(&object.shape)) add(*solid, place);
            if (const auto* sheet = std::get_if<Sheet>(&object.shape)) {
                add(sheet->surface, true, place);
                if (sheet->trim >= 0) add(sheet->trim, false, place);
            }
        }
        return std::move(list_);
    }

  private:
    // As the first of the operands that it belongs to lies.
    Place place_of(const Object& object) const {
        std::optional<Affine> operand;
        std::int32_t uses = 0;
        for (const CombinationNode& node : combination_tree(model_)) {
            if (!node.is_operand() || object_ < node.first || object_ >= node.last) continue;
            if (uses++ == 0 && node.moved) operand = node.place;
        }
        return {object, operand, uses};
    }

    void add(const SetTree& tree, const Place& place) {
        const TreeSurface surface = find_surface(tree, task_);
        const double half = place.half(), tolerance = model_.promise.tolerance / half;
        for (std::size_t q = 0; q < tree.quadrics.size(); ++q) {
            task_.check();
            const QuadricPatch& patch = surface.patches[q];
            const Quadric quadric = place.seen(tree.quadrics[q].quadric);
            const std::vector<Vec3> points = place.seen(patch.points);
            const QuadricShape shape = shape_of(quadric, points, tolerance);
            list_.push_back({.object = object_,
                             .copies = place.copies,
                             .shape = place.in_world(shape),
                             .surface = !points.empty(),
                             .area = place.sheared ? 0 : patch.area * half * half,
                             .hollow = is_hollow(shape, quadric, points, 2 * patch.area_above > patch.area)});
        }
    }

    void add(const Solid& solid, const Place& place) {
        for (const SetNode& node : solid.nodes) {
            if (node.kind == SetNode::Kind::function) add(node.a, true, place);
            if (node.kind == SetNode::Kind::decide) add(node.f, false, place);
        }
    }

    // A function is listed once, as a surface if it is one anywhere.
    void add(std::int32_t index, bool surface, const Place& place) {
        std::int32_t& row = row_[static_cast<std::size_t>(index)];
        if (row < 0) {
            row = static_cast<std::int32_t>(list_.size());
            list_.push_back(listed(model_.functions[static_cast<std::size_t>(index)], place));
            list_.back().surface = surface;
        } else if (surface) {
            list_[static_cast<std::size_t>(row)].surface = true;
        }
    }

    ListedFunction listed(const Function& function, const Place& place) const {
        auto perturbations = static_cast<std::int64_t>(function.perturbations.size());
        for (const Level& level : function.levels)
            perturbations += std::ranges::count_if(level.z, [](std::int32_t z) { return z != 0; });
        const std::vector<Vec3> points = place.seen(points_in_cube(function.base));
        const double tolerance = model_.promise.tolerance / place.half();
        return {.object = object_,
                .copies = place.copies,
                .shape = place.in_world(shape_of(place.seen(function.base), points, tolerance)),
                .perturbations = perturbations};
    }

    const Model& model_;
    const Task& task_;
    std::vector<std::int32_t> row_;  // in the list, of each function
    std::vector<ListedFunction> list_;
    std::int32_t object_ = 0;
};

}  // namespace

std::vector<ListedFunction> list_functions(const Model& model, const Task& task) {
    return FunctionLister(model, task).run();
}

}  // namespace pfgeom
