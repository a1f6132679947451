#include "pfgeom/mesh/halves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace pfgeom {
namespace {

class Cutter {
  public:
    Cutter(const TriangleMesh& mesh, const AxisPlane& plane, double near) : mesh_(mesh), plane_(plane) {
        for (const Vec3& p : mesh.vertices) {
            const double above = p[plane.axis] - plane.at;
            above_.push_back(std::abs(above) <= near ? 0 : above);
        }
        row_.assign(mesh.vertices.size(), -1);
    }

    TriangleMesh run() {
        for (const Triangle& t : mesh_.faces) add(t);
        return std::move(half_);
    }

  private:
    double above(std::int32_t v) const { return above_[static_cast<std::size_t>(v)]; }

    // What is above is a triangle or a quadrangle.
    void add(const Triangle& t) {
        if (!(above(t[0]) > 0 || above(t[1]) > 0 || above(t[2]) > 0)) return;
        std::array<std::int32_t, 4> corners{};
        std::size_t count = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int32_t a = t[k], b = t[(k + 1) % 3];
            if (above(a) >= 0) corners[count++] = vertex(a);
            if (above(a) * above(b) < 0) corners[count++] = crossing(std::min(a, b), std::max(a, b));
        }
        half_.faces.push_back({corners[0], corners[1], corners[2]});
        if (count == 4) half_.faces.push_back({corners[0], corners[2], corners[3]});
    }

    std::int32_t vertex(std::int32_t v) {
        std::int32_t& row = row_[static_cast<std::size_t>(v)];
        if (row >= 0) return row;
        Vec3 p = mesh_.vertices[static_cast<std::size_t>(v)];
        if (above(v) == 0) p[plane_.axis] = plane_.at;
        return row = push(p);
    }

    // Of an edge, the same for all its faces.
    std::int32_t crossing(std::int32_t a, std::int32_t b) {
        const auto [known, fresh] = crossings_.try_emplace({a, b}, -1);
        if (!fresh) return known->second;
        const Vec3 &p = mesh_.vertices[static_cast<std::size_t>(a)],
                   &q = mesh_.vertices[static_cast<std::size_t>(b)];
        Vec3 on_plane = p + (q - p) * (above(a) / (above(a) - above(b)));
        on_plane[plane_.axis] = plane_.at;
        return known->second = push(on_plane);
    }

    std::int32_t push(const Vec3& p) {
        half_.vertices.push_back(p);
        return static_cast<std::int32_t>(half_.vertices.size()) - 1;
    }

    const TriangleMesh& mesh_;
    AxisPlane plane_;
    std::vector<double> above_;
    std::vector<std::int32_t> row_;
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> crossings_;
    TriangleMesh half_;
};

}  // namespace

TriangleMesh half_above(const TriangleMesh& mesh, const AxisPlane& plane, double near) {
    return Cutter(mesh, plane, near).run();
}

TriangleMesh mirrored(TriangleMesh mesh, const AxisPlane& plane) {
    for (Vec3& v : mesh.vertices) v[plane.axis] = 2 * plane.at - v[plane.axis];
    for (Triangle& t : mesh.faces) std::swap(t[1], t[2]);
    return mesh;
}

}  // namespace pfgeom
