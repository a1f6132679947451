#include "arrays.h"
#include "bindings.h"
#include "job.h"
#include "pfgeom/base/parallel.h"
#include "pfgeom/mesh/bvh.h"
#include "pfgeom/mesh/signed_distance.h"

#include <cmath>
#include <limits>
#include <vector>

namespace py = pybind11;

namespace pfgeom::bindings {
namespace {

/// Points a chunk: some milliseconds of work.
constexpr std::size_t kChunk = 1024;
/// Points between two reports of progress: some hundred milliseconds.
constexpr std::size_t kBlock = 64 * kChunk;

struct Closest {
    std::vector<Vec3> points;
    std::vector<std::int32_t> faces;
    std::vector<double> distances;
};

/// The closest points of the mesh to queries [begin, end). A point that is not finite has none.
void find_closest(const Bvh& bvh, const std::vector<Vec3>& queries, std::size_t begin, std::size_t end,
                  Closest& found) {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    std::int32_t hint =
        -1;  // the answer of the query before, which often lies near; it changes the speed only
    for (std::size_t i = begin; i < end; ++i) {
        if (!is_finite(queries[i])) {
            found.points[i] = {kNaN, kNaN, kNaN};
            found.distances[i] = kNaN;
            continue;
        }
        const ClosestPoint closest = bvh.closest(queries[i], std::numeric_limits<double>::infinity(), hint);
        found.points[i] = closest.point;
        found.faces[i] = hint = closest.face;
        found.distances[i] = std::sqrt(closest.squared_distance);
    }
}

Closest find_all(const TriangleMesh& mesh, const std::vector<Vec3>& queries, const Task& task) {
    task.report(0, "searching");
    const Bvh bvh(mesh, quiet(task, task.threads));
    Closest found{std::vector<Vec3>(queries.size()), std::vector<std::int32_t>(queries.size(), -1),
                  std::vector<double>(queries.size())};
    for (std::size_t first = 0; first < queries.size(); first += kBlock) {
        const std::size_t count = std::min(kBlock, queries.size() - first);
        parallel_chunks(count, kChunk, task, [&](std::size_t begin, std::size_t end) {
            find_closest(bvh, queries, first + begin, first + end, found);
        });
        task.report(static_cast<double>(first + count) / static_cast<double>(queries.size()), "searching");
    }
    return found;
}

/// From the closest points: > 0 where the normal at the closest point looks to.
std::vector<double> signed_distances(const TriangleMesh& mesh, const std::vector<Vec3>& queries,
                                     const Task& task) {
    const Bvh bvh(mesh, quiet(task, task.threads));
    const SignedDistance sides(mesh, bvh);
    std::vector<double> distances(queries.size());
    for (std::size_t first = 0; first < queries.size(); first += kBlock) {
        const std::size_t count = std::min(kBlock, queries.size() - first);
        parallel_chunks(count, kChunk, task, [&](std::size_t begin, std::size_t end) {
            std::int32_t hint = -1;
            for (std::size_t i = first + begin; i < first + end; ++i) {
                const SignedClosest closest = sides(queries[i], hint);
                hint = closest.face;
                distances[i] = -closest.distance;
            }
        });
        task.report(static_cast<double>(first + count) / static_cast<double>(queries.size()), "searching");
    }
    return distances;
}

py::array signed_array(const Points& points, const Points& vertices, const Indices& faces, int threads,
                       py::object progress, const CancelToken* cancel) {
    const auto mesh = std::make_shared<const TriangleMesh>(mesh_from(vertices, faces));
    Job job(threads, std::move(progress), cancel);
    std::vector<double> distances = job.run([=, queries = points_from(points)](const Task& task) {
        return signed_distances(*mesh, queries, task);
    });
    const auto count = static_cast<py::ssize_t>(distances.size());
    return array_of<double>(std::move(distances), {count});
}

py::tuple closest_arrays(const Points& points, const Points& vertices, const Indices& faces, int threads,
                         py::object progress, const CancelToken* cancel) {
    const auto mesh = std::make_shared<const TriangleMesh>(mesh_from(vertices, faces));
    Job job(threads, std::move(progress), cancel);
    Closest found = job.run(
        [=, queries = points_from(points)](const Task& task) { return find_all(*mesh, queries, task); });
    const auto count = static_cast<py::ssize_t>(found.faces.size());
    return py::make_tuple(array_from<double>(std::move(found.points)),
                          py::array_t<std::int32_t>(count, found.faces.data()),
                          py::array_t<double>(count, found.distances.data()));
}

}  // namespace

void bind_distance(py::module_& m) {
    m.def("closest_points", &closest_arrays, py::arg("points").noconvert(), py::arg("vertices").noconvert(),
          py::arg("faces").noconvert(), py::arg("threads"), py::arg("progress"), py::arg("cancel"));
    m.def("signed_distances", &signed_array, py::arg("points").noconvert(), py::arg("vertices").noconvert(),
          py::arg("faces").noconvert(), py::arg("threads"), py::arg("progress"), py::arg("cancel"));
}

}  // namespace pfgeom::bindings
