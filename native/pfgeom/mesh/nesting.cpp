// Which closed island lies inside of which. Candidates are pairs of nested boxes, found along the axis on
// which the scene is longest; the winding number decides.
#include "pfgeom/mesh/bvh.h"
#include "pfgeom/mesh/islands.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pfgeom {
namespace {

// A contained island is inside with all its vertices; this many of them, spread over its faces, are asked.
// One alone could be where two overlapping islands happen to be one within the other.
constexpr std::size_t kWitnesses = 7;

struct Solid {
    std::int32_t island;
    Box box;
};

bool contains(const Box& outer, const Box& inner) {
    return outer.contains(inner.lo) && outer.contains(inner.hi);
}

bool inside(const TriangleMesh& mesh, const Island& inner, const Bvh& outer) {
    const std::size_t n = std::min(kWitnesses, inner.faces.size());
    for (std::size_t i = 0; i < n; ++i) {
        const Triangle& face = mesh.faces[inner.faces[i * inner.faces.size() / n]];
        if (!(std::abs(outer.winding_number(mesh.vertices[face[0]])) > 0.5)) return false;
    }
    return true;
}

/// Closed, oriented islands with their boxes, by the lower end on `axis`.
std::vector<Solid> find_solids(const TriangleMesh& mesh, const std::vector<Island>& islands, int axis) {
    std::vector<Solid> solids;
    for (std::size_t i = 0; i < islands.size(); ++i) {
        if (!islands[i].closed || !islands[i].oriented) continue;
        Box box;
        for (const std::int32_t face : islands[i].faces)
            for (const std::int32_t v : mesh.faces[face]) box.grow(mesh.vertices[v]);
        solids.push_back({static_cast<std::int32_t>(i), box});
    }
    std::sort(solids.begin(), solids.end(), [axis](const Solid& a, const Solid& b) {
        return a.box.lo[axis] != b.box.lo[axis] ? a.box.lo[axis] < b.box.lo[axis] : a.island < b.island;
    });
    return solids;
}

/// The solids whose boxes lie in `outer`'s, by their island. `solids` are sorted along `axis`.
std::vector<std::int32_t> boxed_in(const std::vector<Solid>& solids, const Solid& outer, int axis) {
    std::vector<std::int32_t> inner;
    auto solid = std::partition_point(solids.begin(), solids.end(),
                                      [&](const Solid& s) { return s.box.lo[axis] < outer.box.lo[axis]; });
    for (; solid != solids.end() && solid->box.lo[axis] <= outer.box.hi[axis]; ++solid)
        if (solid->island != outer.island && contains(outer.box, solid->box)) inner.push_back(solid->island);
    return inner;
}

int longest_axis(const Vec3& extent) {
    return extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
}

}  // namespace

void find_parents(PreparedMesh& prepared, const Task& task) {
    std::vector<Island>& islands = prepared.islands;
    const int axis = longest_axis(bounds(prepared.mesh).extent());
    const std::vector<Solid> solids = find_solids(prepared.mesh, islands, axis);
    const auto volume = [&](std::int32_t island) { return std::abs(islands[island].signed_volume); };
    for (const Solid& solid : solids) {
        task.check();
        std::vector<std::int32_t> inner = boxed_in(solids, solid, axis);
        std::erase_if(inner, [&](std::int32_t i) { return !(volume(i) < volume(solid.island)); });
        if (inner.empty()) continue;
        const Bvh surface(extract_island(prepared, islands[solid.island]));
        for (const std::int32_t i : inner) {
            task.check();
            if (!inside(prepared.mesh, islands[i], surface)) continue;
            // Of several that contain it, the smallest is the next one out.
            std::int32_t& parent = islands[i].parent;
            if (parent < 0 || volume(solid.island) < volume(parent)) parent = solid.island;
        }
    }
}

}  // namespace pfgeom
