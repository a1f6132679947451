// Greedy: in rising order, a vertex takes the nearest representative within reach, or becomes one. So nothing
// moves further than the distance, as it could in the chains of a union-find.
#include "pfgeom/mesh/near_vertices.h"

#include <bit>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <unordered_map>
#include <utility>

namespace pfgeom {
namespace {

/// Representatives by cells. A cell is four times as wide as the reach, so that most balls of that radius lie
/// in one or two cells.
class Grid {
  public:
    Grid(double reach, std::size_t vertices) : reach_(reach), width_(4 * reach), next_(vertices, -1) {}

    void add(const Vec3& p, std::int32_t vertex) {
        const auto [first, fresh] = first_.try_emplace(key(cell(p)), vertex);
        if (!fresh) next_[vertex] = std::exchange(first->second, vertex);
    }

    /// Calls visit(vertex) for all within reach of p, and for some others.
    template <class Visit>
    void for_each_near(const Vec3& p, Visit visit) const {
        const Vec3 reach{reach_, reach_, reach_}, lo = cell(p - reach), hi = cell(p + reach);
        for (int corner = 0; corner < 8; ++corner) {  // neighbours or the same, on each axis
            Vec3 at = lo;
            bool again = false;
            for (int axis = 0; axis < 3; ++axis)
                if (corner >> axis & 1) {
                    again = again || lo[axis] == hi[axis];
                    at[axis] = hi[axis];
                }
            const auto first = again ? first_.end() : first_.find(key(at));
            if (first == first_.end()) continue;
            for (std::int32_t v = first->second; v >= 0; v = next_[v]) visit(v);
        }
    }

  private:
    /// Whole numbers, as doubles: they may be beyond the integers.
    Vec3 cell(const Vec3& p) const {
        return {std::floor(p.x / width_), std::floor(p.y / width_), std::floor(p.z / width_)};
    }

    /// Cells that share a key are looked at in vain.
    static std::uint64_t key(const Vec3& cell) {
        std::uint64_t h = 0;
        for (int axis = 0; axis < 3; ++axis) {
            h = (h ^ std::bit_cast<std::uint64_t>(cell[axis] + 0.0)) * 0x9E3779B97F4A7C15ULL;  // -0 + 0 is +0
            h ^= h >> 29;
        }
        return h;
    }

    double reach_, width_;
    std::unordered_map<std::uint64_t, std::int32_t> first_;  // looked up only: its order decides nothing
    std::vector<std::int32_t> next_;
};

/// The faces around each vertex.
class VertexFaces {
  public:
    explicit VertexFaces(const TriangleMesh& mesh)
        : starts_(mesh.vertices.size() + 1, 0), faces_(3 * mesh.faces.size()) {
        for (const Triangle& face : mesh.faces)
            for (const std::int32_t v : face) ++starts_[v + 1];
        std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
        std::vector<std::size_t> next = starts_;
        for (std::size_t f = 0; f < mesh.faces.size(); ++f)
            for (const std::int32_t v : mesh.faces[f]) faces_[next[v]++] = static_cast<std::int32_t>(f);
    }
    std::span<const std::int32_t> operator[](std::int32_t vertex) const {
        return std::span(faces_).subspan(starts_[vertex], starts_[vertex + 1] - starts_[vertex]);
    }

  private:
    std::vector<std::size_t> starts_;
    std::vector<std::int32_t> faces_;
};

}  // namespace

std::vector<std::int32_t> near_representatives(const TriangleMesh& mesh,
                                               const std::vector<std::int32_t>& candidates, double distance,
                                               const Task& task) {
    std::vector<std::int32_t> representative(mesh.vertices.size());
    std::iota(representative.begin(), representative.end(), 0);
    if (!(distance > 0)) return representative;

    const VertexFaces around(mesh);
    const auto shares_face = [&](std::int32_t vertex, std::int32_t row) {
        for (const std::int32_t face : around[vertex])
            for (const std::int32_t corner : mesh.faces[face])
                if (corner != vertex && representative[corner] == row) return true;
        return false;
    };
    Grid grid(distance, mesh.vertices.size());
    for (const std::int32_t vertex : candidates) {
        task.check();
        const Vec3& p = mesh.vertices[vertex];
        double nearest = distance * distance;
        std::int32_t best = vertex;
        grid.for_each_near(p, [&](std::int32_t row) {
            const double d2 = squared_norm(mesh.vertices[row] - p);
            const bool better = d2 < nearest || (d2 == nearest && (best == vertex || row < best));
            if (!better || shares_face(vertex, row)) return;
            nearest = d2;
            best = row;
        });
        representative[vertex] = best;
        if (best == vertex) grid.add(p, vertex);
    }
    return representative;
}

}  // namespace pfgeom
