// The bulges of a patch: from the original surface at first, then by least squares to its samples.
#include "pfgeom/fit/collapse_error.h"
#include "pfgeom/fit/dense_system.h"
#include "pfgeom/fit/spokes.h"

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

// The foot of a bulge is looked for as far as this share of its chord.
constexpr double kFarthestFoot = 0.3;
// A patch with more unknowns than this is left as it is.
constexpr std::size_t kMostUnknowns = 40;
// What holds the unknowns back, as a share of the mean of their diagonal.
constexpr double kDamping = 0.02;
// Points of an edge that are held on its line, and how much one weighs beside a sample. Without them concave
// borders, which samples do not feel from outside, kept 499 faces of beetle-alt at 1e-3; with them 353.
constexpr int kLinePoints = 6;
constexpr double kLineWeight = 2;
// Weights for the maximum are squared distances, and never less than this share of the tolerance's.
constexpr double kLeastWeight = 0.1;

using Row = std::vector<DenseSystem::Term>;

// Three of the moving vertex, if it is free; then the bulges of the spokes.
class Unknowns {
  public:
    Unknowns(const Spokes& spokes, bool free, int fixed_axis)
        : spokes_(spokes), free_(free), fixed_axis_(fixed_axis), count_(free ? 3 : 0) {
        for (const Spoke& s : spokes.list()) {
            first_.push_back(count_);
            count_ += s.bent ? 2 : 1;
        }
    }
    std::size_t count() const { return count_; }
    // To the row of a point that moves with the vertex, and with a bulge, by these shares.
    void add_vertex(Row& row, double share, const Vec3& direction) const {
        if (!free_) return;
        for (int k = 0; k < 3; ++k) {
            if (k != fixed_axis_) row.push_back({static_cast<std::size_t>(k), share * direction[k]});
        }
    }
    void add_bulge(Row& row, std::size_t spoke, double share, const Vec3& direction) const {
        const Spoke& s = spokes_.list()[spoke];
        row.push_back({first_[spoke], share * dot(direction, s.normal)});
        if (s.bent) row.push_back({first_[spoke] + 1, share * dot(direction, s.sideways)});
    }
    Vec3 bulge(const std::vector<double>& x, std::size_t spoke) const {
        const Spoke& s = spokes_.list()[spoke];
        const Vec3 change = s.normal * x[first_[spoke]];
        return s.bent ? change + s.sideways * x[first_[spoke] + 1] : change;
    }

  private:
    const Spokes& spokes_;
    bool free_;
    int fixed_axis_;
    std::size_t count_;
    std::vector<std::size_t> first_;  // of each spoke
};

}  // namespace

Spokes CollapseError::spokes_of(const Patch& patch) const {
    return lines_ ? lines_->spokes_of(patch, tolerance_) : Spokes(patch);
}

Vec3 CollapseError::whole_steps(const Vec3& bulge, const Spoke& spoke) const {
    if (!grid_) return bulge;
    const auto rounded = [&](const Vec3& axis) {
        return std::floor(dot(bulge, axis) / bulge_step_ + 0.5) * bulge_step_;
    };
    return spoke.normal * rounded(spoke.normal) + spoke.sideways * rounded(spoke.sideways);
}

// From the middle of the chord to the surface along the normal, or to the line that the edge follows.
Vec3 CollapseError::first_bulge(const Vec3& middle, const Spoke& s) const {
    const double within = kFarthestFoot * norm(s.along);
    if (s.line != nullptr) {
        const ClosestPoint found = s.line->closest(middle, within);
        if (found.face >= 0) {
            const Vec3 apart = found.point - middle;
            return s.normal * dot(apart, s.normal) + s.sideways * dot(apart, s.sideways);
        }
    }
    double height = 0;
    for (int step = 0; step < 2; ++step) {
        const Vec3 p = middle + s.normal * height;
        const ClosestPoint found = bvh_.closest(p, within);
        if (found.face < 0) break;
        height += dot(found.point - p, s.normal);
    }
    return s.normal * height;
}

void CollapseError::bend(Patch& patch) const {
    const Spokes spokes = spokes_of(patch);
    for (std::size_t i = 0; i < spokes.list().size(); ++i) {
        const Spoke& s = spokes.list()[i];
        const Vec3 middle = patch.triangles[0][0] + s.along * 0.5;
        spokes.set(patch, i, whole_steps(first_bulge(middle, s), s));
    }
}

// Minimises Σ w (d - e·δ)²: d is a sample's distance, e its direction, δ how its foot point moves: λ0 times
// the vertex, 4 λ0 λk times the bulges of the spokes. Weights as in fitted(). Then the same of points on the
// edges that follow a line, across them.
void CollapseError::refit(Patch& patch, bool free) const {
    const Spokes spokes = spokes_of(patch);
    const Unknowns unknowns(spokes, free, patch.fixed_axis);
    if (unknowns.count() > kMostUnknowns) return;
    DenseSystem system(unknowns.count());
    Row row;
    const double least = kLeastWeight * tolerance_ * tolerance_;
    visit_samples(patch, [&](const FaceSample& sample, const auto& found) {
        const Vec3& w = found.weights;
        const double d = std::sqrt(found.squared);
        Vec3 direction = sample.p - found.point;
        if (d > 1e-9 * spacing_) {
            direction = direction / d;
        } else {
            const auto t = patch.surface(found.row).tangent(w);
            direction = normalized(cross(t[1] - t[0], t[2] - t[0]));
        }
        row.clear();
        unknowns.add_vertex(row, w.x, direction);
        const auto& ends = spokes.of_row(found.row);
        unknowns.add_bulge(row, ends[0], 4 * w.x * w.y, direction);
        unknowns.add_bulge(row, ends[1], 4 * w.x * w.z, direction);
        system.add(row, d, metric_ == Metric::max ? found.squared + least : sample.weight);
    });
    const double mean = samples_.mean_weight();
    for (std::size_t i = 0; i < spokes.list().size(); ++i) {
        const Spoke& s = spokes.list()[i];
        if (s.line == nullptr) continue;
        const Vec3 bulge = spokes.bulge(patch, i);
        for (int k = 0; k < kLinePoints; ++k) {
            const double t = static_cast<double>(k) / kLinePoints, share = 4 * t * (1 - t);
            const Vec3 p = patch.triangles[0][0] + s.along * t + bulge * share;
            const ClosestPoint found = s.line->closest(p, kFarthestFoot * norm(s.along));
            if (found.face < 0) continue;
            const double weight = metric_ == Metric::max ? found.squared_distance + least : mean;
            for (const Vec3& across : {s.normal, s.sideways}) {
                row.clear();
                unknowns.add_vertex(row, 1 - t, across);
                unknowns.add_bulge(row, i, share, across);
                system.add(row, dot(found.point - p, across), kLineWeight * weight);
            }
        }
    }
    const std::vector<double> x = system.solve(kDamping);
    if (free) patch.move_to(placed(patch.triangles[0][0] + Vec3{x[0], x[1], x[2]}));
    const bool again = free && grid_;  // the bulges make up for what the place was rounded
    for (std::size_t i = 0; i < spokes.list().size(); ++i) {
        const Vec3 bulge = spokes.bulge(patch, i) + unknowns.bulge(x, i);
        spokes.set(patch, i, again ? bulge : whole_steps(bulge, spokes.list()[i]));
    }
    if (again) refit(patch, false);
}

}  // namespace pfgeom
