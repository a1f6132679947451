#include "pfgeom/function/check.h"

#include "pfgeom/base/utf8.h"
#include "pfgeom/function/edges_of_faces.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace pfgeom {
namespace {

// Coefficients and factors below this cannot overflow in F + f max(Q, 0)³ on the cube.
constexpr double kMaxCoefficient = 1e60;
constexpr std::int32_t kMaxMagnitude = 65535;           // of quantised form factors
constexpr std::int32_t kMaxCoordinate = (1 << 27) - 1;  // of mesh parts
constexpr double kMaxScale = 0x1p60;                    // of instances
constexpr double kOrthogonal = 1e-6;                    // slack of their rows

using Flaw = std::string;  // empty: none

std::string row(std::string_view what, std::size_t i) {
    return std::string(what) + " " + std::to_string(i);
}

bool in_range(std::int64_t index, std::size_t n) {
    return index >= 0 && index < static_cast<std::int64_t>(n);
}

bool is_bounded(double x, double limit) {
    return std::abs(x) <= limit;  // false for NaN
}

bool is_bounded(const Quadric& q) {
    return std::all_of(q.c.begin(), q.c.end(), [](double c) { return is_bounded(c, kMaxCoefficient); });
}

Flaw flaw_of(const Level& level) {
    const std::size_t n = level.centres.size();
    if (level.z.size() != n || level.scale.size() != n || level.lattice.size() != n) {
        return "a level's lists differ in length";
    }
    const auto too_large = [](std::int32_t z) { return z < -kMaxMagnitude || z > kMaxMagnitude; };
    if (std::any_of(level.z.begin(), level.z.end(), too_large)) return "a form factor is beyond ±65535 steps";
    return {};
}

Flaw flaw_of(const Function& function) {
    if (!is_bounded(function.base)) return "a coefficient of the base is not finite or too large";
    for (const Perturbation& p : function.perturbations) {
        if (!is_bounded(p.factor, kMaxCoefficient) || !is_bounded(p.quadric)) {
            return "a perturbation is not finite or too large";
        }
    }
    for (const Level& level : function.levels) {
        if (Flaw flaw = flaw_of(level); !flaw.empty()) return flaw;
    }
    return {};
}

Flaw flaw_of(const SetNode& node, std::size_t index, std::size_t functions) {
    using Kind = SetNode::Kind;
    switch (node.kind) {
        case Kind::function:
            return in_range(node.a, functions) ? Flaw{} : "a node's function does not exist";
        case Kind::decide:
            if (!in_range(node.f, functions)) return "a node's function does not exist";
            [[fallthrough]];
        case Kind::unite:
        case Kind::intersect:
            return in_range(node.a, index) && in_range(node.b, index)
                       ? Flaw{}
                       : "a node's child does not stand before it";
        case Kind::complement:
            return in_range(node.a, index) ? Flaw{} : "a node's child does not stand before it";
        case Kind::inside:
        case Kind::outside:
            return {};
    }
    return "a node's kind does not exist";
}

// Whoever follows it is as deep in calls, and as long busy at every point.
Flaw flaw_of(const Solid& solid, const Model& model) {
    if (solid.nodes.empty()) return "its set expression is empty";
    struct Extent {
        std::int32_t depth = 1, length = 1;
    };
    std::vector<Extent> extents(solid.nodes.size());
    for (std::size_t i = 0; i < solid.nodes.size(); ++i) {
        const SetNode& node = solid.nodes[i];
        if (Flaw flaw = flaw_of(node, i, model.functions.size()); !flaw.empty()) return flaw;
        const auto add = [&](std::int32_t child) {
            const Extent& operand = extents[static_cast<std::size_t>(child)];
            extents[i].depth = std::max(extents[i].depth, operand.depth + 1);
            extents[i].length += operand.length;
        };
        if (node.operands() > 0) add(node.a);
        if (node.operands() > 1) add(node.b);
        if (extents[i].depth > Solid::kMostDepth) return "its set expression is more than 512 deep";
        if (extents[i].length > Solid::kMostLength) return "its set expression is longer than 65536";
    }
    return {};
}

Flaw flaw_of(const Sheet& sheet, const Model& model) {
    const std::size_t n = model.functions.size();
    if (!in_range(sheet.surface, n)) return "its surface does not exist";
    if (sheet.cut.nodes.empty()) return in_range(sheet.trim, n) ? Flaw{} : "its trim does not exist";
    return sheet.trim == -1 ? find_flaw(sheet.cut, 2) : "it has two trims";
}

Flaw flaw_of_mirror(const MeshPart& part) {
    if (part.mirror->axis < 0 || part.mirror->axis > 2) return "its mirror has no axis";
    if (!is_bounded(part.mirror->at, 1)) return "its mirror's plane is outside the cube";
    for (const Triangle& f : part.faces) {
        if (part.on_mirror(f[0]) && part.on_mirror(f[1]) && part.on_mirror(f[2]))
            return "a face lies in the plane of its mirror";
    }
    if (!part.curved()) return {};
    const EdgesOfFaces edges = EdgesOfFaces::of(part.faces);
    for (std::size_t i = 0; i < edges.ends.size(); ++i) {
        if (part.is_seam(edges.ends[i]) && part.bulges[i].sideways != 0)
            return "a bulge leaves the plane of its mirror";
    }
    return {};
}

Flaw flaw_of(const MeshPart& part, const Model&) {
    for (const auto& p : part.positions) {
        const auto outside = [](std::int32_t c) { return c < -kMaxCoordinate || c > kMaxCoordinate; };
        if (std::any_of(p.begin(), p.end(), outside)) return "a vertex is beyond 2^27 steps";
    }
    for (const Triangle& f : part.faces) {
        const auto missing = [&part](std::int32_t v) { return !in_range(v, part.positions.size()); };
        if (std::any_of(f.begin(), f.end(), missing)) return "a face has a corner that does not exist";
        if (f[0] == f[1] || f[1] == f[2] || f[2] == f[0]) return "a face has the same corner twice";
    }
    if (!part.curved()) return part.mirror ? flaw_of_mirror(part) : Flaw{};
    if (part.bulges.size() != EdgesOfFaces::of(part.faces).ends.size()) return "not every edge has one bulge";
    const auto too_large = [](const Bulge& b) {
        return std::abs(b.normal) > kMaxCoordinate || std::abs(b.sideways) > kMaxCoordinate;
    };
    if (std::any_of(part.bulges.begin(), part.bulges.end(), too_large)) return "a bulge is beyond 2^27 steps";
    return part.mirror ? flaw_of_mirror(part) : Flaw{};
}

Flaw flaw_of(const SetTree& tree, const Model&) {
    return find_flaw(tree);
}

Flaw flaw_of(const Frame& frame) {
    if (frame.scale_code < Frame::kMinScale || frame.scale_code > Frame::kMaxScale) {
        return "its frame's scale is out of range";
    }
    const auto outside = [](std::int64_t o) { return o < -Frame::kMaxOffset || o > Frame::kMaxOffset; };
    if (std::any_of(frame.offset.begin(), frame.offset.end(), outside))
        return "its frame's offset is out of range";
    return {};
}

Flaw flaw_of(const Similarity& similarity) {
    if (!(similarity.scale >= 1 / kMaxScale && similarity.scale <= kMaxScale)) {
        return "an instance's scale is out of range";
    }
    if (!is_finite(similarity.translation)) return "an instance's translation is not finite";
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            const double expected = i == j ? 1 : 0;
            if (!is_bounded(dot(similarity.rows[i], similarity.rows[j]) - expected, kOrthogonal)) {
                return "an instance's rows are not orthogonal unit vectors";
            }
        }
    }
    return {};
}

Flaw flaw_of(const Object& object, const Model& model) {
    if (Flaw flaw = flaw_of(object.frame); !flaw.empty()) return flaw;
    if (Flaw flaw = std::visit([&model](const auto& shape) { return flaw_of(shape, model); }, object.shape);
        !flaw.empty()) {
        return flaw;
    }
    if (object.cavity_of != -1 && !in_range(object.cavity_of, model.objects.size())) {
        return "the object that it is a cavity of does not exist";
    }
    for (const Similarity& similarity : object.instances) {
        if (Flaw flaw = flaw_of(similarity); !flaw.empty()) return flaw;
    }
    if (!object.placements.empty() && !object.instances.empty())
        return "it has placements and instances as well";
    return find_flaw(object.placements);
}

// Walks from each object outwards until an object of an earlier walk; meeting one of its own is a cycle.
bool nesting_has_cycle(const std::vector<Object>& objects) {
    std::vector<std::size_t> walk_of(objects.size(), 0);
    for (std::size_t start = 0; start < objects.size(); ++start) {
        std::size_t at = start;
        while (walk_of[at] == 0) {
            walk_of[at] = start + 1;
            if (objects[at].cavity_of < 0) break;
            at = static_cast<std::size_t>(objects[at].cavity_of);
            if (walk_of[at] == start + 1) return true;
        }
    }
    return false;
}

Flaw flaw_of_names(const Model& model, const Limits& limits) {
    const std::size_t n = model.names.size();
    if (n > 1 && n != model.objects.size()) return "there are neither one nor as many names as objects";
    for (std::size_t i = 0; i < n; ++i) {
        if (model.names[i].size() > limits.string_bytes) return row("name", i) + ": too long";
        if (!is_utf8(model.names[i])) return row("name", i) + ": not UTF-8";
    }
    return {};
}

Flaw flaw_of_world_transform(const std::vector<double>& matrix) {
    if (matrix.empty()) return {};
    if (matrix.size() != 16) return "the world transform has not 16 values";
    if (!std::all_of(matrix.begin(), matrix.end(), [](double v) { return std::isfinite(v); })) {
        return "the world transform is not finite";
    }
    const bool affine = matrix[12] == 0 && matrix[13] == 0 && matrix[14] == 0 && matrix[15] == 1;
    return affine ? Flaw{} : "the last row of the world transform is not 0 0 0 1";
}

}  // namespace

std::string find_flaw(const Promise& promise, double diagonal) {
    const auto is_length = [](double x) { return x >= 0 && x <= 0x1p127; };
    if (!(diagonal >= 0x1p-127 && diagonal <= 0x1p127)) return "the diagonal is not between 2^-127 and 2^127";
    if (!is_length(promise.tolerance)) return "the tolerance is not a length";
    if (!is_length(promise.bound_mesh) || !is_length(promise.rms)) return "bound_mesh or rms is not a length";
    if (!is_length(promise.bound_functions)) return "bound_functions is not a length";
    if (promise.functions_certified && promise.bound_functions == 0) return "an unknown bound is certified";
    return {};
}

std::string find_flaw(const Model& model, const Limits& limits) {
    if (Flaw flaw = find_flaw(model.promise, model.diagonal); !flaw.empty()) return flaw;
    if (model.objects.empty()) return "the model has no objects";
    for (std::size_t i = 0; i < model.functions.size(); ++i) {
        if (Flaw flaw = flaw_of(model.functions[i]); !flaw.empty()) return row("function", i) + ": " + flaw;
    }
    for (std::size_t i = 0; i < model.objects.size(); ++i) {
        if (Flaw flaw = flaw_of(model.objects[i], model); !flaw.empty())
            return row("object", i) + ": " + flaw;
    }
    if (nesting_has_cycle(model.objects)) return "cavities are nested in a circle";
    if (Flaw flaw = find_combination_flaw(model); !flaw.empty()) return flaw;
    const auto negative = [](std::int32_t label) { return label < 0; };
    if (std::any_of(model.face_groups.begin(), model.face_groups.end(), negative))
        return "a face group is negative";
    if (Flaw flaw = flaw_of_names(model, limits); !flaw.empty()) return flaw;
    if (Flaw flaw = find_flaw_of_materials(model, limits); !flaw.empty()) return flaw;
    return flaw_of_world_transform(model.world_transform);
}

}  // namespace pfgeom
