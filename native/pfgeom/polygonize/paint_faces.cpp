#include "pfgeom/polygonize/paint_faces.h"

#include "pfgeom/base/error.h"
#include "pfgeom/base/limits.h"
#include "pfgeom/base/parallel.h"
#include "pfgeom/mesh/edges.h"
#include "pfgeom/polygonize/material_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace pfgeom {
namespace {

// Every round divides an edge once, so an edge with n changes takes about log2 n rounds more than one with
// one; what is left then has the material of most of its area.
constexpr int kMostRounds = 20;
constexpr std::size_t kChunk = 512;

class Painter {
  public:
    Painter(TriangleMesh& mesh, const Frame& frame, std::span<const MaterialTree* const> tree_of, double snap,
            const Task& task)
        : mesh_(mesh), frame_(frame), tree_of_(tree_of.begin(), tree_of.end()), snap_(snap), task_(task) {}

    std::vector<std::int32_t> run() {
        found_.resize(mesh_.faces.size());
        depth_before_.assign(mesh_.faces.size(), std::numeric_limits<double>::infinity());
        look_at(0);
        for (int round = 0; round < kMostRounds; ++round) {
            if (std::none_of(found_.begin(), found_.end(), [this](const auto& f) { return mixed(f); })) break;
            divide();
        }
        std::vector<std::int32_t> materials;
        for (const TriangleMaterials& f : found_) materials.push_back(f.main);
        return materials;
    }

  private:
    bool mixed(const TriangleMaterials& f) const { return f.depth * frame_.half() > snap_; }

    // Dividing its sides does not help: a border that leaves a corner nearly along a side moves on with every
    // new corner. Then a point inside does.
    bool slow(std::size_t face) const { return found_[face].depth >= depth_before_[face]; }

    const Vec3& vertex(std::int32_t row) const { return mesh_.vertices[static_cast<std::size_t>(row)]; }

    std::array<Vec3, 3> corners(std::size_t face) const {
        std::array<Vec3, 3> result;
        for (std::size_t i = 0; i < 3; ++i) result[i] = frame_.to_local(vertex(mesh_.faces[face][i]));
        return result;
    }

    // The faces from the given one on.
    void look_at(std::size_t first) {
        parallel_chunks(mesh_.faces.size() - first, kChunk, task_, [&](std::size_t begin, std::size_t end) {
            for (std::size_t f = first + begin; f < first + end; ++f)
                found_[f] = triangle_materials(*tree_of_[f], corners(f));
        });
    }

    // The share of the way along the side at which it is to be divided, the one nearest to its middle; < 0:
    // none. The side is looked at a little within the face: on the border itself rounding decides.
    double change_on(std::size_t face, std::size_t corner) const {
        const std::array<Vec3, 3> p = corners(face);
        const Vec3 &a = p[corner], &b = p[(corner + 1) % 3], &c = p[(corner + 2) % 3];
        const double length = norm(b - a), snap = snap_ / frame_.half();
        const double height = norm(cross(b - a, c - a)) / length;
        if (!(length > 2 * snap) || !(height > 0)) return -1;
        const double inwards = std::min(1.0 / 64, snap / 2 / height), margin = snap / length;
        double best = -1;
        for (const double t :
             material_changes(*tree_of_[face], a + (c - a) * inwards, b + (c - b) * inwards)) {
            if (t < margin || t > 1 - margin) continue;
            if (best < 0 || std::abs(t - 0.5) < std::abs(best - 0.5)) best = t;
        }
        return best;
    }

    // From the edge's lower vertex; of all faces at the edge.
    double division_of(std::span<const EdgeUse> uses) const {
        double best = -1;
        for (const EdgeUse& use : uses) {
            const auto face = static_cast<std::size_t>(use.face());
            if (!mixed(found_[face]) || slow(face)) continue;
            double t = change_on(face, static_cast<std::size_t>(use.side % 3));
            if (t < 0) continue;
            if (!use.forward) t = 1 - t;
            if (best < 0 || std::abs(t - 0.5) < std::abs(best - 0.5)) best = t;
        }
        return best;
    }

    // One round: divides edges where the material changes; mixed faces without such an edge at a point
    // inside.
    void divide() {
        task_.check();
        std::vector<std::array<std::int32_t, 3>> at(mesh_.faces.size(),
                                                    {-1, -1, -1});  // new vertices by side
        EdgeTable(mesh_.faces, mesh_.vertices.size()).for_each([&](std::span<const EdgeUse> uses) {
            const double t = division_of(uses);
            if (t < 0) return;
            const auto fresh = static_cast<std::int32_t>(mesh_.vertices.size());
            const Vec3 lo = vertex(uses.front().lo), hi = vertex(uses.front().hi);
            mesh_.vertices.push_back(lo + (hi - lo) * t);
            for (const EdgeUse& use : uses)
                at[static_cast<std::size_t>(use.face())][static_cast<std::size_t>(use.side % 3)] = fresh;
        });
        const std::vector<Triangle> before = std::exchange(mesh_.faces, {});
        const std::vector<const MaterialTree*> trees = std::exchange(tree_of_, {});
        const std::vector<TriangleMaterials> found = std::exchange(found_, {});
        depth_before_.clear();
        std::vector<std::size_t> divided;
        for (std::size_t f = 0; f < before.size(); ++f) {
            if (at[f] == std::array<std::int32_t, 3>{-1, -1, -1} && !mixed(found[f])) {
                mesh_.faces.push_back(before[f]);
                tree_of_.push_back(trees[f]);
                found_.push_back(found[f]);
            } else {
                divided.push_back(f);
            }
        }
        const std::size_t kept = mesh_.faces.size();
        depth_before_.resize(kept);
        for (const std::size_t f : divided) {
            add_parts(before[f], at[f], found[f]);
            tree_of_.resize(mesh_.faces.size(), trees[f]);
            depth_before_.resize(mesh_.faces.size(), found[f].depth);
        }
        if (mesh_.faces.size() > Limits{}.polygon_faces)
            throw LimitExceeded(
                "cut along the borders of its materials, the mesh has more than 20 million faces");
        found_.resize(mesh_.faces.size());
        look_at(kept);
    }

    void add(std::int32_t a, std::int32_t b, std::int32_t c) { mesh_.faces.push_back({a, b, c}); }

    void add_parts(const Triangle& face, const std::array<std::int32_t, 3>& at,
                   const TriangleMaterials& found) {
        const auto count = std::count_if(at.begin(), at.end(), [](std::int32_t v) { return v >= 0; });
        if (count == 0) return add_fan(face, found);
        if (count == 3) {
            for (std::size_t i = 0; i < 3; ++i) add(face[i], at[i], at[(i + 2) % 3]);
            return add(at[0], at[1], at[2]);
        }
        std::size_t i = 0;  // the first divided side; of two, the one behind which the other follows
        while (at[i] < 0 || (count == 2 && at[(i + 1) % 3] < 0)) ++i;
        const std::int32_t a = face[i], b = face[(i + 1) % 3], c = face[(i + 2) % 3], m = at[i];
        if (count == 1) {
            add(a, m, c);
            return add(m, b, c);
        }
        const std::int32_t n = at[(i + 1) % 3];
        add(m, b, n);
        if (squared_norm(vertex(n) - vertex(a)) <= squared_norm(vertex(c) - vertex(m))) {
            add(a, m, n);
            add(a, n, c);
        } else {
            add(a, m, c);
            add(m, n, c);
        }
    }

    void add_fan(const Triangle& face, const TriangleMaterials& found) {
        const auto middle = static_cast<std::int32_t>(mesh_.vertices.size());
        mesh_.vertices.push_back(frame_.to_world(found.deepest));
        for (std::size_t i = 0; i < 3; ++i) add(face[i], face[(i + 1) % 3], middle);
    }

    TriangleMesh& mesh_;
    const Frame& frame_;
    std::vector<const MaterialTree*> tree_of_;
    double snap_;
    const Task& task_;
    std::vector<TriangleMaterials> found_;
    std::vector<double> depth_before_;  // of what each face is a part of
};

}  // namespace

std::vector<std::int32_t> paint_faces(TriangleMesh& mesh, const Frame& frame,
                                      std::span<const MaterialTree* const> tree_of, double snap,
                                      const Task& task) {
    return Painter(mesh, frame, tree_of, snap, task).run();
}

}  // namespace pfgeom
