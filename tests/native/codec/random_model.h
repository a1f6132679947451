// Seeded models that use every feature of the format.
#pragma once

#include "pfgeom/base/random.h"
#include "pfgeom/eval/derive.h"
#include "pfgeom/function/edges_of_faces.h"
#include "pfgeom/function/model.h"
#include "random_tree.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace pfgeom::test {

inline std::int32_t below(Random& random, int n) {
    return static_cast<std::int32_t>(random.below(static_cast<std::uint64_t>(n)));
}
inline double between(Random& random, double lo, double hi) {
    return lo + (hi - lo) * random.uniform();
}

/// x² / a² + ... = 1 with small integer coefficients, or arbitrary doubles.
inline Quadric random_quadric(Random& random) {
    Quadric q;
    const bool round = below(random, 2) == 0;
    for (double& c : q.c) c = round ? below(random, 200) - 100 : between(random, -3, 3);
    if (below(random, 3) == 0) q.c[3] = q.c[4] = q.c[5] = 0;
    return q;
}

inline Function random_function(Random& random) {
    Function function;
    function.base = random_quadric(random);
    function.perturbations.resize(random.below(4));
    for (Perturbation& p : function.perturbations) p = {between(random, -1, 1), random_quadric(random)};
    return function;
}

/// A bumpy ellipsoid: random form factors, most of them zero, at the places that decoding derives.
inline Function random_hierarchy(Random& random, int last_level) {
    Function function;
    for (auto& a : function.head.axes) a = static_cast<std::uint8_t>(120 + below(random, 100));
    function.head.step_code = static_cast<std::uint8_t>(60 + below(random, 20));
    function.base = base_of(function.head);
    FunctionField field(function.base);
    DeriveBudget unlimited;
    for (int depth = kFirstLevel; depth <= last_level; ++depth) {
        Level level = empty_level(function.head, depth);
        std::vector<ProbedCell> cells;
        if (depth >= function.head.first_sheet && below(random, 2) == 0) {
            cells = thin_candidates(field, depth, unlimited, {});
            for (std::size_t i = 0; i < cells.size(); ++i)
                level.thin.push_back(below(random, 20) == 0 ? 1 : 0);
        }
        place_centres(field, function.head, cells, level, unlimited, {});
        for (std::size_t i = 0; i < level.centres.size(); ++i) {
            level.z.push_back(below(random, 4) == 0 ? below(random, 7) - 3 : 0);
        }
        field.add(level);
        function.levels.push_back(level);
    }
    return function;
}

inline Frame random_frame(Random& random) {
    Frame frame;
    frame.scale_code = below(random, 100) - 50;
    for (auto& o : frame.offset) o = below(random, 2000) - 1000;
    return frame;
}

/// A triangle soup on a small grid: shared, repeated and reversed faces, several components.
inline MeshPart random_mesh_part(Random& random) {
    MeshPart part;
    part.step_code = -below(random, 80);
    part.positions.resize(4 + random.below(12));
    for (auto& p : part.positions)
        p = {below(random, 100) - 50, below(random, 100) - 50, below(random, 100) - 50};
    const int n = static_cast<int>(part.positions.size());
    for (int i = 1 + below(random, 30); i > 0; --i) {
        const std::int32_t a = below(random, n), b = (a + 1 + below(random, n - 1)) % n;
        const std::int32_t c = below(random, n);
        if (c != a && c != b) part.faces.push_back({a, b, c});
    }
    if (part.faces.empty()) part.faces.push_back({0, 1, 2});
    return part;
}

/// The part with a bulge on each edge: most are small, a few as large as they may be.
inline MeshPart with_random_bulges(MeshPart part, Random& random) {
    part.bulge_code = part.step_code - below(random, 10);
    part.bulges.resize(EdgesOfFaces::of(part.faces).ends.size());
    for (Bulge& b : part.bulges) {
        const int most = below(random, 50) == 0 ? (1 << 27) - 1 : 1 + below(random, 6);
        const auto any = [&] { return below(random, 2 * most + 1) - most; };
        b = {any(), below(random, 3) == 0 ? any() : 0};
    }
    const std::vector<std::array<std::int32_t, 2>> ends = EdgesOfFaces::of(part.faces).ends;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        if (part.is_seam(ends[i])) part.bulges[i].sideways = 0;
    }
    return part;
}

/// The flat part as half of a mirrored one: every third vertex is on the plane, in any order.
inline MeshPart with_mirror(MeshPart part, Random& random) {
    const std::int32_t axis = below(random, 3);
    part.mirror = MirrorPlane{axis, (below(random, 257) - 128) / 128.0};
    for (std::size_t i = 0; i < part.positions.size(); ++i) {
        std::int32_t& height = part.positions[i][static_cast<std::size_t>(axis)];
        height = i > 0 && below(random, 3) == 0 ? 0 : std::abs(height) + 1;
    }
    std::erase_if(part.faces, [&](const Triangle& t) {
        return part.on_mirror(t[0]) && part.on_mirror(t[1]) && part.on_mirror(t[2]);
    });
    if (part.faces.empty()) part.faces.push_back({0, 1, 2});
    return part;
}

inline Solid random_solid(Random& random, int functions) {
    using Kind = SetNode::Kind;
    Solid solid;
    for (std::int32_t i = 0, n = 1 + below(random, 6); i < n; ++i) {
        SetNode node;
        node.kind = i == 0 ? Kind::function : static_cast<Kind>(below(random, 7));
        if (node.kind == Kind::function) node.a = below(random, functions);
        if (node.kind == Kind::complement) node.a = below(random, i);
        if (node.kind == Kind::unite || node.kind == Kind::intersect || node.kind == Kind::decide) {
            node.a = below(random, i);
            node.b = below(random, i);
        }
        if (node.kind == Kind::decide) node.f = below(random, functions);
        solid.nodes.push_back(node);
    }
    return solid;
}

/// A rotation about z, mirrored half of the time.
inline Similarity random_similarity(Random& random) {
    Similarity s;
    const double t = between(random, -1, 1), c = (1 - t * t) / (1 + t * t), w = 2 * t / (1 + t * t);
    s.rows = {Vec3{c, -w, 0}, Vec3{w, c, 0}, Vec3{0, 0, below(random, 2) == 0 ? 1.0 : -1.0}};
    s.scale = between(random, 0.1, 10);
    s.translation = {between(random, -9, 9), between(random, -9, 9), between(random, -9, 9)};
    return s;
}

inline Promise random_promise(Random& random, double diagonal) {
    Promise promise;
    promise.metric = below(random, 2) == 0 ? Metric::max : Metric::rms;
    const int form = below(random, 3);
    promise.tolerance = form == 0   ? 5e-4 * diagonal
                        : form == 1 ? 0.25
                                    : between(random, 1e-5, 1e-2) * diagonal;
    promise.bound_mesh = promise.tolerance * random.uniform();
    promise.rms = promise.bound_mesh * random.uniform();
    promise.certified = below(random, 2) == 0;
    if (below(random, 2) == 0) {
        promise.bound_functions = promise.tolerance * between(random, 0.5, 1);
        promise.functions_certified = below(random, 2) == 0;
    }
    return promise;
}

inline Object random_object(Random& random, int index, int functions) {
    Object object;
    object.frame = random_frame(random);
    const int shape = below(random, 4);
    if (shape == 0) object.shape = random_solid(random, functions);
    if (shape == 1) object.shape = Sheet{below(random, functions), below(random, functions), {}};
    if (shape == 2) object.shape = random_mesh_part(random);
    if (shape == 3) object.shape = random_tree(random, 5);
    if (index > 0 && below(random, 3) == 0) object.cavity_of = below(random, index);
    object.instances.resize(random.below(3));
    for (Similarity& s : object.instances) s = random_similarity(random);
    object.mesh_code = static_cast<std::uint8_t>(random.below(256));
    return object;
}

inline Model random_model(std::uint64_t seed) {
    Random random(seed);
    Model model;
    model.diagonal = between(random, 0.01, 100);
    model.promise = random_promise(random, model.diagonal);
    const int functions = 1 + below(random, 3), objects = 1 + below(random, 5);
    for (int i = 0; i < functions; ++i) model.functions.push_back(random_function(random));
    if (below(random, 8) == 0) model.functions.push_back(random_hierarchy(random, 3 + below(random, 3)));
    for (int i = 0; i < objects; ++i) {
        model.objects.push_back(random_object(random, i, static_cast<int>(model.functions.size())));
    }
    if (below(random, 2) == 0) model.names.assign(model.objects.size(), "Würfel");
    if (below(random, 2) == 0) {
        for (int i = 0; i < 12; ++i) model.world_transform.push_back(between(random, -2, 2));
        model.world_transform.insert(model.world_transform.end(), {0, 0, 0, 1});
    }
    if (below(random, 2) == 0) {
        for (int i = below(random, 6); i >= 0; --i)
            model.face_groups.insert(model.face_groups.end(), 1 + random.below(500), i % 3);
    }
    return model;
}

/// Copies of an object in normal form; some of them turned alike.
inline Placements random_placements(Random& random, int n) {
    Placements p;
    p.turn_steps = 1 + below(random, 300);
    p.scale_steps = below(random, 2) == 0 ? 1 : 1 + below(random, 100);
    p.step_code = below(random, 100) - 50;
    for (auto& o : p.origin) o = below(random, 2000) - 1000;
    p.list.resize(static_cast<std::size_t>(n));
    for (std::size_t i = 0; i < p.list.size(); ++i) {
        Placement& one = p.list[i];
        const auto any = [&] { return below(random, 2 * p.turn_steps - 1) - (p.turn_steps - 1); };
        one.turn = {any(), any(), any(), any()};
        one.turn[static_cast<std::size_t>(below(random, 4))] = p.turn_steps;
        if (i > 0 && below(random, 3) == 0) one.turn = p.list[i - 1].turn;
        one.mirrored = below(random, 3) == 0;
        one.scale = p.scale_steps == 1 ? 1 : 1 + below(random, 200);
        for (auto& at : one.place) at = below(random, 3000);
    }
    normalise(p);
    return p;
}

/// The same model with copies of every object: a file of version 2.
inline Model with_placements(Model model, std::uint64_t seed) {
    Random random(seed);
    for (Object& object : model.objects) {
        object.instances.clear();
        object.placements = random_placements(random, 1 + below(random, 12));
    }
    return model;
}

inline void grow_material_tree(Random& random, const Box& cell, int depth, int materials,
                               MaterialTree& tree) {
    MaterialNode node;
    const std::size_t row = tree.nodes.size();
    tree.nodes.emplace_back();
    if (depth == 0 || below(random, 4) == 0) {
        tree.nodes[row].material = below(random, materials);
        return;
    }
    node.axis = static_cast<std::uint8_t>(below(random, 3));
    node.bits = static_cast<std::uint8_t>(below(random, kMostPlaneBits + 1));
    const int one = 1 << node.bits;
    if (below(random, 2) == 0) {
        for (std::int32_t& tilt : node.tilt)
            tilt = below(random, 3) == 0 ? 0 : below(random, 2 * one + 1) - one;
    }
    const int most = (node.is_cut() ? 1 : 3) * one - 1;
    node.offset = below(random, 2 * most + 1) - most;
    derive(node, cell);
    node.high = static_cast<std::int32_t>(tree.nodes.size());
    grow_material_tree(random, high_cell(node, cell), depth - 1, materials, tree);
    node.low = static_cast<std::int32_t>(tree.nodes.size());
    grow_material_tree(random, low_cell(node, cell), depth - 1, materials, tree);
    tree.nodes[row] = node;
}

/// With random materials: some objects' copies share them, and set trees have them by quadric or not.
inline Model painted(Model model, std::uint64_t seed) {
    Random random(seed);
    const int materials = 1 + below(random, 40);
    for (int m = 0; m < materials; ++m)
        model.materials.names.push_back(m % 5 == 4 ? ""
                                                   : "Stoff \xC3\xBC." + std::to_string(below(random, 1000)));
    for (const Object& object : model.objects) {
        const auto* tree = std::get_if<SetTree>(&object.shape);
        std::vector<Paint> paints(below(random, 2) == 0 ? 1 : copy_count(object));
        for (Paint& paint : paints) {
            paint.by_quadric = tree != nullptr && !tree->quadrics.empty() && below(random, 2) == 0;
            paint.trees.resize(paint.by_quadric ? tree->quadrics.size() : 1);
            for (MaterialTree& t : paint.trees)
                grow_material_tree(random, root_cell(), paint.by_quadric ? 1 : 6, materials, t);
        }
        model.materials.objects.push_back(std::move(paints));
    }
    return model;
}

/// One solid of one ball: the smallest file.
inline Model ball() {
    Model model;
    model.diagonal = 2;
    model.promise = {Metric::max, 2e-3, 1.9e-3, true, 5e-4};
    model.functions.push_back({{{-1, -1, -1, 0, 0, 0, 0, 0, 0, 0.5}}, {}, {}, {}});
    Object object;
    object.shape = Solid{{{SetNode::Kind::function, 0, -1, -1}}};
    model.objects.push_back(object);
    return model;
}

/// The model and one object more, a mirrored mesh part, flat or curved.
inline Model with_mirrored_part(Model model, std::uint64_t seed) {
    Random random(seed);
    Object object;
    object.frame = random_frame(random);
    MeshPart part = with_mirror(random_mesh_part(random), random);
    object.shape = below(random, 2) == 0 ? part : with_random_bulges(part, random);
    model.objects.push_back(std::move(object));
    if (model.names.size() > 1) model.names.emplace_back("M");
    return model;
}

/// The model and one object more, a sheet that a decision tree cuts.
inline Model with_cut_sheet(Model model, std::uint64_t seed) {
    Random random(seed);
    Object object;
    object.frame = random_frame(random);
    Sheet sheet{below(random, static_cast<int>(model.functions.size())), -1, {}};
    grow_material_tree(random, root_cell(), 1 + below(random, 6), 2, sheet.cut);
    object.shape = std::move(sheet);
    model.objects.push_back(std::move(object));
    if (model.names.size() > 1) model.names.emplace_back("S");
    return model;
}

}  // namespace pfgeom::test
