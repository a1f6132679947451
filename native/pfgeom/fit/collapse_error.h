// The true two-sided error of a mesh that changes patch by patch. Samples of the original surface live on the
// face of the current mesh that they were found closest to; a patch takes over the samples of the faces that
// it replaces. The other way, points of the new triangles look for the original surface in its hierarchy of
// boxes. Source: Klein, Liebich, Strasser, "Mesh reduction with error control", 1996. Departures: samples
// instead of facets, both directions, and the moving vertex is fitted to the samples.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/fit/collapse_mesh.h"
#include "pfgeom/fit/face_samples.h"
#include "pfgeom/fit/feature_lines.h"
#include "pfgeom/fit/integer_grid.h"
#include "pfgeom/fit/nearest_face.h"
#include "pfgeom/function/model.h"
#include "pfgeom/mesh/bvh.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace pfgeom {

/// How fast distances are taken to change over a new triangle (1 is safe), the smallest part of it that is
/// looked at, in tolerances, and into how many parts a side is divided at most.
struct Closeness {
    double slope, finest;
    int parts;
};
/// For collapses: what it misses is mended later, in a third of the time.
constexpr Closeness kGlance{0.13, 0.5, 10};
/// For vertices on the grid.
constexpr Closeness kLook{0.5, 0.2, 16};
/// In the end: after kLook igea, armadillo and bunny had points 1.2 to 6 % over a maximum of 1e-3.
constexpr Closeness kScrutiny{1, 0.02, 512};

class CollapseError {
  public:
    /// `tolerance`: errors well below it are not measured out. `spacing`: of the samples on larger faces and
    /// edges.
    CollapseError(const TriangleMesh& original, Metric metric, double tolerance, double spacing,
                  const Task& task);

    /// The mesh that changes begins as a part of the original only, whose faces stand first in it.
    void start_from(const TriangleMesh& part, const Task& task);

    /// What a patch costs: metric max: the largest distance of its samples; rms: the rise of the weighted sum
    /// of their squares. Infinite if it is over `limit` (then it is not measured out).
    double forward(const Patch& patch, double limit) const;
    /// Largest distance of the new triangles from the original surface; infinite if it is over `limit`.
    /// Distances up to `enough` are not told apart, at a small part of the cost: most are far below.
    double backward(const Patch& patch, double limit, double enough) const;
    /// Are they within the limit?
    bool stays_near(const Patch& patch, double limit) const { return backward(patch, limit, limit) <= limit; }
    /// A better place for the moving vertex: one step of least squares from its place now.
    Vec3 fitted(const Patch& patch) const;
    /// Of a curved patch: takes the bulges at the moving vertex from the original surface.
    void bend(Patch& patch) const;
    /// Of a curved patch: one step of least squares of these bulges, and of the vertex if it is `free`.
    void refit(Patch& patch, bool free) const;
    /// From now on bend() and refit() give places on the grid and bulges of whole steps.
    void quantise(const Grid& grid, double bulge_step) {
        grid_ = grid;
        bulge_step_ = bulge_step;
    }
    bool quantised() const { return grid_.has_value(); }
    Vec3 placed(const Vec3& p) const { return grid_ ? grid_->point(grid_->nearest_above(p)) : p; }
    /// Of curved patches: edges along the borders and creases of the original are to follow them.
    void follow_lines(const TriangleMesh& original, const Task& task) { lines_.emplace(original, task); }
    /// How closely backward() looks from now on.
    void look(const Closeness& closeness) { closeness_ = closeness; }
    /// For faces with higher ids than the original's.
    void make_room(const CollapseMesh& mesh) { samples_.make_room(mesh.face_ids()); }
    /// More samples, without a weight.
    void add(const std::vector<MissedPoint>& missed) { samples_.add(missed); }
    /// Hands the samples over.
    void commit(const Patch& patch);

    /// May patches without a face in common be committed side by side? The rms has one sum for all.
    bool independent() const { return metric_ == Metric::max; }

    /// Of the rms: weighted mean of the squared distances of all samples, by the faces they live on.
    double mean_square() const { return sum_ / samples_.total_weight(); }
    double total_weight() const { return samples_.total_weight(); }

  private:
    /// Calls visit(sample, found) for the samples of a face that a patch replaces, until it returns false
    /// (then that is returned). Faces as close as enough() are not measured out.
    template <class Enough, class Visit>
    bool visit_samples(const NearestFace& nearest, std::int32_t f, Enough enough, Visit visit) const {
        std::size_t likely = nearest.row_of(f);
        const std::vector<FaceSample>& samples = samples_.of(f);
        for (auto sample = samples.rbegin(); sample != samples.rend(); ++sample) {
            const NearestFace::Found found = nearest(sample->p, likely, enough());
            likely = found.row;
            if (!visit(*sample, found)) return false;
        }
        return true;
    }
    /// Of all of its faces, each measured out.
    template <class Visit>
    void visit_samples(const Patch& patch, Visit visit) const {
        const NearestFace nearest(patch, tolerance_);
        for (const std::int32_t f : patch.before) {
            visit_samples(nearest, f, measured_out,
                          [&](const FaceSample& sample, const NearestFace::Found& found) {
                              visit(sample, found);
                              return true;
                          });
        }
    }
    static double measured_out() { return -1; }
    template <class Surface>
    double farthest(const std::array<Vec3, 3>& corners, const Surface& surface, double finest, double limit,
                    double enough, std::int32_t hint) const;
    double rims(const Patch& patch, double limit, double enough) const;

    Vec3 first_bulge(const Vec3& middle, const Spoke& spoke) const;
    Spokes spokes_of(const Patch& patch) const;
    Vec3 whole_steps(const Vec3& bulge, const Spoke& spoke) const;

    std::optional<FeatureLines> lines_;
    std::optional<Grid> grid_;
    double bulge_step_ = 0;
    Metric metric_;
    double tolerance_, spacing_;
    Closeness closeness_ = kGlance;
    static constexpr int kCurvedParts = 3;  // times as many: patches are larger (os-plane: by 6 tolerances)
    Bvh bvh_;
    FaceSamples samples_;
    double sum_ = 0;  // of the rms
};

}  // namespace pfgeom
