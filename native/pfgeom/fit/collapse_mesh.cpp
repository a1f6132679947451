#include "pfgeom/fit/collapse_mesh.h"

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

bool has(const Triangle& t, std::int32_t v) {
    return t[0] == v || t[1] == v || t[2] == v;
}

std::size_t corner_of(const Triangle& t, std::int32_t v) {
    return t[0] == v ? 0 : t[1] == v ? 1 : 2;
}

// Corners or edges from k on, in their cyclic order.
template <class T>
std::array<T, 3> turned(const std::array<T, 3>& t, std::size_t k) {
    return {t[k], t[(k + 1) % 3], t[(k + 2) % 3]};
}
std::array<std::int32_t, 3> from_corner(const Triangle& t, std::int32_t v) {
    return turned(t, corner_of(t, v));
}

Vec3 doubled_area(const std::array<Vec3, 3>& t) {
    return cross(t[1] - t[0], t[2] - t[0]);
}

// A face may turn by up to 78 degrees at once, and become flatter than kFlattest (its height over its longest
// edge) only if it was flatter before, or is too high for the next rounding to the grid to fold it over.
constexpr double kLeastCosine = 0.2, kFlattest = 0.02;

}  // namespace

CollapseMesh::CollapseMesh(const TriangleMesh& mesh, bool curved, std::optional<AxisPlane> mirror,
                           double safe_height)
    : mirror_(mirror),
      safe_height_(safe_height),
      points_(mesh.vertices),
      faces_(mesh.faces),
      bulges_(curved ? mesh.faces.size() : 0),
      at_(mesh.vertices.size()),
      alive_(mesh.faces.size()) {
    for (std::size_t f = 0; f < faces_.size(); ++f) {
        for (const std::int32_t v : faces_[f])
            at_[static_cast<std::size_t>(v)].push_back(static_cast<std::int32_t>(f));
    }
}

std::vector<std::array<std::int32_t, 2>> CollapseMesh::edges() const {
    std::vector<std::array<std::int32_t, 2>> edges;
    for (std::size_t v = 0; v < at_.size(); ++v) {
        const auto low = static_cast<std::int32_t>(v);
        for (const std::int32_t high : neighbours(low)) {
            if (high > low) edges.push_back({low, high});
        }
    }
    return edges;
}

std::vector<std::int32_t> CollapseMesh::neighbours(std::int32_t v, bool all) const {
    std::vector<std::int32_t> ends;
    for (const std::int32_t f : faces_at(v)) {
        for (const std::int32_t w : face(f)) {
            if (w != v) ends.push_back(w);
        }
    }
    std::sort(ends.begin(), ends.end());
    std::vector<std::int32_t> result;
    for (std::size_t i = 0, j = 0; i < ends.size(); i = j) {
        while (j < ends.size() && ends[j] == ends[i]) ++j;
        if (all || j - i != 2) result.push_back(ends[i]);
    }
    return result;
}

// A vertex that comes onto the plane must not bring an edge along that then has both ends there: it would
// fall together with its own image, or a border would seem to be one of the edges along which the halves are
// joined.
bool CollapseMesh::may_meet_mirror(std::int32_t u, std::int32_t v) const {
    if (on_mirror(u) == on_mirror(v)) return true;
    const std::int32_t there = on_mirror(u) ? u : v, comes = on_mirror(u) ? v : u;
    const std::vector<std::int32_t> known = neighbours(there), brought = neighbours(comes);
    return std::all_of(brought.begin(), brought.end(), [&](std::int32_t w) {
        return w == there || !on_mirror(w) || std::binary_search(known.begin(), known.end(), w);
    });
}

bool CollapseMesh::may_collapse(std::int32_t u, std::int32_t v) const {
    if (mirror_ && !may_meet_mirror(u, v)) return false;
    const std::vector<std::int32_t> of_u = neighbours(u), of_v = neighbours(v);
    std::vector<std::int32_t> common;
    std::set_intersection(of_u.begin(), of_u.end(), of_v.begin(), of_v.end(), std::back_inserter(common));
    std::size_t shared = 0, others = 0;
    std::vector<std::array<std::int32_t, 2>> opposite;
    for (const std::int32_t end : {u, v}) {
        for (const std::int32_t f : faces_at(end)) {
            if (has(face(f), u) && has(face(f), v)) {
                shared += end == u ? 1 : 0;
                continue;
            }
            const auto t = from_corner(face(f), end);
            opposite.push_back({std::min(t[1], t[2]), std::max(t[1], t[2])});
            ++others;
        }
    }
    if (shared == 0 || common.size() != shared || others == 0) return false;
    std::sort(opposite.begin(), opposite.end());
    if (std::adjacent_find(opposite.begin(), opposite.end()) != opposite.end()) return false;
    // Two borders that meet across an inner edge would be pinched together.
    return shared != 2 || neighbours(u, false).empty() || neighbours(v, false).empty();
}

Vec3 CollapseMesh::begin(Patch& patch, Vec3 p, bool on_mirror) const {
    patch.before.clear();
    patch.after.clear();
    patch.triangles.clear();
    patch.bulges.clear();
    patch.ends.clear();
    patch.fixed_axis = on_mirror ? mirror_->axis : Patch::kNoAxis;
    if (on_mirror) p[mirror_->axis] = mirror_->at;
    return p;
}

void CollapseMesh::patch_of_move(std::int32_t v, const Vec3& p, Patch& patch) const {
    const Vec3 place = begin(patch, p, on_mirror(v));
    patch.before = patch.after = faces_at(v);
    for (const std::int32_t f : patch.after) {
        const auto t = from_corner(face(f), v);
        patch.triangles.push_back({place, point(t[1]), point(t[2])});
        if (bulges_.empty()) continue;
        patch.bulges.push_back(turned(bulges_[static_cast<std::size_t>(f)], corner_of(face(f), v)));
        patch.ends.push_back({t[1], t[2]});
    }
}

void CollapseMesh::patch_of_face(std::int32_t f, Patch& patch) const {
    begin(patch, {}, false);
    patch.before = patch.after = {f};
    patch.triangles = {corners(f)};
    if (curved()) patch.bulges = {bulges_[static_cast<std::size_t>(f)]};
    patch.ends = {{face(f)[1], face(f)[2]}};
}

void CollapseMesh::patch_of_collapse(std::int32_t u, std::int32_t v, const Vec3& p, Patch& patch) const {
    const Vec3 place = begin(patch, p, on_mirror(u) || on_mirror(v));
    for (const std::int32_t end : {v, u}) {
        for (const std::int32_t f : faces_at(end)) {
            const bool shared = has(face(f), u) && has(face(f), v);
            if (!shared || end == v) patch.before.push_back(f);
            if (shared) continue;
            const auto t = from_corner(face(f), end);
            patch.after.push_back(f);
            patch.triangles.push_back({place, point(t[1]), point(t[2])});
            if (bulges_.empty()) continue;
            patch.bulges.push_back({Vec3{}, bulge(f, (corner_of(face(f), end) + 1) % 3), Vec3{}});
            patch.ends.push_back({t[1], t[2]});
        }
    }
}

bool CollapseMesh::keeps_orientation(const Patch& patch) const {
    const bool free = mirror_ && patch.fixed_axis == Patch::kNoAxis;
    if (free && !(patch.triangles[0][0][mirror_->axis] > mirror_->at)) return false;
    for (std::size_t i = 0; i < patch.after.size(); ++i) {
        const std::array<Vec3, 3> old = corners(patch.after[i]);
        const Vec3 before = doubled_area(old), after = doubled_area(patch.triangles[i]);
        const double b = norm(before), a = norm(after);
        if (b > 0 && dot(before, after) < kLeastCosine * a * b) return false;
        const double longest = std::max(longest_squared(patch.triangles[i]), 1e-300), flatness = a / longest;
        const double height = flatness * std::sqrt(longest);
        if (flatness >= kFlattest || height >= safe_height_) continue;
        if (flatness < b / std::max(longest_squared(old), 1e-300)) return false;
    }
    return true;
}

void CollapseMesh::move(std::int32_t v, const Patch& patch) {
    points_[static_cast<std::size_t>(v)] = patch.triangles[0][0];
    for (std::size_t row = 0; row < patch.bulges.size(); ++row) {
        const std::int32_t f = patch.after[row];
        const std::size_t k = corner_of(face(f), v);
        for (std::size_t i = 0; i < 3; ++i) set_bulge(f, (k + i) % 3, patch.bulges[row][i]);
    }
}

void CollapseMesh::collapse(std::int32_t u, std::int32_t v, const Patch& patch) {
    std::vector<std::int32_t> moved = std::move(at_[static_cast<std::size_t>(u)]);
    at_[static_cast<std::size_t>(u)].clear();
    for (const std::int32_t f : moved) {
        Triangle& t = faces_[static_cast<std::size_t>(f)];
        if (has(t, v)) {
            for (const std::int32_t w : t) std::erase(at_[static_cast<std::size_t>(w)], f);
            t = {-1, -1, -1};
            --alive_;
        } else {
            std::replace(t.begin(), t.end(), u, v);
            at_[static_cast<std::size_t>(v)].push_back(f);
        }
    }
    move(v, patch);
}

std::int32_t CollapseMesh::split(std::int32_t u, std::int32_t v) {
    const auto middle = static_cast<std::int32_t>(points_.size());
    points_.emplace_back();
    at_.emplace_back();
    const std::vector<std::int32_t> at_u = faces_at(u);
    for (const std::int32_t f : at_u) {
        if (!has(face(f), v)) continue;
        std::size_t k = corner_of(face(f), u);
        if (face(f)[(k + 1) % 3] != v) k = (k + 2) % 3;
        const auto [a, b, c] = turned(face(f), k);
        const auto bulges =
            curved() ? turned(bulges_[static_cast<std::size_t>(f)], k) : std::array<Vec3, 3>{};
        const CurvedTriangle surface{{point(a), point(b), point(c)}, bulges};
        Vec3 m = surface.at({0.5, 0.5, 0});
        if (on_mirror(u) && on_mirror(v)) m[mirror_->axis] = mirror_->at;
        const Vec3 half = bulges[0] / 4;
        const Vec3 across = surface.at({0.25, 0.25, 0.5}) - (m + point(c)) * 0.5;
        points_.back() = m;
        const auto other = static_cast<std::int32_t>(faces_.size());
        faces_[static_cast<std::size_t>(f)] = {a, middle, c};
        faces_.push_back({middle, b, c});
        if (curved()) {
            bulges_[static_cast<std::size_t>(f)] = {half, across, bulges[2]};
            bulges_.push_back({half, bulges[1], across});
        }
        at_.back().insert(at_.back().end(), {f, other});
        std::replace(at_[static_cast<std::size_t>(b)].begin(), at_[static_cast<std::size_t>(b)].end(), f,
                     other);
        at_[static_cast<std::size_t>(c)].push_back(other);
        ++alive_;
    }
    return middle;
}

std::vector<std::int32_t> CollapseMesh::vertices_left() const {
    std::vector<std::int32_t> left;
    for (std::size_t v = 0; v < at_.size(); ++v) {
        if (!at_[v].empty()) left.push_back(static_cast<std::int32_t>(v));
    }
    return left;
}

std::vector<std::int32_t> CollapseMesh::faces_left() const {
    std::vector<std::int32_t> left;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
        if (faces_[f][0] >= 0) left.push_back(static_cast<std::int32_t>(f));
    }
    return left;
}

TriangleMesh CollapseMesh::result() const {
    TriangleMesh mesh;
    std::vector<std::int32_t> row(points_.size(), -1);
    for (const std::int32_t f : faces_left()) {
        const Triangle& t = face(f);
        Triangle rows;
        for (std::size_t k = 0; k < 3; ++k) {
            std::int32_t& r = row[static_cast<std::size_t>(t[k])];
            if (r < 0) {
                r = static_cast<std::int32_t>(mesh.vertices.size());
                mesh.vertices.push_back(point(t[k]));
            }
            rows[k] = r;
        }
        mesh.faces.push_back(rows);
    }
    return mesh;
}

}  // namespace pfgeom
