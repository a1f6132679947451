#include "pfgeom/mesh/mesh_builder.h"

#include "pfgeom/base/error.h"
#include "pfgeom/base/limits.h"
#include "pfgeom/mesh/triangulate.h"

#include <algorithm>
#include <utility>

namespace pfgeom {
namespace {

// Ear clipping is quadratic. This many tests take some two seconds; a file that asks for more keeps the fans
// of its remaining concave polygons.
constexpr std::int64_t kTestsPerFile = 1'000'000'000;

[[noreturn]] void fail(const Place& place, const std::string& what) {
    throw InvalidInput(std::string(place.unit) + " " + std::to_string(place.number) + ": " + what);
}

}  // namespace

void MeshBuilder::add_polygon(std::span<const std::int64_t> corners, const Place& place) {
    if (corners.empty()) return;
    const auto [lowest, highest] = std::minmax_element(corners.begin(), corners.end());
    if (*lowest < 0) fail(place, "vertex index " + std::to_string(*lowest) + " is below the first");
    if (*highest > highest_) {
        if (*highest >= static_cast<std::int64_t>(Limits{}.vertices))
            fail(place, "vertex index " + std::to_string(*highest) + " is above the limit of vertices");
        highest_ = *highest;
        highest_place_ = place;
    }

    const auto corner = [&](std::size_t i) {
        return static_cast<std::int32_t>(corners[std::min(i, corners.size() - 1)]);
    };
    if (corners.size() > 3) fans_.push_back({mesh_.faces.size(), corners.size()});
    mesh_.faces.push_back({corner(0), corner(1), corner(2)});
    for (std::size_t i = 3; i < corners.size(); ++i)
        mesh_.faces.push_back({corner(0), corner(i - 1), corner(i)});
}

TriangleMesh MeshBuilder::finish() {
    if (mesh_.vertices.size() > Limits{}.vertices)
        throw InvalidInput("the file has more vertices than the limit");
    if (mesh_.faces.size() > Limits{}.faces) throw InvalidInput("the file has more faces than the limit");
    if (highest_ >= vertex_count())
        fail(highest_place_, "row " + std::to_string(highest_) + " of the vertices is asked for, there are " +
                                 std::to_string(vertex_count()) + " rows (from 0)");
    std::int64_t budget = kTestsPerFile;
    for (const Fan& fan : fans_) triangulate(fan, budget);
    return std::move(mesh_);
}

void MeshBuilder::triangulate(const Fan& fan, std::int64_t& budget) {
    std::vector<std::int32_t> corners{mesh_.faces[fan.first][0], mesh_.faces[fan.first][1]};
    for (std::size_t i = 0; i + 2 < fan.corners; ++i) corners.push_back(mesh_.faces[fan.first + i][2]);
    const std::vector<Triangle> faces = triangulate_polygon(mesh_.vertices, corners, budget);
    std::copy(faces.begin(), faces.end(), mesh_.faces.begin() + static_cast<std::ptrdiff_t>(fan.first));
}

}  // namespace pfgeom
