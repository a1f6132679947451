#include "pfgeom/fit/mend_patches.h"

#include "pfgeom/base/sort_unique.h"
#include "pfgeom/fit/bulge_grid.h"
#include "pfgeom/fit/grid.h"
#include "pfgeom/fit/missed_points.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>

namespace pfgeom {
namespace {

// One round most often mends what samples missed (os-plane at 1e-3: 53 points and 2 edges), but three edges
// of rocker-arm were left after four: from the third on what is left is divided.
constexpr std::size_t kRounds = 6, kPatience = 2;
// What has become more by dividing will go on so (halves of teapot at 2e-4 that differ by more than their
// mirror allows: 17, 26, 38, 67, 104 vertices, at twice the time each). And what is wrong all over the mesh,
// at one vertex for so many faces, is not mended one by one.
constexpr std::size_t kFaces = 8, kFew = 20;
// What is mended may use this share of the limits, which leaves some to the steps of the bulges; in the end
// curved faces may be over them by so much, which the reserve for chords of the default mesh holds.
constexpr double kShare = 0.99, kInTheEnd = 1.03;

EdgeEnds longest_edge(const CollapseMesh& mesh, std::int32_t face) {
    const auto corners = mesh.corners(face);
    std::size_t longest = 0;
    const auto squared = [&](std::size_t k) { return squared_norm(corners[(k + 1) % 3] - corners[k]); };
    for (const std::size_t k : {std::size_t{1}, std::size_t{2}}) {
        if (squared(k) > squared(longest)) longest = k;
    }
    return {mesh.face(face)[longest], mesh.face(face)[(longest + 1) % 3]};
}

std::vector<std::int32_t> faces_of(const std::vector<MissedPoint>& missed) {
    std::vector<std::int32_t> faces;
    for (const MissedPoint& m : missed) faces.push_back(m.face);
    sort_unique(faces);
    return faces;
}

// At the ends of the edges and the corners of the faces.
std::vector<std::int32_t> vertices_of(const CollapseMesh& mesh, const std::vector<EdgeEnds>& edges,
                                      const std::vector<std::int32_t>& faces) {
    std::vector<std::int32_t> vertices;
    for (const EdgeEnds& ends : edges) vertices.insert(vertices.end(), ends.begin(), ends.end());
    for (const std::int32_t f : faces) {
        const Triangle& t = mesh.face(f);
        vertices.insert(vertices.end(), t.begin(), t.end());
    }
    sort_unique(vertices);
    return vertices;
}

// Not two edges of one face: the second may be gone.
void divide(CollapseMesh& mesh, CollapseError& error, const std::vector<EdgeEnds>& edges) {
    std::vector<std::int32_t> touched;
    Patch patch;
    for (const auto& [u, v] : edges) {
        std::vector<std::int32_t> around;
        for (const std::int32_t f : mesh.faces_at(u)) {
            const Triangle& t = mesh.face(f);
            if (std::find(t.begin(), t.end(), v) != t.end()) around.push_back(f);
        }
        const bool again = std::any_of(around.begin(), around.end(), [&](std::int32_t f) {
            return std::find(touched.begin(), touched.end(), f) != touched.end();
        });
        if (again || around.empty()) continue;
        const std::int32_t middle = mesh.split(u, v);
        error.make_room(mesh);
        mesh.patch_of_move(middle, error.placed(mesh.point(middle)), patch);
        Patch fitted = patch;
        if (patch.curved())
            error.refit(fitted, true);
        else
            fitted.move_to(error.placed(error.fitted(patch)));
        const double plain = error.forward(patch, std::numeric_limits<double>::infinity());
        if (mesh.keeps_orientation(fitted) && error.forward(fitted, plain) < plain) patch = std::move(fitted);
        error.commit(patch);
        mesh.move(middle, patch);
        touched.insert(touched.end(), patch.after.begin(), patch.after.end());
    }
}

EdgeEnds longest_edge_at(const CollapseMesh& mesh, std::int32_t v) {
    const std::vector<std::int32_t> ends = mesh.neighbours(v);
    const auto squared = [&](std::int32_t w) { return squared_norm(mesh.point(w) - mesh.point(v)); };
    return {v, *std::ranges::max_element(ends, {}, squared)};
}

CollapseLimits share_of(CollapseLimits limits, double share) {
    limits.forward *= share;
    limits.backward *= share;
    return limits;
}

}  // namespace

MendedPart mended_part(const TriangleMesh& original, CollapseMesh& mesh, CollapseError& error,
                       const CollapseLimits& limits, const Grid& grid, int bulge_code, const Task& task) {
    const bool by_max = limits.metric == Metric::max;
    const CollapseLimits within = share_of(limits, kShare);
    std::vector<std::int32_t> open;
    MendedPart best{{}, SIZE_MAX};  // dividing can make things worse
    if (by_max && !mesh.curved()) {
        error.look(kScrutiny);
        open = mend_vertices(mesh, error, within, grid, vertices_over(mesh, error, limits, task), task);
    }
    for (std::size_t round = 0;; ++round) {
        Object object = part_on_grid(mesh.result(), grid);
        std::vector<EdgeEnds> edges;
        if (mesh.curved()) {
            auto& part = std::get<MeshPart>(object.shape);
            part.bulge_code = bulge_code;
            edges = snap_bulges(mesh, error, limits, grid.frame, part, round > 0, task);
        } else {
            for (const std::int32_t v : open) edges.push_back(longest_edge_at(mesh, v));
        }
        if (!by_max) return {std::move(object), 0};
        const std::vector<MissedPoint> missed = missed_points(original, mesh, limits.forward, task);
        const std::vector<std::int32_t> faces = faces_of(missed);
        std::vector<std::int32_t> vertices = vertices_of(mesh, edges, faces);
        const std::size_t wrong = vertices.size();
        const bool hopeless =
            wrong > kFew + mesh.face_count() / kFaces || (round > kPatience && wrong > best.wrong);
        if (wrong <= best.wrong) best = {std::move(object), wrong};
        if (hopeless || round == kRounds) return best;
        if (wrong == 0) {  // bulges were looked at less closely
            if (!mesh.curved()) return best;
            error.look(kScrutiny);
            vertices = vertices_over(mesh, error, share_of(limits, kInTheEnd), task);
            if (vertices.empty()) return best;
        }
        error.add(missed);
        if (round >= kPatience) {
            for (const std::int32_t f : faces) edges.push_back(longest_edge(mesh, f));
            divide(mesh, error, edges);
        }
        open = mend_vertices(mesh, error, within, grid, std::move(vertices), task);
        if (mesh.curved()) error.look(kLook);
    }
}

}  // namespace pfgeom
