// The hub: what a compressed shape is. Plain immutable data that knows neither mesh nor bytes: fit makes it,
// codec stores it, eval evaluates it. Words as in docs/DESIGN.md.
#pragma once

#include "pfgeom/base/triangle.h"
#include "pfgeom/function/combination.h"
#include "pfgeom/function/frame.h"
#include "pfgeom/function/material_map.h"
#include "pfgeom/function/placement.h"
#include "pfgeom/function/promise.h"
#include "pfgeom/function/quadric.h"
#include "pfgeom/function/set_tree.h"

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace pfgeom {

/// f · max(Q, 0)³ (paper eq. 4, 5) of any perturbing quadric.
struct Perturbation {
    double factor = 0;
    Quadric quadric;

    friend bool operator==(const Perturbation&, const Perturbation&) = default;
};

/// One level of a hierarchy of perturbations: balls Q = 1 - |x-c|²/r² of one radius. Centres and scales are
/// derived (eval/derive.h) from the levels before and from `thin`; the form factors are
/// reconstruct(z) · step · scale.
struct Level {
    int depth = 0;                   ///< spacing h = 2 / 2^depth
    double radius = 0;               ///< r, in the cube's units
    double step = 0;                 ///< of the quantiser, in the cube's units
    double towards_zero = 0;         ///< how much closer to zero than its integer a form factor is, in steps
    std::vector<std::uint8_t> thin;  ///< coded: a flag for each candidate cell of the level before, or empty
    std::vector<std::int32_t> z;     ///< coded: quantised form factors, one a centre
    std::vector<Vec3> centres;       ///< derived
    std::vector<double> scale;  ///< derived: |∇F| at the centre on the levels before (1 for lattice nodes)
    std::vector<std::uint8_t> lattice;  ///< derived: 1 = lattice node, 0 = centre on the surface

    /// The form factor of an integer, in quantiser steps.
    double reconstruct(std::int32_t q) const {
        return q > 0 ? q - towards_zero : q < 0 ? q + towards_zero : 0.0;
    }
    double factor(std::size_t i) const { return reconstruct(z[i]) * step * scale[i]; }

    friend bool operator==(const Level&, const Level&) = default;
};

/// What the levels are derived from.
struct HierarchyHead {
    std::array<std::uint8_t, 3> axes{};  ///< base ellipsoid: semi-axis (axes + 1) / 256
    std::uint8_t step_code = 0;          ///< step of level 7 = 2^(-step_code / 8)
    std::uint8_t ratio_code = 74;        ///< step of level l = step of level 7 · (ratio_code / 64)^(l - 7)
    std::uint8_t shrink_code = 4;        ///< form factors are shrink_code / 16 steps closer to zero (0 .. 7)
    std::uint8_t first_sheet = 4;  ///< levels 2 .. first_sheet-1 are lattices, then centres on the surface

    friend bool operator==(const HierarchyHead&, const HierarchyHead&) = default;
};

/// F' = base + Σ f_i R_i. Inside is F' >= 0.
struct Function {
    Quadric base;
    std::vector<Perturbation> perturbations;
    HierarchyHead head;  ///< meaningful if there are levels
    std::vector<Level> levels;

    /// Without perturbations.
    bool is_quadric() const { return perturbations.empty() && levels.empty(); }

    friend bool operator==(const Function&, const Function&) = default;
};

/// A set-theoretic expression over functions, in an array: children stand before their parents, the root
/// last.
struct SetNode {
    enum class Kind : std::uint8_t {
        function,    ///< a: index into Model::functions
        unite,       ///< a, b: nodes
        intersect,   ///< a, b: nodes
        complement,  ///< a: node
        decide,      ///< function `f` >= 0 ? node a : node b
        inside,      ///< everything
        outside      ///< nothing
    };
    Kind kind = Kind::outside;
    std::int32_t a = -1, b = -1, f = -1;

    /// How many of a, b are nodes.
    int operands() const {
        const bool two = kind == Kind::unite || kind == Kind::intersect || kind == Kind::decide;
        return two ? 2 : kind == Kind::complement ? 1 : 0;
    }

    friend bool operator==(const SetNode&, const SetNode&) = default;
};

/// A closed region of space.
struct Solid {
    /// So deep it may be, and so long where what is named more than once counts each time.
    static constexpr std::int32_t kMostDepth = 512, kMostLength = 1 << 16;
    std::vector<SetNode> nodes;

    friend bool operator==(const Solid&, const Solid&) = default;
};

/// An open surface: the zero set of one function where another one, the trim, is >= 0; or, of a free form,
/// where a decision tree of planes keeps it (its leaves are kKept and kCut).
struct Sheet {
    static constexpr std::int32_t kKept = 0, kCut = 1;
    std::int32_t surface = -1, trim = -1;
    MaterialTree cut = {};  ///< if there is no trim

    friend bool operator==(const Sheet&, const Sheet&) = default;
};

/// How far the middle of an edge lies from the middle of its chord, in steps along the axes of the edge
/// (eval/edge_axes.h).
struct Bulge {
    std::int32_t normal = 0, sideways = 0;
    friend bool operator==(const Bulge&, const Bulge&) = default;
};

/// A plane across an axis of the cube: where that coordinate is `at`.
struct MirrorPlane {
    std::int32_t axis = 0;
    double at = 0;
    friend bool operator==(const MirrorPlane&, const MirrorPlane&) = default;
};

/// What functions do not take: a coded mesh on an integer grid. Vertex = frame.to_world(local(positions)).
/// Its faces are flat, or quadratic Bézier triangles (function/curved_triangle.h). Of a mirrored part they
/// are one half: their image belongs to it too, and is joined to them along the edges with both ends on the
/// plane.
struct MeshPart {
    int step_code = 0;                                   ///< step = 2^(step_code / 8), in the cube's units
    std::vector<std::array<std::int32_t, 3>> positions;  ///< #V by 3
    std::vector<Triangle> faces;                         ///< #F by 3
    int bulge_code = 0;                                  ///< of the bulges' step, as step_code
    std::vector<Bulge> bulges;  ///< one for each row of EdgesOfFaces::of(faces); empty: all faces are flat
    std::optional<MirrorPlane> mirror = {};  ///< on its axis positions count from the plane

    double step() const { return exp2_eighths(step_code); }
    double bulge_step() const { return exp2_eighths(bulge_code); }
    bool curved() const { return !bulges.empty(); }
    /// In the cube.
    Vec3 local(const std::array<std::int32_t, 3>& p) const {
        Vec3 q = Vec3{1.0 * p[0], 1.0 * p[1], 1.0 * p[2]} * step();
        if (mirror) q[mirror->axis] += mirror->at;
        return q;
    }
    bool on_mirror(std::int32_t vertex) const {
        return mirror &&
               positions[static_cast<std::size_t>(vertex)][static_cast<std::size_t>(mirror->axis)] == 0;
    }
    /// Is the edge one along which the halves are joined?
    bool is_seam(const std::array<std::int32_t, 2>& ends) const {
        return on_mirror(ends[0]) && on_mirror(ends[1]);
    }

    friend bool operator==(const MeshPart&, const MeshPart&) = default;
};

/// What one island or segment of the mesh became.
struct Object {
    Frame frame;  ///< of the functions' cube, or of the mesh part's grid
    std::variant<Solid, Sheet, MeshPart, SetTree> shape;
    /// The object (an earlier one) that this one is taken out of, or -1. Its own solid is the hollow; the
    /// faces of its mesh point inwards. A solid whose root is a complement (or a tree that is one) and that
    /// is no cavity came from an inside-out mesh: its faces point inwards too, but what it encloses counts as
    /// inside.
    std::int32_t cavity_of = -1;
    std::vector<Similarity> instances;  ///< further copies, beside the one that `frame` places
    /// If not empty, the object is a pattern: it lies nowhere but where these put it, and has no `instances`.
    Placements placements;
    std::uint8_t mesh_code = 0;  ///< chord tolerance of the default mesh: diagonal · 2^(-mesh_code / 4)

    friend bool operator==(const Object&, const Object&) = default;
};

struct Model {
    std::vector<Function> functions;
    std::vector<Object> objects;
    Combination combination;  ///< of the objects; empty: their union
    double diagonal = 0;      ///< of the input's bounding box
    Promise promise;
    std::vector<std::string> names;         ///< optional: of the objects, or of the whole
    std::vector<double> world_transform;    ///< optional: 16 values, row-major, the last row 0 0 0 1
    std::vector<std::int32_t> face_groups;  ///< optional: a label >= 0 for each face of the default mesh
    MaterialMap materials;                  ///< optional: of the surface
};

/// Where the object lies: in place (the identity) and its instances, or its placements.
std::vector<Similarity> copies_of(const Object& object);
std::size_t copy_count(const Object& object);  ///< of them

/// An inside-out solid's root is a complement; what it encloses counts as inside all the same.
Solid without_outer_complement(const Solid& solid);

/// The combination as a tree, the root last; of a model without one: all objects as one operand.
std::vector<CombinationNode> combination_tree(const Model& model);

/// The default mesh's chord tolerance, in the units of the object's model, which has this diagonal.
inline double chord_of(const Object& object, double diagonal) {
    return diagonal * exp2_eighths(-2 * int{object.mesh_code});
}

}  // namespace pfgeom
