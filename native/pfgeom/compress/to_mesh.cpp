#include "pfgeom/base/error.h"
#include "pfgeom/base/limits.h"
#include "pfgeom/compress/compress.h"
#include "pfgeom/compress/mesh_code.h"
#include "pfgeom/eval/mesh_part.h"
#include "pfgeom/eval/model_field.h"
#include "pfgeom/eval/solid_field.h"
#include "pfgeom/polygonize/polygonize.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace pfgeom {
namespace {

constexpr int kLeastDepth = 3, kMostDepth = 10;
constexpr int kMostDepthOfAll = 16;  // of a combination: of objects of very different sizes
constexpr int kLeastResolution = 8, kMostResolution = 4096;

void check_options(const MeshOptions& options) {
    if (options.tolerance && options.resolution) {
        throw InvalidInput("give either a tolerance or a resolution, not both");
    }
    if (options.tolerance && !(*options.tolerance > 0 && std::isfinite(*options.tolerance))) {
        throw InvalidInput("the tolerance must be a positive number");
    }
    if (options.resolution &&
        (*options.resolution < kLeastResolution || *options.resolution > kMostResolution)) {
        throw InvalidInput("the resolution must be from 8 to 4096");
    }
}

// Depth at which cells of a cube of half edge `half` are no larger than `size`.
int depth_for(double half, double size) {
    int depth = kLeastDepth;
    while (depth < 12 && std::ldexp(2 * half, -depth) > size) ++depth;
    return depth;
}

double largest_scale(const Object& object) {
    double largest = 0;
    for (const Similarity& s : copies_of(object)) largest = std::max(largest, s.scale);
    return largest;
}

// Objects that are one shape, where they lie without the operand's place, and what is asked of their mesh.
struct Objects {
    std::span<const Object> list;
    double diagonal = 0;
    MeshOptions options;

    double largest_half() const {
        double largest = 0;
        for (const Object& o : list) largest = std::max(largest, o.frame.half() * largest_scale(o));
        return largest;
    }
    // What the pattern may miss so that none of its copies misses more.
    double chord_for(const Object& object) const {
        return options.tolerance ? *options.tolerance / largest_scale(object) : chord_of(object, diagonal);
    }
    // The longest cell or edge of the pattern.
    double cell_for(const Object& object) const {
        return 2 * largest_half() / *options.resolution / largest_scale(object);
    }
};

PolygonizeOptions polygonize_options(const Objects& all, const Object& object) {
    PolygonizeOptions result;
    result.min_depth = kLeastDepth;
    result.max_depth = kMostDepth;
    const double half = object.frame.half();
    if (all.options.resolution) {
        result.min_depth = result.max_depth = depth_for(half, all.cell_for(object));
    } else {
        result.tolerance = all.chord_for(object) / half;
    }
    return result;
}

Fineness fineness_of(const Objects& all, const Object& object) {
    if (!all.options.resolution) return {.chord = all.chord_for(object)};
    return {.chord = chord_of(object, all.diagonal), .length = all.cell_for(object)};
}

void turn_faces(TriangleMesh& mesh) {
    for (Triangle& t : mesh.faces) std::swap(t[1], t[2]);
}

TriangleMesh mesh_of_sheet(const Model& model, const Sheet& sheet, const PolygonizeOptions& options,
                           const Task& task) {
    const Function& surface = model.functions[static_cast<std::size_t>(sheet.surface)];
    const Function& trim = model.functions[static_cast<std::size_t>(sheet.trim)];
    if (!surface.is_quadric() || !trim.is_quadric())
        throw InvalidInput("sheets of functions with perturbations cannot be polygonized yet");
    return polygonize_sheet(surface.base, trim.base, options, task);
}

// A complement fills the cube; its surface is that of its operand, with the faces turned.
TriangleMesh mesh_in_place(const Model& model, const Objects& all, const Object& object, const Task& task) {
    if (std::holds_alternative<MeshPart>(object.shape)) return mesh_of(object, fineness_of(all, object));
    const PolygonizeOptions how = polygonize_options(all, object);
    TriangleMesh mesh;
    bool complement = false;
    if (const auto* solid = std::get_if<Solid>(&object.shape)) {
        complement = !solid->nodes.empty() && solid->nodes.back().kind == SetNode::Kind::complement;
        Solid shape = *solid;
        if (complement) shape.nodes.pop_back();
        mesh = polygonize(SolidField(model, shape), how, task);
    } else if (const auto* tree = std::get_if<SetTree>(&object.shape)) {
        complement = tree->complement;
        mesh = polygonize(*tree, how, task);
    } else {
        mesh = mesh_of_sheet(model, std::get<Sheet>(object.shape), how, task);
    }
    for (Vec3& v : mesh.vertices) v = object.frame.to_world(v);
    if (complement || object.cavity_of >= 0) turn_faces(mesh);
    return mesh;
}

TriangleMesh copy_of(const TriangleMesh& mesh, const Similarity& s) {
    TriangleMesh copy = mesh;
    for (Vec3& v : copy.vertices) v = s.apply(v);
    if (dot(s.rows[0], cross(s.rows[1], s.rows[2])) < 0) turn_faces(copy);
    return copy;
}

// A few bytes can name many copies of a large mesh.
void append_copies(const TriangleMesh& mesh, const Object& object, TriangleMesh& all, const Task& task) {
    const std::vector<Similarity> copies = copies_of(object);
    if (mesh.faces.size() > (Limits{}.polygon_faces - all.faces.size()) / copies.size())
        throw LimitExceeded("the copies of the objects have more than 20 million faces");
    for (const Similarity& s : copies) {
        task.check();
        append(copy_of(mesh, s), all);
    }
}

TriangleMesh mesh_of_objects(const Model& model, const Objects& all, const Task& task) {
    TriangleMesh mesh;
    const auto count = static_cast<double>(all.list.size());
    for (std::size_t i = 0; i < all.list.size(); ++i) {
        const auto at = static_cast<double>(i);
        const Task part = part_of(task, at / count, (at + 1) / count);
        part.report(0, "polygonize");
        append_copies(mesh_in_place(model, all, all.list[i], part), all.list[i], mesh, part);
    }
    return mesh;
}

// An operand alone, where its transforms put it.
TriangleMesh mesh_of_operand(const Model& model, const CombinationNode& operand, MeshOptions options,
                             const Task& task) {
    if (operand.moved && options.tolerance) *options.tolerance /= most_stretch(operand.place);
    const std::span<const Object> list(model.objects);
    const auto first = static_cast<std::size_t>(operand.first), last = static_cast<std::size_t>(operand.last);
    TriangleMesh mesh =
        mesh_of_objects(model, {list.subspan(first, last - first), operand.diagonal, options}, task);
    if (!operand.moved) return mesh;
    for (Vec3& v : mesh.vertices) v = operand.place.apply(v);
    if (operand.place.mirrors()) turn_faces(mesh);
    return mesh;
}

// Of all copies of all objects of all operands.
struct Extremes {
    double chord = std::numeric_limits<double>::infinity(), half = chord;
};

Extremes extremes_of(const Model& model, const std::vector<CombinationNode>& tree) {
    Extremes least;
    for (const CombinationNode& node : tree) {
        const double stretch = node.moved ? most_stretch(node.place) : 1;
        for (std::int32_t i = node.first; i < node.last; ++i) {
            const Object& object = model.objects[static_cast<std::size_t>(i)];
            const double scale = stretch * largest_scale(object);
            least.chord = std::min(least.chord, chord_of(object, node.diagonal) * scale);
            least.half = std::min(least.half, object.frame.half() * scale);
        }
    }
    return least;
}

// One cube for all. Without a tolerance the finest of the objects' chords serves; cells may be as fine as
// each object's own would be.
TriangleMesh mesh_of_combination(const Model& model, const std::vector<CombinationNode>& tree,
                                 const MeshOptions& options, const Task& task) {
    const Box box = ModelField(model).bounds();
    const Vec3 extent = box.hi - box.lo;
    if (!(extent.x > 0 && extent.y > 0 && extent.z > 0)) return {};
    const Frame frame = Frame::around(box);
    const Extremes least = extremes_of(model, tree);
    PolygonizeOptions how;
    how.min_depth = kLeastDepth;
    how.max_depth =
        std::min(kMostDepth + depth_for(frame.half(), 2 * least.half) - kLeastDepth, kMostDepthOfAll);
    how.tolerance = (options.tolerance ? *options.tolerance : least.chord) / frame.half();
    if (options.resolution) {
        const double cell = std::max({extent.x, extent.y, extent.z}) / *options.resolution;
        how.min_depth = how.max_depth = depth_for(frame.half(), cell);
    }
    TriangleMesh mesh = polygonize_combination(model, frame, how, task);
    for (Vec3& v : mesh.vertices) v = frame.to_world(v);
    return mesh;
}

// Different sets of coefficients.
std::int64_t distinct_quadrics(const SetTree& tree) {
    std::vector<std::array<double, 10>> coefficients;
    for (const TreeQuadric& q : tree.quadrics) coefficients.push_back(q.quadric.c);
    std::sort(coefficients.begin(), coefficients.end());
    return std::unique(coefficients.begin(), coefficients.end()) - coefficients.begin();
}

}  // namespace

TriangleMesh to_mesh(const Model& model, const MeshOptions& options, const Task& task) {
    check_options(options);
    const std::vector<CombinationNode> tree = combination_tree(model);
    TriangleMesh mesh = tree.back().is_operand() ? mesh_of_operand(model, tree.back(), options, task)
                                                 : mesh_of_combination(model, tree, options, task);
    task.report(1, "polygonize");
    return mesh;
}

FunctionCount count_functions(const Model& model) {
    FunctionCount count;
    std::vector<std::uint8_t> surface(model.functions.size()), used(model.functions.size());
    for (const Object& object : model.objects) {
        if (const auto* part = std::get_if<MeshPart>(&object.shape)) {
            (part->curved() ? count.patches : count.mesh_part_faces) +=
                static_cast<std::int64_t>(part->faces.size());
        } else if (const auto* sheet = std::get_if<Sheet>(&object.shape)) {
            surface[static_cast<std::size_t>(sheet->surface)] = used[static_cast<std::size_t>(sheet->trim)] =
                1;
        } else if (const auto* tree = std::get_if<SetTree>(&object.shape)) {
            count.surface += distinct_quadrics(*tree);
        } else if (const auto* solid = std::get_if<Solid>(&object.shape)) {
            for (const SetNode& node : solid->nodes) {
                if (node.kind == SetNode::Kind::function) surface[static_cast<std::size_t>(node.a)] = 1;
                if (node.kind == SetNode::Kind::decide) used[static_cast<std::size_t>(node.f)] = 1;
            }
        }
    }
    for (std::size_t i = 0; i < surface.size(); ++i) {
        count.surface += surface[i];
        count.separators += surface[i] == 0 && used[i] != 0 ? 1 : 0;
        count.perturbations += static_cast<std::int64_t>(model.functions[i].perturbations.size());
        for (const Level& level : model.functions[i].levels) {
            count.perturbations +=
                std::count_if(level.z.begin(), level.z.end(), [](std::int32_t z) { return z != 0; });
        }
    }
    return count;
}

}  // namespace pfgeom
