// Combinations of every kind of closed object.
#pragma once

#include "codec/random_model.h"
#include "pfgeom/algebra/algebra.h"
#include "shapes.h"

#include <utility>
#include <vector>

namespace pfgeom::test {

/// A mesh part with the triangles of a ball, outwards; about 2^-6 of its radius from it.
inline Model mesh_ball() {
    const TriangleMesh mesh = shapes::sphere(2, 0.9);
    Model model = ball();
    model.functions.clear();
    MeshPart part;
    part.step_code = -80;
    for (const Vec3& v : mesh.vertices)
        part.positions.push_back({static_cast<std::int32_t>(v.x * 1024),
                                  static_cast<std::int32_t>(v.y * 1024),
                                  static_cast<std::int32_t>(v.z * 1024)});
    part.faces = mesh.faces;
    model.objects[0].shape = std::move(part);
    return model;
}

inline Model tree_model(std::uint64_t seed) {
    Random random(seed);
    Model model = ball();
    model.functions.clear();
    model.objects[0].shape = random_tree(random, 5);
    return model;
}

inline Model hierarchy_model(std::uint64_t seed) {
    Random random(seed);
    Model model = ball();
    model.functions[0] = random_hierarchy(random, 4);
    return model;
}

/// A ball with copies, one of them mirrored, and a hollow in the first.
inline Model hollow_model() {
    Model model = ball();
    Random random(3);
    model.objects[0].instances = {random_similarity(random), random_similarity(random)};
    Object hollow = model.objects[0];
    hollow.frame.scale_code = -8;
    hollow.cavity_of = 0;
    hollow.instances.clear();
    model.objects.push_back(hollow);
    return model;
}

inline std::vector<Model> closed_models() {
    return {ball(), mesh_ball(), tree_model(1), tree_model(2), hierarchy_model(3), hollow_model()};
}

/// Random turn, size, place, and now and then a shear.
inline Affine random_affine(Random& random, double far = 0.6) {
    Similarity s = random_similarity(random);
    s.scale = between(random, 0.6, 1.4);
    s.translation = {between(random, -far, far), between(random, -far, far), between(random, -far, far)};
    Affine map = affine_of(s);
    if (below(random, 3) == 0) map.rows[0] += map.rows[1] * 0.4;
    return map;
}

/// (a | T b) - T' (a & T'' c) of random kinds.
inline Model random_combination(std::uint64_t seed) {
    Random random(seed);
    const std::vector<Model> kinds = closed_models();
    const auto any = [&] { return kinds[random.below(kinds.size())]; };
    const Model a = any(), b = any(), c = any();
    return (a | transformed(b, random_affine(random))) -
           transformed(a & transformed(c, random_affine(random)), random_affine(random));
}

}  // namespace pfgeom::test
