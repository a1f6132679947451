#include "pfgeom/mesh/weld.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

namespace pfgeom {
namespace {

/// Mixes the bits of the three coordinates (the finaliser of SplitMix64, see base/random.h).
std::uint64_t hash(const Vec3& p) {
    std::uint64_t h = 0;
    for (int axis = 0; axis < 3; ++axis) {
        h += std::bit_cast<std::uint64_t>(p[axis] + 0.0);  // -0 + 0 is +0
        h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9ULL;
        h = (h ^ (h >> 27)) * 0x94D049BB133111EBULL;
        h ^= h >> 31;
    }
    return h;
}

std::vector<bool> used_vertices(const TriangleMesh& mesh) {
    std::vector<bool> used(mesh.vertices.size(), false);
    for (const Triangle& face : mesh.faces)
        for (const std::int32_t v : face) used[v] = true;
    return used;
}

template <class Drop>
std::int64_t remove_faces(std::vector<Triangle>& faces, Drop drop) {
    return static_cast<std::int64_t>(std::erase_if(faces, drop));
}

}  // namespace

std::vector<std::int32_t> exact_representatives(const TriangleMesh& mesh) {
    const std::vector<bool> used = used_vertices(mesh);
    std::vector<std::int32_t> representative(mesh.vertices.size(), -1);
    // Open addressing, at most half full.
    std::vector<std::int32_t> slots(std::bit_ceil(2 * mesh.vertices.size() + 1), -1);
    const std::uint64_t mask = slots.size() - 1;
    for (std::size_t row = 0; row < mesh.vertices.size(); ++row) {
        if (!used[row]) continue;
        const Vec3& p = mesh.vertices[row];
        std::uint64_t slot = hash(p) & mask;
        while (slots[slot] >= 0 && !(mesh.vertices[slots[slot]] == p)) slot = (slot + 1) & mask;
        if (slots[slot] < 0) slots[slot] = static_cast<std::int32_t>(row);
        representative[row] = slots[slot];
    }
    return representative;
}

void reindex(std::vector<Triangle>& faces, std::span<const std::int32_t> map) {
    for (Triangle& face : faces)
        for (std::int32_t& v : face) v = map[v];
}

std::int64_t remove_repeated_corners(std::vector<Triangle>& faces) {
    return remove_faces(faces,
                        [](const Triangle& f) { return f[0] == f[1] || f[1] == f[2] || f[2] == f[0]; });
}

std::int64_t remove_zero_area(TriangleMesh& mesh) {
    return remove_faces(mesh.faces, [&](const Triangle& f) {
        const Vec3& a = mesh.vertices[f[0]];
        return cross(mesh.vertices[f[1]] - a, mesh.vertices[f[2]] - a) == Vec3{};
    });
}

std::int64_t remove_duplicates(std::vector<Triangle>& faces) {
    struct Key {
        Triangle sorted;
        std::size_t row;
    };
    std::vector<Key> keys;
    keys.reserve(faces.size());
    for (std::size_t row = 0; row < faces.size(); ++row) {
        keys.push_back({faces[row], row});
        std::sort(keys.back().sorted.begin(), keys.back().sorted.end());
    }
    std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
        return a.sorted != b.sorted ? a.sorted < b.sorted : a.row < b.row;
    });
    std::vector<bool> again(faces.size(), false);
    for (std::size_t i = 1; i < keys.size(); ++i)
        if (keys[i].sorted == keys[i - 1].sorted) again[keys[i].row] = true;
    std::size_t row = 0;
    return remove_faces(faces, [&](const Triangle&) { return again[row++]; });
}

void compact_vertices(TriangleMesh& mesh) {
    const std::vector<bool> used = used_vertices(mesh);
    if (std::find(used.begin(), used.end(), false) == used.end()) return;
    std::vector<std::int32_t> map(mesh.vertices.size(), -1);
    std::int32_t next = 0;
    for (std::size_t row = 0; row < mesh.vertices.size(); ++row)
        if (used[row]) {
            map[row] = next;
            mesh.vertices[next++] = mesh.vertices[row];
        }
    mesh.vertices.resize(next);
    reindex(mesh.faces, map);
}

}  // namespace pfgeom
