#include "pfgeom/base/error.h"
#include "pfgeom/base/limits.h"
#include "pfgeom/compress/compress.h"
#include "pfgeom/compress/inside_mesh.h"
#include "pfgeom/compress/object_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace pfgeom {
namespace {

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

// A few bytes can name many copies of a large mesh.
void append_copy(TriangleMesh mesh, const Similarity& place, TriangleMesh& all, const Task& task) {
    if (mesh.faces.size() > Limits{}.polygon_faces - all.faces.size())
        throw LimitExceeded("the copies of the objects have more than 20 million faces");
    task.check();
    TriangleMesh copy = copy_of(std::move(mesh), place);
    task.check();
    if (all.vertices.empty())
        all = std::move(copy);
    else
        append(copy, all);
}

void append_copies(TriangleMesh mesh, const Object& object, TriangleMesh& all, const Task& task) {
    const std::vector<Similarity> copies = copies_of(object);
    for (std::size_t c = 0; c + 1 < copies.size(); ++c) append_copy(mesh, copies[c], all, task);
    append_copy(std::move(mesh), copies.back(), all, task);  // most objects have but one
}

// Every copy with the paint that is its own or that all share.
void append_painted(const TriangleMesh& mesh, const Object& object, const std::vector<Paint>& paints,
                    double snap, PaintedMesh& all, const Task& task) {
    TriangleMesh cut;
    std::vector<std::int32_t> materials;
    const std::vector<Similarity> copies = copies_of(object);
    for (std::size_t c = 0; c < copies.size(); ++c) {
        if (c < paints.size()) {
            cut = mesh;
            materials = paint_mesh(cut, object, paints[c], snap, quiet(task, task.threads));
        }
        append_copy(cut, copies[c], all.mesh, task);
        all.materials.of_face.insert(all.materials.of_face.end(), materials.begin(), materials.end());
    }
}

PaintedMesh mesh_of_objects(const Model& model, const ObjectsToMesh& all, bool painted, const Task& task) {
    PaintedMesh result;
    const auto count = static_cast<double>(all.list.size());
    for (std::size_t i = 0; i < all.list.size(); ++i) {
        const auto at = static_cast<double>(i);
        const Object& object = all.list[i];
        const Task part = part_of(task, at / count, (at + 1) / count);
        part.report(0, "polygonize");
        TriangleMesh mesh = mesh_in_place(model, all, object, part);
        if (painted) {
            append_painted(mesh, object, model.materials.objects[i], border_snap(model), result, part);
        } else {
            append_copies(std::move(mesh), object, result.mesh, part);
        }
    }
    return result;
}

// An operand alone, where its transforms put it: all objects of the model.
PaintedMesh mesh_of_operand(const Model& model, const CombinationNode& operand, MeshOptions options,
                            bool painted, const Task& task) {
    if (operand.moved && options.tolerance) *options.tolerance /= most_stretch(operand.place);
    PaintedMesh result = mesh_of_objects(model, {model.objects, operand.diagonal, options}, painted, task);
    if (!operand.moved) return result;
    for (Vec3& v : result.mesh.vertices) v = operand.place.apply(v);
    if (operand.place.mirrors()) turn_faces(result.mesh);
    return result;
}

// Set operations do not keep materials.
PaintedMesh whole_mesh(const Model& model, MeshOptions options, bool painted, const Task& task) {
    check_options(options);
    if (!model.materials.empty()) options.thin = false;
    const std::vector<CombinationNode> tree = combination_tree(model);
    PaintedMesh all;
    if (tree.back().is_operand())
        all = mesh_of_operand(model, tree.back(), options, painted, task);
    else
        all.mesh = mesh_of_inside(model, options, task);
    if (painted) all.materials.names = model.materials.names;
    task.report(1, "polygonize");
    return all;
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
    return whole_mesh(model, options, false, task).mesh;
}

PaintedMesh to_painted_mesh(const Model& model, const MeshOptions& options, const Task& task) {
    return whole_mesh(model, options, !model.materials.empty(), task);
}

FunctionCount count_functions(const Model& model) {
    FunctionCount count;
    std::vector<std::uint8_t> surface(model.functions.size()), used(model.functions.size());
    for (const Object& object : model.objects) {
        if (const auto* part = std::get_if<MeshPart>(&object.shape)) {
            (part->curved() ? count.patches : count.mesh_part_faces) +=
                static_cast<std::int64_t>(part->faces.size());
        } else if (const auto* sheet = std::get_if<Sheet>(&object.shape)) {
            surface[static_cast<std::size_t>(sheet->surface)] = 1;
            if (sheet->trim >= 0) used[static_cast<std::size_t>(sheet->trim)] = 1;
            count.separators += std::ranges::count_if(sheet->cut.nodes, std::not_fn(&MaterialNode::leaf));
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
