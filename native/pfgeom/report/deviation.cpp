#include "pfgeom/report/deviation.h"

#include "pfgeom/base/error.h"
#include "pfgeom/report/distance_bound.h"
#include "pfgeom/report/quadrature.h"

#include <optional>
#include <string>

namespace pfgeom {
namespace {

// Distances below this share of the largest coordinate are rounding: two equal surfaces are not searched for
// ever.
constexpr double kResolution = 1e-12;

// Of the first mesh's diagonal. A crease that turns by 2a, rounded within t, changes normals as far as
// t sin(a) / (1 - cos(a)) from it: 2.4 t at a right angle, 5 t at 45 degrees; t is 1e-3 by default.
constexpr double kCreaseReach = 5e-3;

// Squares of coordinates must not overflow.
constexpr double kLargestCoordinate = 1e150;

bool is_measurable(const Vec3& p) {
    const Vec3 size = max(p, -p);
    return size.x < kLargestCoordinate && size.y < kLargestCoordinate && size.z < kLargestCoordinate;
}

void check_measurable(const TriangleMesh& mesh, const std::string& name) {
    if (mesh.faces.empty()) throw InvalidInput("the " + name + " mesh has no faces");
    for (const Triangle& face : mesh.faces) {
        for (const std::int32_t v : face) {
            if (is_measurable(mesh.vertices[v])) continue;
            const std::string row = "vertex " + std::to_string(v) + " of the " + name + " mesh";
            throw InvalidInput(row + " is not finite or beyond 1e150");
        }
    }
}

double resolution_of(const TriangleMesh& a, const TriangleMesh& b) {
    Box box = bounds(a);
    box.grow(bounds(b));
    return kResolution * norm(max(box.hi, -box.lo));
}

bool is_closed(const OneSided& side, const DistanceBoundOptions& options) {
    if (options.certify_below > 0) return side.max_bound <= options.certify_below;
    return side.max_bound <= std::max((1 + options.gap) * side.max, options.resolution);
}

NormalAngles worse(const NormalAngles& a, const NormalAngles& b) {
    return {std::max(a.mean, b.mean), std::max(a.p99, b.p99), std::max(a.max, b.max)};
}

OneSided measure_side(const TriangleMesh& from, const TriangleMesh& to, const Bvh& to_bvh,
                      const CreaseZone& creases, const DeviationOptions& options,
                      const DistanceBoundOptions& bound_options, const Task& task) {
    OneSided side;
    DistanceBound known;
    if (options.samples > 0) {
        const DistanceMeans means =
            mean_distances(from, to, to_bvh, creases, options.samples, options.seed, task);
        side.rms = means.rms;
        side.mean = means.mean;
        side.p99 = means.p99;
        side.normals = means.normals;
        side.smooth_normals = means.smooth_normals;
        known.max = means.max;
        known.worst = means.worst;
    }
    const DistanceBound bound = bound_distance(from, to, to_bvh, known, bound_options, task);
    side.max = bound.max;
    side.max_bound = bound.bound;
    side.worst = bound.worst;
    return side;
}

}  // namespace

double Deviation::max() const {
    return std::max(a_to_b.max, b_to_a.max);
}
double Deviation::max_bound() const {
    return std::max(a_to_b.max_bound, b_to_a.max_bound);
}
double Deviation::rms() const {
    return std::max(a_to_b.rms, b_to_a.rms);
}
double Deviation::mean() const {
    return std::max(a_to_b.mean, b_to_a.mean);
}
double Deviation::p99() const {
    return std::max(a_to_b.p99, b_to_a.p99);
}
NormalAngles Deviation::normals() const {
    return worse(a_to_b.normals, b_to_a.normals);
}
NormalAngles Deviation::smooth_normals() const {
    return worse(a_to_b.smooth_normals, b_to_a.smooth_normals);
}

Deviation measure_deviation(const TriangleMesh& a, const Bvh& bvh_a, const TriangleMesh& b, const Bvh& bvh_b,
                            const DeviationOptions& options, const Task& task) {
    check_measurable(a, "first");
    check_measurable(b, "second");
    DistanceBoundOptions bound_options;
    bound_options.refine = options.bound;
    bound_options.gap = options.gap;
    bound_options.certify_below = options.certify_below;
    bound_options.resolution = resolution_of(a, b);
    bound_options.work = options.work / 2;

    Deviation deviation;
    task.report(0, "measure");
    std::optional<Creases> creases;
    if (options.smooth_normals && options.samples > 0) creases.emplace(a, task);
    const CreaseZone zone{creases ? &*creases : nullptr, kCreaseReach * bounds(a).diagonal()};
    deviation.a_to_b = measure_side(a, b, bvh_b, zone, options, bound_options, task);
    const bool a_closed = is_closed(deviation.a_to_b, bound_options);
    // Nothing is left to certify once one side is refuted.
    if (options.certify_below > 0 && !a_closed) bound_options.refine = false;
    task.report(0.5, "measure");
    deviation.b_to_a = measure_side(b, a, bvh_a, zone, options, bound_options, task);
    deviation.certified = a_closed && is_closed(deviation.b_to_a, bound_options);
    task.report(1, "measure");
    return deviation;
}

Deviation measure_deviation(const TriangleMesh& a, const TriangleMesh& b, const DeviationOptions& options,
                            const Task& task) {
    return measure_deviation(a, Bvh(a, task), b, Bvh(b, task), options, task);
}

}  // namespace pfgeom
