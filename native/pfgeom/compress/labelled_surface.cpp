#include "pfgeom/compress/labelled_surface.h"

#include "pfgeom/mesh/edges.h"

#include <algorithm>
#include <numeric>

namespace pfgeom {
namespace {

bool before(const Vec3& a, const Vec3& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

// Numbers of points: equal ones have one.
class PointNumbers {
  public:
    explicit PointNumbers(std::vector<Vec3> points) : points_(std::move(points)) {
        std::sort(points_.begin(), points_.end(), before);
        points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
    }
    std::int32_t operator()(const Vec3& p) const {
        const auto at = std::lower_bound(points_.begin(), points_.end(), p, before);
        return at != points_.end() && *at == p ? static_cast<std::int32_t>(at - points_.begin()) : -1;
    }

  private:
    std::vector<Vec3> points_;
};

Triangle numbers_of(const TriangleMesh& mesh, const Triangle& face, const PointNumbers& number) {
    Triangle result;
    for (std::size_t i = 0; i < 3; ++i) result[i] = number(mesh.vertices[static_cast<std::size_t>(face[i])]);
    std::sort(result.begin(), result.end());
    return result;
}

// Edges as faces of two corners.
TriangleMesh as_mesh(const std::vector<BorderEdge>& borders) {
    TriangleMesh mesh;
    for (const BorderEdge& border : borders) {
        const auto row = static_cast<std::int32_t>(mesh.vertices.size());
        mesh.vertices.push_back(border.from);
        mesh.vertices.push_back(border.to);
        mesh.faces.push_back({row, row + 1, row + 1});
    }
    return mesh;
}

void add_other(MaterialSample& sample, std::int32_t material) {
    if (sample.allows(material)) return;
    const auto free = std::find(sample.others.begin(), sample.others.end(), -1);
    if (free != sample.others.end()) *free = material;
}

}  // namespace

std::vector<std::int32_t> materials_after(const TriangleMesh& input, std::span<const std::int32_t> of_face,
                                          const TriangleMesh& prepared) {
    const PointNumbers number(input.vertices);
    std::vector<std::pair<Triangle, std::int32_t>> known;
    for (std::size_t f = 0; f < input.faces.size(); ++f)
        known.emplace_back(numbers_of(input, input.faces[f], number), static_cast<std::int32_t>(f));
    std::sort(known.begin(), known.end());
    std::vector<std::int32_t> result;
    std::vector<std::size_t> moved;
    for (std::size_t f = 0; f < prepared.faces.size(); ++f) {
        const Triangle wanted = numbers_of(prepared, prepared.faces[f], number);
        const auto at = std::lower_bound(known.begin(), known.end(), std::pair(wanted, std::int32_t{-1}));
        const bool found = wanted[0] >= 0 && at != known.end() && at->first == wanted;
        result.push_back(found ? of_face[static_cast<std::size_t>(at->second)] : -1);
        if (!found) moved.push_back(f);
    }
    if (moved.empty()) return result;
    const Bvh bvh(input);
    for (const std::size_t f : moved) {
        Vec3 middle;
        for (const std::int32_t v : prepared.faces[f])
            middle += prepared.vertices[static_cast<std::size_t>(v)] / 3;
        result[f] = of_face[static_cast<std::size_t>(bvh.closest(middle).face)];
    }
    return result;
}

LabelledSurface::LabelledSurface(const TriangleMesh& mesh, std::vector<std::int32_t> materials, bool several)
    : materials_(std::move(materials)), several_(several), faces_(mesh), edges_(TriangleMesh{}) {
    several_materials_ = std::any_of(materials_.begin(), materials_.end(),
                                     [this](std::int32_t m) { return m != materials_.front(); });
    if (several_materials_) find_borders(mesh);
    edges_ = Bvh(as_mesh(borders_));
}

void LabelledSurface::find_borders(const TriangleMesh& mesh) {
    const auto vertex = [&mesh](std::int32_t v) { return mesh.vertices[static_cast<std::size_t>(v)]; };
    EdgeTable(mesh.faces, mesh.vertices.size()).for_each([&](std::span<const EdgeUse> uses) {
        BorderEdge border{vertex(uses.front().lo), vertex(uses.front().hi), {}, {}};
        border.materials.fill(materials_[static_cast<std::size_t>(uses.front().face())]);
        for (const EdgeUse& use : uses) {
            const Triangle& face = mesh.faces[static_cast<std::size_t>(use.face())];
            const Vec3 a = vertex(face[0]);
            border.normal += normalized(cross(vertex(face[1]) - a, vertex(face[2]) - a));
            const std::int32_t material = materials_[static_cast<std::size_t>(use.face())];
            if (border.materials[0] == border.materials[1]) border.materials[1] = material;
        }
        if (border.materials[0] != border.materials[1]) borders_.push_back(border);
    });
}

MaterialSample LabelledSurface::ask(const Vec3& p, double near) const {
    const ClosestPoint at = faces_.closest(p);
    MaterialSample sample;
    sample.p = p;
    sample.material = materials_[static_cast<std::size_t>(at.face)];
    std::vector<std::int32_t> rows;
    edges_.faces_within(at.point, near, rows);
    std::sort(rows.begin(), rows.end());
    for (const std::int32_t row : rows) {
        for (const std::int32_t m : borders_[static_cast<std::size_t>(row)].materials) add_other(sample, m);
    }
    if (!several_) return sample;
    // Where parts cross, the nearest may be another one than the point's own.
    rows.clear();
    faces_.faces_within(p, std::sqrt(at.squared_distance) + near, rows);
    std::sort(rows.begin(), rows.end());
    for (const std::int32_t row : rows) add_other(sample, materials_[static_cast<std::size_t>(row)]);
    return sample;
}

}  // namespace pfgeom
