#include "pfgeom/eval/edge_axes.h"

#include <cmath>
#include <cstddef>

namespace pfgeom {
namespace {

Vec3 place(const MeshPart& part, std::int32_t vertex) {
    const auto& p = part.positions[static_cast<std::size_t>(vertex)];
    return {1.0 * p[0], 1.0 * p[1], 1.0 * p[2]};
}

// Across `along`: from the axis that it is least along.
Vec3 some_normal(const Vec3& along) {
    const double x = std::abs(along.x), y = std::abs(along.y), z = std::abs(along.z);
    Vec3 axis;
    axis[x <= y && x <= z ? 0 : y <= z ? 1 : 2] = 1;
    return normalized(axis - along * dot(along, axis));
}

// From the end that comes first by its coordinates.
Vec3 direction(const MeshPart& part, const std::array<std::int32_t, 2>& ends) {
    const auto a = static_cast<std::size_t>(ends[0]), b = static_cast<std::size_t>(ends[1]);
    const bool rising = part.positions[a] < part.positions[b];
    const Vec3 d = place(part, ends[1]) - place(part, ends[0]);
    return normalized(rising ? d : -d);
}

struct AtEdge {
    Vec3 sum, first;  // of the faces' unit normals
    std::int32_t faces = 0,
                 turn = 0;  // turn: how many have it in the direction of its row less those against
    double fold = 1;
};

// The faces' images, whose normals are the images of theirs and which have the edge in the other direction.
void add_images(AtEdge& e, int axis) {
    if (e.faces == 1) e.fold = 1 - 2 * e.first[axis] * e.first[axis];
    e.sum[axis] = 0;
    e.faces *= 2;
    e.turn = 0;
}

std::vector<AtEdge> gather(const MeshPart& part, const EdgesOfFaces& edges) {
    std::vector<AtEdge> at(edges.ends.size());
    for (std::size_t f = 0; f < part.faces.size(); ++f) {
        const Triangle& t = part.faces[f];
        const Vec3 a = place(part, t[0]), b = place(part, t[1]), c = place(part, t[2]);
        const Vec3 normal = normalized(cross(b - a, c - a));
        for (std::size_t k = 0; k < 3; ++k) {
            const auto row = static_cast<std::size_t>(edges.of_face[f][k]);
            AtEdge& e = at[row];
            if (e.faces == 0) e.first = normal;
            if (e.faces == 1) e.fold = dot(e.first, normal);
            e.sum += normal;
            ++e.faces;
            e.turn += edges.ends[row][0] == t[k] ? 1 : -1;
        }
    }
    for (std::size_t row = 0; row < at.size(); ++row) {
        if (part.is_seam(edges.ends[row])) add_images(at[row], part.mirror->axis);
    }
    return at;
}

}  // namespace

std::vector<EdgeAxes> edge_axes(const MeshPart& part, const EdgesOfFaces& edges) {
    const std::vector<AtEdge> at = gather(part, edges);
    std::vector<EdgeAxes> axes(at.size());
    for (std::size_t i = 0; i < at.size(); ++i) {
        EdgeAxes& e = axes[i];
        e.faces = at[i].faces;
        e.along = direction(part, edges.ends[i]);
        // More faces, or two that disagree about their sides, have no mean that all orders give alike.
        const bool agree = e.faces == 1 || (e.faces == 2 && at[i].turn == 0);
        if (agree) e.normal = normalized(at[i].sum - e.along * dot(e.along, at[i].sum));
        if (agree && e.faces == 2) e.fold = at[i].fold;
        if (e.normal == Vec3{}) e.normal = some_normal(e.along);
        e.sideways = cross(e.normal, e.along);
    }
    return axes;
}

}  // namespace pfgeom
