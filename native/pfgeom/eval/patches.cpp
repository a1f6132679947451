#include "pfgeom/eval/patches.h"

#include "pfgeom/base/error.h"
#include "pfgeom/base/limits.h"
#include "pfgeom/eval/edge_axes.h"
#include "pfgeom/eval/mirror_image.h"
#include "pfgeom/eval/patch_mesh.h"
#include "pfgeom/function/curved_triangle.h"
#include "pfgeom/function/edges_of_faces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace pfgeom {
namespace {

// An edge is divided into at most this many parts: a half circle, to 1e-4 of its radius.
constexpr int kMostParts = 64;
// Of each edge, in the world.
std::vector<Vec3> bulges_of(const Object& object, const MeshPart& part, const EdgesOfFaces& edges) {
    const std::vector<EdgeAxes> axes = edge_axes(part, edges);
    const double unit = part.bulge_step() * object.frame.half();
    std::vector<Vec3> bulges;
    bulges.reserve(axes.size());
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const Bulge& b = part.bulges[i];
        bulges.push_back((axes[i].normal * b.normal + axes[i].sideways * b.sideways) * unit);
        if (part.is_seam(edges.ends[i])) bulges.back()[part.mirror->axis] = 0;
    }
    return bulges;
}

class Divider {
  public:
    Divider(const Object& object, const Fineness& fineness, const Task& task)
        : object_(object),
          part_(std::get<MeshPart>(object.shape)),
          fineness_(fineness),
          task_(task),
          edges_(EdgesOfFaces::of(part_.faces)),
          bulges_(bulges_of(object, part_, edges_)) {
        for (const auto& p : part_.positions)
            mesh_.vertices.push_back(object_.frame.to_world(part_.local(p)));
        for (std::size_t e = 0; e < bulges_.size(); ++e) parts_.push_back(parts(e));
        even_out();
        check_size();
        for (std::size_t e = 0; e < bulges_.size(); ++e) add_edge(e);
    }

    TriangleMesh run() {
        for (std::size_t f = 0; f < part_.faces.size(); ++f) {
            task_.check();
            add_face(f);
        }
        if (part_.mirror) add_mirror_image(object_.frame, *part_.mirror, mesh_);
        return std::move(mesh_);
    }

  private:
    // A parabola over a chord, in n parts, is 1/n² of its height from theirs.
    int parts(std::size_t edge) const {
        const auto& [a, b] = edges_.ends[edge];
        const Vec3 chord =
            mesh_.vertices[static_cast<std::size_t>(b)] - mesh_.vertices[static_cast<std::size_t>(a)];
        const double by_chord = std::sqrt(norm(bulges_[edge]) / fineness_.chord);
        const double by_length = bulges_[edge] == Vec3{} ? 1 : norm(chord) / fineness_.length;
        return static_cast<int>(std::clamp(std::ceil(std::max(by_chord, by_length)), 1.0, 1.0 * kMostParts));
    }

    // A straight edge of a curved face needs no division for its own sake, but long thin triangles along it
    // are off by as much more as it has fewer parts than a quarter of the finest edge.
    void even_out() {
        std::vector<int> least = parts_;
        for (const Triangle& edges : edges_.of_face) {
            const int quarter = (most_parts(edges) + 3) / 4;
            for (const std::int32_t e : edges) {
                int& parts = least[static_cast<std::size_t>(e)];
                parts = std::max(parts, quarter);
            }
        }
        parts_ = std::move(least);
    }

    void check_size() const {
        std::size_t faces = 0;
        for (const Triangle& edges : edges_.of_face) {
            const auto n = static_cast<std::size_t>(most_parts(edges));
            faces += n * n * (part_.mirror ? 2 : 1);
        }
        if (faces > Limits{}.polygon_faces)
            throw LimitExceeded("too many triangles for a mesh of the patches");
    }

    int most_parts(const Triangle& edges) const {
        int most = 1;
        for (const std::int32_t e : edges) most = std::max(most, parts_[static_cast<std::size_t>(e)]);
        return most;
    }

    // The points within an edge, in the direction of its row.
    void add_edge(std::size_t edge) {
        first_.push_back(static_cast<std::int32_t>(mesh_.vertices.size()));
        const auto a = static_cast<std::size_t>(edges_.ends[edge][0]),
                   b = static_cast<std::size_t>(edges_.ends[edge][1]);
        for (int i = 1; i < parts_[edge]; ++i) {
            const double t = static_cast<double>(i) / parts_[edge];
            mesh_.vertices.push_back(mesh_.vertices[a] * (1 - t) + mesh_.vertices[b] * t +
                                     bulges_[edge] * (4 * t * (1 - t)));
            if (part_.is_seam(edges_.ends[edge]))  // exactly
                mesh_.vertices.back()[part_.mirror->axis] = mesh_.vertices[a][part_.mirror->axis];
        }
    }

    // The i-th of n + 1 points of a lattice along edge k of a face, from its corner k on: the nearest that
    // the edge has, of its parts.
    int on_edge(std::size_t face, std::size_t k, int i, int n) const {
        const int parts = parts_[static_cast<std::size_t>(edges_.of_face[face][k])];
        return (2 * i * parts + n) / (2 * n);
    }

    // Vertices of a face's edges as the patch's mesh has them: where those of edge k begin, k parts on.
    std::array<std::int32_t, 3> add_rim(std::size_t face, PatchMesh& mesh,
                                        std::vector<std::int32_t>& vertex) const {
        constexpr std::array<Vec3, 3> kCorners{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
        std::array<std::int32_t, 3> first{};
        for (std::size_t k = 0; k < 3; ++k) {
            first[k] = static_cast<std::int32_t>(vertex.size());
            const auto edge = static_cast<std::size_t>(edges_.of_face[face][k]);
            const std::int32_t corner = part_.faces[face][k];
            const bool along = edges_.ends[edge][0] == corner;
            for (int i = 0; i < parts_[edge]; ++i) {
                const double t = static_cast<double>(i) / parts_[edge];
                vertex.push_back(i == 0 ? corner : first_[edge] + (along ? i : parts_[edge] - i) - 1);
                mesh.weights.push_back(kCorners[k] * (1 - t) + kCorners[(k + 1) % 3] * t);
                mesh.position.push_back(mesh_.vertices[static_cast<std::size_t>(vertex.back())]);
            }
        }
        mesh.rim = vertex.size();
        return first;
    }

    // A lattice as fine as the finest edge; on coarser ones its points fall together.
    PatchMesh lattice(std::size_t face, const CurvedTriangle& patch,
                      std::vector<std::int32_t>& vertex) const {
        PatchMesh mesh;
        const auto first = add_rim(face, mesh, vertex);
        const auto rim = static_cast<std::int32_t>(mesh.rim);
        const int n = most_parts(edges_.of_face[face]);
        const auto on_rim = [&](std::size_t k, int i) { return (first[k] + on_edge(face, k, i, n)) % rim; };
        std::vector<std::int32_t> before, row;
        for (int i = 0; i <= n; ++i) {  // i / n: weight of corner 0 is 1 - i / n
            row.clear();
            for (int j = 0; j <= i; ++j) {
                if (j == 0) {
                    row.push_back(on_rim(0, i));
                } else if (j == i) {
                    row.push_back(on_rim(2, n - i));
                } else if (i == n) {
                    row.push_back(on_rim(1, j));
                } else {
                    row.push_back(static_cast<std::int32_t>(mesh.weights.size()));
                    mesh.weights.push_back({1.0 * (n - i) / n, 1.0 * (i - j) / n, 1.0 * j / n});
                    mesh.position.push_back(patch.at(mesh.weights.back()));
                }
            }
            for (std::size_t j = 0; j + 1 < row.size(); ++j) {
                add_triangle(before[j], row[j], row[j + 1], mesh);
                if (j > 0) add_triangle(before[j - 1], row[j], before[j], mesh);
            }
            before = row;
        }
        return mesh;
    }

    static void add_triangle(std::int32_t a, std::int32_t b, std::int32_t c, PatchMesh& mesh) {
        if (a != b && b != c && c != a) mesh.faces.push_back({a, b, c});
    }

    void add_face(std::size_t face) {
        const CurvedTriangle patch = surface(face);
        std::vector<std::int32_t> vertex;  // of the whole mesh; -1 for those within, as long as none needs it
        PatchMesh mesh = lattice(face, patch, vertex);
        if (std::isinf(fineness_.length)) thin(patch, fineness_.chord, mesh);
        vertex.resize(mesh.weights.size(), -1);
        for (const Triangle& t : mesh.faces) {
            Triangle& added = mesh_.faces.emplace_back();
            for (std::size_t k = 0; k < 3; ++k) {
                std::int32_t& v = vertex[static_cast<std::size_t>(t[k])];
                if (v < 0) {
                    v = static_cast<std::int32_t>(mesh_.vertices.size());
                    mesh_.vertices.push_back(mesh.position[static_cast<std::size_t>(t[k])]);
                }
                added[k] = v;
            }
        }
    }

    CurvedTriangle surface(std::size_t face) const {
        CurvedTriangle patch;
        for (std::size_t k = 0; k < 3; ++k) {
            patch.corners[k] = mesh_.vertices[static_cast<std::size_t>(part_.faces[face][k])];
            patch.bulges[k] = bulges_[static_cast<std::size_t>(edges_.of_face[face][k])];
        }
        return patch;
    }

    const Object& object_;
    const MeshPart& part_;
    const Fineness& fineness_;
    const Task& task_;
    EdgesOfFaces edges_;
    std::vector<Vec3> bulges_;
    std::vector<int> parts_;           // of each edge
    std::vector<std::int32_t> first_;  // of each edge: its first vertex within
    TriangleMesh mesh_;
};

}  // namespace

TriangleMesh divide_patches(const Object& object, const Fineness& fineness, const Task& task) {
    return Divider(object, fineness, task).run();
}

}  // namespace pfgeom
