// Region growing from seeds (Besl, Jain, "Segmentation through variable-order surface fitting", IEEE PAMI
// 10(2), 1988), on vertices instead of range samples and with the quadric alone.
#include "pfgeom/segment/exact_patches.h"

#include "pfgeom/mesh/edges.h"
#include "pfgeom/mesh/sample.h"
#include "pfgeom/segment/ellipsoid.h"
#include "pfgeom/segment/power_sums.h"
#include "pfgeom/segment/region_set.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

namespace pfgeom {
namespace {

constexpr double kExact = 2e-6;          // of the diagonal: single precision, or six digits of text
constexpr std::size_t kSeedSize = 14;    // vertices of a seed; nine would fit any quadric
constexpr std::size_t kLeastSize = 40;   // of a patch worth having
constexpr double kFlat = 1e-3;           // height of a flat seed, of its radius
constexpr double kAligned = 0.9;         // cosine between gradient and vertex normal
constexpr int kMostLooks = 500;          // at all vertices
constexpr std::size_t kLongWalk = 1000;  // vertices; shorter vain walks cost nothing
constexpr double kRefit = 1.5;           // growth after which the quadric is solved again

// A quadric through the points of a patch, in a frame in which the patch fills the unit ball: there its
// system is as well conditioned as the patch allows.
struct LocalQuadric {
    Vec3 centre;
    double radius = 1;
    Quadric quadric;

    double distance(const Vec3& p) const {  // to first order
        const Vec3 x = (p - centre) / radius;
        return radius * std::abs(quadric.value(x)) / std::max(norm(quadric.gradient(x)), 1e-9);
    }
    Vec3 inwards(const Vec3& p) const { return quadric.gradient((p - centre) / radius); }

    // In the frame of the points: q((p - centre) / radius), times radius.
    Quadric in_the_large() const {
        Quadric q = quadric;
        for (std::size_t i = 0; i < 6; ++i) q.c[i] /= radius;
        const Quadric squares{{q.c[0], q.c[1], q.c[2], q.c[3], q.c[4], q.c[5]}};
        const Vec3 slope = squares.gradient(centre), linear{q.c[6], q.c[7], q.c[8]};
        for (int axis = 0; axis < 3; ++axis) q.c[6 + static_cast<std::size_t>(axis)] -= slope[axis];
        q.c[9] = radius * q.c[9] - dot(linear, centre) + squares.value(centre);
        return q;
    }
};

class PatchFinder {
  public:
    explicit PatchFinder(const TriangleMesh& mesh)
        : mesh_(mesh),
          normals_(vertex_normals(mesh)),
          exact_(kExact * diagonal(mesh)),
          first_(mesh.vertices.size() + 1, 0),
          patch_(mesh.vertices.size(), kFree),
          tried_(mesh.vertices.size(), 0),
          mark_(mesh.vertices.size(), 0) {
        const EdgeTable edges(mesh.faces, mesh.vertices.size());
        edges.for_each([&](std::span<const EdgeUse> uses) {
            ++first_[static_cast<std::size_t>(uses[0].lo) + 1];
            ++first_[static_cast<std::size_t>(uses[0].hi) + 1];
        });
        for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
        neighbours_.resize(first_.back());
        std::vector<std::size_t> at(first_.begin(), first_.end() - 1);
        edges.for_each([&](std::span<const EdgeUse> uses) {
            neighbours_[at[static_cast<std::size_t>(uses[0].lo)]++] = uses[0].hi;
            neighbours_[at[static_cast<std::size_t>(uses[0].hi)]++] = uses[0].lo;
        });
    }

    std::vector<ExactPatch> run(const Task& task) {
        for (std::size_t v = 0; v < patch_.size(); ++v) {
            task.check();
            if (patch_[v] == kFree && tried_[v] == 0) try_seed(static_cast<std::int32_t>(v));
        }
        std::vector<ExactPatch> found(quadrics_.size());
        for (std::size_t i = 0; i < found.size(); ++i) found[i].quadric = quadrics_[i].in_the_large();
        for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
            const auto& [a, b, c] = mesh_.faces[f];
            if (patch_[a] != kFree && patch_[a] == patch_[b] && patch_[b] == patch_[c])
                found[static_cast<std::size_t>(patch_[a])].faces.push_back(static_cast<std::int32_t>(f));
        }
        std::erase_if(found, [](const ExactPatch& patch) { return patch.faces.empty(); });
        return found;
    }

  private:
    static constexpr std::int32_t kFree = -1;

    std::span<const std::int32_t> neighbours(std::int32_t v) const {
        return std::span(neighbours_).subspan(first_[v], first_[v + 1] - first_[v]);
    }

    void try_seed(std::int32_t seed) {
        std::vector<std::int32_t> members{seed};
        begin_walk(seed);
        for (std::size_t i = 0; i < members.size() && members.size() < kSeedSize; ++i)
            visit_neighbours(members[i], [&](std::int32_t v) { members.push_back(v); });
        members.resize(std::min(members.size(), kSeedSize));
        tried_[seed] = 1;
        for (const std::int32_t v : neighbours(seed)) tried_[v] = 1;
        if (members.size() < kSeedSize || is_flat(members)) return;
        std::optional<LocalQuadric> q = fit(members);
        if (!q) return;
        if (!grow(members, *q)) {
            // What is near the seed would take the same long walk in vain (a fillet of a million triangles).
            if (members.size() < kLongWalk) return;
            for (const std::int32_t v : std::span(members).first(members.size() / 4)) tried_[v] = 1;
            return;
        }
        for (const std::int32_t v : members) patch_[v] = static_cast<std::int32_t>(quadrics_.size());
        quadrics_.push_back(*q);
    }

    // Adds vertices that lie on the quadric, from the seed outwards; solves it again with them. False if the
    // patch stays small.
    bool grow(std::vector<std::int32_t>& members, LocalQuadric& q) {
        for (;;) {
            const std::size_t solved = members.size();
            walk(members, q, static_cast<std::size_t>(kRefit * static_cast<double>(solved)));
            const bool around = members.size() == solved;
            if (around) look_around(members, q);
            if (members.size() == solved) break;
            if (const std::optional<LocalQuadric> better = fit(members)) {
                q = *better;
            } else if (around) {
                members.resize(solved);
                break;
            } else {
                return false;
            }
        }
        return members.size() >= kLeastSize;
    }

    // Other surfaces cut an ellipsoid into pieces, each too small to be worth having: those apart as well.
    void look_around(std::vector<std::int32_t>& members, const LocalQuadric& q) {
        if (looks_left_ == 0 || !ellipsoid_of(q.quadric)) return;
        --looks_left_;
        for (std::int32_t v = 0; v < static_cast<std::int32_t>(patch_.size()); ++v) {
            if (patch_[v] == kFree && mark_[v] != walk_ && lies_on(q, v)) members.push_back(v);
        }
    }

    // Adds vertices around the members until there are so many, or no more.
    void walk(std::vector<std::int32_t>& members, const LocalQuadric& q, std::size_t enough) {
        begin_walk(members[0]);
        for (const std::int32_t v : members) mark_[v] = walk_;
        for (std::size_t i = 0; i < members.size() && members.size() < enough; ++i) {
            visit_neighbours(members[i], [&](std::int32_t v) {
                if (lies_on(q, v)) members.push_back(v);
            });
        }
    }

    bool lies_on(const LocalQuadric& q, std::int32_t v) const {
        const Vec3& p = mesh_.vertices[v];
        const Vec3 g = q.inwards(p);
        return q.distance(p) <= exact_ && -dot(g, normals_[v]) >= kAligned * norm(g);
    }

    // The quadric that all members lie on, if there is one.
    std::optional<LocalQuadric> fit(const std::vector<std::int32_t>& members) const {
        LocalQuadric q;
        for (const std::int32_t v : members)
            q.centre += mesh_.vertices[v] / static_cast<double>(members.size());
        double square = 0;
        for (const std::int32_t v : members)
            square = std::max(square, squared_norm(mesh_.vertices[v] - q.centre));
        q.radius = std::sqrt(square);
        PowerSums sums;
        for (const std::int32_t v : members)
            sums.add((mesh_.vertices[v] - q.centre) / q.radius, normals_[v], 1);
        q.quadric = sums.system().through_points();
        const bool exact = std::ranges::all_of(members, [&](std::int32_t v) { return lies_on(q, v); });
        return exact ? std::optional(q) : std::nullopt;
    }

    bool is_flat(const std::vector<std::int32_t>& members) const {
        const Vec3 &p = mesh_.vertices[members[0]], &n = normals_[members[0]];
        double height = 0, radius = 0;
        for (const std::int32_t v : members) {
            height = std::max(height, std::abs(dot(mesh_.vertices[v] - p, n)));
            radius = std::max(radius, norm(mesh_.vertices[v] - p));
        }
        return height <= kFlat * radius;
    }

    void begin_walk(std::int32_t start) { mark_[start] = ++walk_; }

    template <class Visit>
    void visit_neighbours(std::int32_t v, const Visit& visit) {
        for (const std::int32_t w : neighbours(v)) {
            if (mark_[w] == walk_ || patch_[w] != kFree) continue;
            mark_[w] = walk_;
            visit(w);
        }
    }

    const TriangleMesh& mesh_;
    std::vector<Vec3> normals_;
    double exact_;
    std::vector<std::size_t> first_;  // of each vertex's neighbours
    std::vector<std::int32_t> neighbours_;
    std::vector<std::int32_t> patch_;  // of each vertex, or kFree
    std::vector<char> tried_;          // as a seed, next to one, or on its way
    std::vector<std::int32_t> mark_;   // the last walk that saw it
    std::int32_t walk_ = 0;
    int looks_left_ = kMostLooks;
    std::vector<LocalQuadric> quadrics_;  // of the patches
};

}  // namespace

std::vector<ExactPatch> find_exact_patches(const TriangleMesh& mesh, const Task& task) {
    return PatchFinder(mesh).run(task);
}

double exact_share(const TriangleMesh& mesh, std::span<const ExactPatch> patches) {
    std::vector<char> exact(mesh.faces.size(), 0);
    for (const ExactPatch& patch : patches) {
        for (const std::int32_t f : patch.faces) exact[f] = 1;
    }
    const double near = kExact * diagonal(mesh);
    EdgeTable(mesh.faces, mesh.vertices.size()).for_each([&](std::span<const EdgeUse> uses) {
        if (uses.size() != 2) return;
        const auto& [a, b, c] = mesh.faces[uses[0].face()];
        const Vec3& corner = mesh.vertices[a];
        const Vec3 n = normalized(cross(mesh.vertices[b] - corner, mesh.vertices[c] - corner));
        const bool flat = std::ranges::all_of(mesh.faces[uses[1].face()], [&](std::int32_t v) {
            return std::abs(dot(n, mesh.vertices[v] - corner)) <= near;
        });
        if (flat) exact[uses[0].face()] = exact[uses[1].face()] = 1;
    });
    double all = 0, share = 0;
    for (std::size_t f = 0; f < exact.size(); ++f) {
        const auto& [a, b, c] = mesh.faces[f];
        const double area =
            norm(cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]));
        all += area;
        if (exact[f] != 0) share += area;
    }
    return all > 0 ? share / all : 0;
}

}  // namespace pfgeom
