// What merging or turning an edge of a labelled mesh would do to its error, shape and creases. Normals are
// those of the faces' quadrics, so that a vertex has one for each quadric that it lies on; otherwise as in
// edge_tests.h.
#pragma once

#include "pfgeom/polygonize/label_surface.h"
#include "pfgeom/polygonize/labelled_mesh.h"

namespace pfgeom {

class CreaseTests {
  public:
    CreaseTests(const LabelledMesh& mesh, const LabelSurface& surface) : m_(mesh), surface_(surface) {}

    double squared_length(std::int32_t h) const {
        return squared_norm(at(m_.mesh.to(h)) - at(m_.mesh.from(h)));
    }
    /// Of the arc on the label's quadric between two vertices.
    double height(Label label, std::int32_t a, std::int32_t b) const;
    /// Of the edge: on both its faces' quadrics and, of a crease, of the curve in which they meet.
    double height(std::int32_t h) const;
    /// Merging from(h) into to(h): no arc above the limit, no triangle turned over, creases stay.
    bool may_merge(std::int32_t h, double limit) const;
    /// The same for edges so short that nothing is lost with them: across creases too.
    bool may_drop(std::int32_t h) const;
    bool should_flip(std::int32_t h, double tolerance) const;
    /// Would fewer triangles be turned over, with no arc above the tolerance?
    bool flip_mends(std::int32_t h, double tolerance) const;
    bool merge_mends(std::int32_t h, double tolerance) const;
    /// Does the face show its label's inside, or is it as bad: too flat?
    bool turned_over(std::int32_t face) const {
        const Triangle& t = m_.mesh.faces()[face];
        return turned_over(m_.label[face], at(t[0]), at(t[1]), at(t[2]));
    }
    bool turned_over(Label label, const Vec3& a, const Vec3& b, const Vec3& c) const {
        return !faces_outside(label, a, b, c, kFlat, 0);
    }
    /// Of the faces around from(h), were it at p, but for h's own.
    int others_turned_over(std::int32_t h, const Vec3& p) const;
    /// Of the edge between two vertices with these labels on its sides.
    double height(Label one, Label other, std::int32_t a, std::int32_t b) const;
    /// Do the surfaces around the apex above a crease face the way of that below? At the rim of a thin plate
    /// they do not, and without its rim the plate would lose its volume.
    bool is_step(std::int32_t h) const;
    /// Would the mesh stay a manifold?
    bool may_turn(std::int32_t h) const;
    /// Does the triangle face the outside of the label's quadric at its corners?
    bool faces_outside(Label label, const Vec3& a, const Vec3& b, const Vec3& c, double thinnest,
                       double facing) const;

  private:
    // Triangles with less height over their longest side are as bad as those that are turned over. Folds left
    // on four parts' trees with two chords each: 69 with 1e-3, 46 with 5e-3, 65 with 1e-2, 51 with 2e-2.
    static constexpr double kFlat = 5e-3;

    const Vec3& at(std::int32_t v) const { return m_.mesh.position[v]; }
    bool is_step_along(std::int32_t h) const;  // the same for the surfaces around its ends
    // Does a surface around from(h) face the other way?
    bool opposed(std::int32_t h, const Vec3& normal) const;
    // Of p to the curve in which two quadrics meet; 0 if there is none within reach.
    double distance_to_curve(Label one, Label other, const Vec3& p, double reach) const;
    bool keeps_creases(std::int32_t h) const;
    bool keeps_heights(std::int32_t h, double limit) const;
    bool keeps_faces(std::int32_t h, double thinnest, double facing) const;

    const LabelledMesh& m_;
    const LabelSurface& surface_;
};

}  // namespace pfgeom
