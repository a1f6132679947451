// The bulges of a patch: from the original surface at first, then by least squares to its samples.
#include "pfgeom/fit/collapse_error.h"
#include "pfgeom/fit/dense_system.h"
#include "pfgeom/fit/nearest_face.h"
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

}  // namespace

Vec3 CollapseError::whole_steps(const Vec3& bulge, const Spoke& spoke) const {
    if (!grid_) return bulge;
    const auto rounded = [&](const Vec3& axis) {
        return std::floor(dot(bulge, axis) / bulge_step_ + 0.5) * bulge_step_;
    };
    return spoke.normal * rounded(spoke.normal) + spoke.sideways * rounded(spoke.sideways);
}

void CollapseError::bend(Patch& patch) const {
    const Spokes spokes(patch);
    for (std::size_t i = 0; i < spokes.list().size(); ++i) {
        const Spoke& s = spokes.list()[i];
        const Vec3 middle = patch.triangles[0][0] + s.along * 0.5;
        const double within = kFarthestFoot * norm(s.along);
        double height = 0;
        for (int step = 0; step < 2; ++step) {
            const Vec3 p = middle + s.normal * height;
            const ClosestPoint found = bvh_.closest(p, within);
            if (found.face < 0) break;
            height += dot(found.point - p, s.normal);
        }
        spokes.set(patch, i, whole_steps(s.normal * height, s));
    }
}

// Minimises Σ w (d - e·δ)²: d is a sample's distance, e its direction, δ how its foot point moves: λ0 times
// the vertex, 4 λ0 λk times the bulges of the spokes. Weights as in fitted().
void CollapseError::refit(Patch& patch, bool free) const {
    const Spokes spokes(patch);
    struct Unknowns {
        std::size_t first;
        std::size_t count;
    };
    std::vector<Unknowns> of_spoke;
    std::size_t count = free ? 3 : 0;
    for (const Spoke& s : spokes.list()) {
        of_spoke.push_back({count, s.bent ? std::size_t{2} : std::size_t{1}});
        count += of_spoke.back().count;
    }
    if (count > kMostUnknowns) return;
    DenseSystem system(count);
    const NearestFace nearest(patch);
    std::vector<DenseSystem::Term> row;
    for (const std::int32_t f : patch.before) {
        std::size_t likely = nearest.row_of(f);
        for (std::int32_t s = first_[static_cast<std::size_t>(f)]; s >= 0;
             s = samples_[static_cast<std::size_t>(s)].next) {
            const Sample& sample = samples_[static_cast<std::size_t>(s)];
            const NearestFace::Found found = nearest(sample.p, likely, -1);
            likely = found.row;
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
            if (free) {
                for (std::size_t k = 0; k < 3; ++k) row.push_back({k, w.x * direction[static_cast<int>(k)]});
            }
            for (std::size_t k = 0; k < 2; ++k) {
                const std::size_t i = spokes.of_row(found.row)[k];
                const double lever = 4 * w.x * (k == 0 ? w.y : w.z);
                row.push_back({of_spoke[i].first, lever * dot(direction, spokes.list()[i].normal)});
                if (of_spoke[i].count == 2)
                    row.push_back({of_spoke[i].first + 1, lever * dot(direction, spokes.list()[i].sideways)});
            }
            const double weight =
                metric_ == Metric::max ? found.squared + 0.1 * tolerance_ * tolerance_ : sample.weight;
            system.add(row, d, weight);
        }
    }
    const std::vector<double> x = system.solve(kDamping);
    if (free) patch.move_to(placed(patch.triangles[0][0] + Vec3{x[0], x[1], x[2]}));
    const bool again = free && grid_;  // the bulges make up for what the place was rounded
    for (std::size_t i = 0; i < spokes.list().size(); ++i) {
        const Spoke& s = spokes.list()[i];
        Vec3 change = s.normal * x[of_spoke[i].first];
        if (of_spoke[i].count == 2) change += s.sideways * x[of_spoke[i].first + 1];
        const Vec3 bulge = spokes.bulge(patch, i) + change;
        spokes.set(patch, i, again ? bulge : whole_steps(bulge, s));
    }
    if (again) refit(patch, false);
}

}  // namespace pfgeom
