#include "pfgeom/fit/cuts.h"

#include "pfgeom/fit/quadric.h"
#include "pfgeom/fit/simplest_quadric.h"
#include "pfgeom/mesh/edges.h"
#include "pfgeom/mesh/union_find.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

namespace pfgeom {
namespace {

// Faces hang together where they turn by less than these, one after the other: a cut that meets the free form
// at a flat angle somewhere shows at a finer one. Cosines of 25, 12, 6, 3 and 1.5 degrees.
constexpr double kSmooth[] = {0.9063, 0.9781, 0.9945, 0.9986, 0.99966};
// At least so much of a cut's rim is creases, turns of more than 20 degrees: nothing else pays.
constexpr double kCreased = 0.5, kCrease = 0.94;
// Of the surface: smaller parts are not worth a quadric's bytes.
constexpr double kLeastArea = 2e-3;

class Finder {
  public:
    Finder(const TriangleMesh& mesh, double tolerance, double step)
        : mesh_(mesh), tolerance_(tolerance), step_(step), taken_(mesh.faces.size()) {
        for (const auto& [a, b, c] : mesh.faces) {
            const Vec3 twice =
                cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
            area_.push_back(norm(twice) / 2);
            normal_.push_back(normalized(twice));
            all_ += area_.back();
        }
        EdgeTable(mesh.faces, mesh.vertices.size()).for_each([&](std::span<const EdgeUse> uses) {
            if (uses.size() != 2) return;
            const double length = norm(mesh.vertices[uses[0].hi] - mesh.vertices[uses[0].lo]);
            edges_.push_back({uses[0].face(), uses[1].face(), length});
        });
    }

    std::vector<Cut> run(const Task& task) {
        for (const double smooth : kSmooth) {
            task.check();
            for (std::vector<std::int32_t>& faces : parts(smooth)) {
                task.check();
                std::erase_if(faces, [&](std::int32_t f) { return taken_[f] != kFree; });
                if (faces.empty()) continue;
                if (const std::optional<Quadric> quadric = quadric_of(faces)) take(*quadric, faces);
            }
        }
        std::ranges::stable_sort(
            found_, [&](const Cut& a, const Cut& b) { return area_of(a.faces) > area_of(b.faces); });
        return std::move(found_);
    }

  private:
    struct Edge {
        std::int32_t one, other;  // faces
        double length;
    };

    double cosine(const Edge& e) const { return dot(normal_[e.one], normal_[e.other]); }

    double area_of(std::span<const std::int32_t> faces) const {
        double sum = 0;
        for (const std::int32_t f : faces) sum += area_[f];
        return sum;
    }

    // What is not taken yet, in parts that are large enough and whose rims are creases.
    std::vector<std::vector<std::int32_t>> parts(double smooth) const {
        UnionFind joined(area_.size());
        for (const Edge& e : edges_)
            if (taken_[e.one] == kFree && taken_[e.other] == kFree && cosine(e) > smooth)
                joined.join(e.one, e.other);
        std::vector<double> area(area_.size()), rim(area_.size()), creased(area_.size());
        for (std::size_t f = 0; f < area_.size(); ++f)
            area[joined.find(static_cast<std::int32_t>(f))] += area_[f];
        for (const Edge& e : edges_) {
            const std::int32_t one = joined.find(e.one), other = joined.find(e.other);
            if (one == other) continue;
            for (const std::int32_t part : {one, other}) {
                rim[part] += e.length;
                if (cosine(e) < kCrease) creased[part] += e.length;
            }
        }
        std::vector<std::int32_t> row(area_.size(), -1);
        std::vector<std::vector<std::int32_t>> found;
        for (std::int32_t f = 0; f < static_cast<std::int32_t>(area_.size()); ++f) {
            const std::int32_t part = joined.find(f);
            if (taken_[f] != kFree || area[part] < kLeastArea * all_ || creased[part] <= kCreased * rim[part])
                continue;
            if (row[part] < 0) {
                row[part] = static_cast<std::int32_t>(found.size());
                found.emplace_back();
            }
            found[row[part]].push_back(f);
        }
        return found;
    }

    std::optional<Quadric> quadric_of(std::span<const std::int32_t> faces) const {
        QuadricSamples samples;
        for (const std::int32_t f : faces) {
            const auto& [a, b, c] = mesh_.faces[f];
            for (const std::int32_t v : {a, b, c}) samples.add(mesh_.vertices[v], normal_[f], area_[f]);
            samples.loops += 2 * area_[f] * normal_[f];
        }
        const std::optional<Quadric> quadric = simplest_quadric(samples, tolerance_, step_);
        if (!quadric) return {};
        const bool inside = std::ranges::all_of(mesh_.vertices, [&](const Vec3& v) {
            return quadric->value(v) >= -tolerance_ * norm(quadric->gradient(v));
        });
        return inside ? quadric : std::nullopt;
    }

    // With all else that lies on the quadric: slivers face anywhere, and a free form fitted to them has a
    // corner there.
    void take(const Quadric& quadric, std::span<const std::int32_t> faces) {
        for (const std::int32_t f : faces) taken_[f] = kNew;
        Cut cut{{}, quadric};
        for (std::int32_t f = 0; f < static_cast<std::int32_t>(taken_.size()); ++f) {
            const bool lies_on =
                taken_[f] == kFree && std::ranges::all_of(mesh_.faces[f], [&](std::int32_t v) {
                    return first_order_distance(quadric, mesh_.vertices[v]) <= tolerance_;
                });
            if (!lies_on && taken_[f] != kNew) continue;
            taken_[f] = kTaken;
            cut.faces.push_back(f);
        }
        found_.push_back(std::move(cut));
    }

    static constexpr char kFree = 0, kNew = 1, kTaken = 2;

    const TriangleMesh& mesh_;
    double tolerance_, step_, all_ = 0;
    std::vector<double> area_;
    std::vector<Vec3> normal_;
    std::vector<Edge> edges_;
    std::vector<char> taken_;
    std::vector<Cut> found_;
};

}  // namespace

std::vector<Cut> find_cuts(const TriangleMesh& mesh, double tolerance, double step, const Task& task) {
    return Finder(mesh, tolerance, step).run(task);
}

}  // namespace pfgeom
