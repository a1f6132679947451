#include "pfgeom/segment/region_set.h"

#include "pfgeom/base/parallel.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pfgeom {
namespace {

// Normals count like distances of the tolerance times their difference: enough to fix the scale and to refuse
// double planes. Sixteen times as much pulls ellipsoids, whose gradients are not of one length, towards
// spheres: 435 regions instead of 124 on a union of 83 ellipsoids, 105 instead of 75 on a printed part.
constexpr double kNormalReach = 1;
// The largest error of a region is rarely below 1.8 times its root mean square, so that more is not worth a
// look.
constexpr double kMostRms = 1 / 1.8;
constexpr double kCostSteps = 1000;  // of the error, to the tolerance; 64: a tenth more regions
constexpr double kAlignment = 100;   // tolerances for a misalignment of one; 0.05: a fifth more regions

// Lawson's weights, "Contributions to the theory of linear least maximum approximation", 1961: the error
// times the weight so far, with a floor so that no face is lost.
constexpr int kRefineRounds = 8;
constexpr double kWeightFloor = 0.2;
constexpr double kRefinable = 1.6;         // tolerances: what rounds of weighting can mend
constexpr std::size_t kMostRefined = 400;  // faces that are weighted; all are checked

double face_error(const TriangleMesh& mesh, std::int32_t face, const Quadric& q) {
    double worst = 0;
    for (const Vec3& p : check_points(mesh, face)) worst = std::max(worst, surface_distance(q, p));
    return worst;
}

// The Frobenius norm of the second derivatives, no less than any of them along a line.
double bend(const Quadric& q) {
    const auto& [a, b, c, d, e, f, g, h, i, k] = q.c;
    return std::sqrt(4 * (a * a + b * b + c * c) + 2 * (d * d + e * e + f * f));
}

}  // namespace

double surface_distance(const Quadric& q, const Vec3& p) {
    const double value = std::abs(q.value(p)), slope = norm(q.gradient(p));
    if (!(value > 0)) return 0;
    return 2 * value / (slope + std::sqrt(slope * slope + 2 * bend(q) * value));
}

bool within(const Quadric& q, const Vec3& p, double distance) {
    const double rest = std::abs(q.value(p)) - bend(q) * distance * distance / 2;
    return rest <= 0 || rest * rest <= distance * distance * squared_norm(q.gradient(p));
}

std::array<Vec3, 7> check_points(const TriangleMesh& mesh, std::int32_t face) {
    const auto& [i, j, k] = mesh.faces[face];
    const Vec3 &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
    return {a, b, c, (a + b) * 0.5, (b + c) * 0.5, (c + a) * 0.5, (a + b + c) / 3};
}

RegionSet::RegionSet(const TriangleMesh& mesh, double tolerance, double most_misalignment)
    : mesh_(mesh), tolerance_(tolerance), most_misalignment_(most_misalignment), regions_(mesh.faces.size()) {
    const double reach = kNormalReach * tolerance;
    normal_weight_ = reach * reach;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        const auto& [i, j, k] = mesh.faces[f];
        regions_[f].faces = {static_cast<std::int32_t>(f)};
        regions_[f].sums.add_triangle(mesh.vertices[i], mesh.vertices[j], mesh.vertices[k]);
        regions_[f].area = regions_[f].sums.weight();
    }
}

std::optional<double> RegionSet::cost(std::int32_t a, std::int32_t b) const {
    if (regions_[a].whole || regions_[b].whole) return {};
    PowerSums sums = regions_[a].sums;
    sums += regions_[b].sums;
    const QuadricSystem system = sums.system();
    const FitQuality fit = system.quality(system.solve(normal_weight_));
    if (!(fit.rms <= tolerance_ * kMostRms && fit.misalignment <= most_misalignment_)) return {};
    return std::floor(kCostSteps * (fit.rms / tolerance_ + kAlignment * fit.misalignment));
}

bool RegionSet::serves(const Quadric& q, const Region& region) const {
    return std::ranges::all_of(region.faces, [&](std::int32_t f) {
        return std::ranges::all_of(check_points(mesh_, f),
                                   [&](const Vec3& p) { return within(q, p, tolerance_); });
    });
}

double RegionSet::worst_error(const Quadric& q, const Region& region) const {
    double worst = 0;
    for (const std::int32_t f : region.faces) worst = std::max(worst, face_error(mesh_, f, q));
    return worst;
}

// Weights faces by their error until the worst is no more than `enough`, or for some rounds; keeps the best.
// With the weights in its sums, the region's least squares give the better quadric from now on.
void RegionSet::refine(Region& region, double enough) const {
    const std::size_t stride = (region.faces.size() + kMostRefined - 1) / kMostRefined;
    std::vector<std::int32_t> faces;
    for (std::size_t i = 0; i < region.faces.size(); i += stride) faces.push_back(region.faces[i]);
    std::vector<double> weights(faces.size(), 1);
    double best = worst_error(region.quadric, region);
    Quadric q = region.quadric;
    for (int round = 0; round < kRefineRounds && best > enough; ++round) {
        double worst = 0;
        std::vector<double> errors;
        for (const std::int32_t f : faces) errors.push_back(face_error(mesh_, f, q));
        for (const double e : errors) worst = std::max(worst, e);
        if (!(worst > 0)) return;
        PowerSums sums;
        for (std::size_t i = 0; i < faces.size(); ++i) {
            weights[i] *= kWeightFloor + errors[i] / worst;
            const auto& [a, b, c] = mesh_.faces[faces[i]];
            sums.add_triangle(mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c], weights[i]);
        }
        q = sums.system().solve(normal_weight_);
        const double error = worst_error(q, region);
        if (error >= best) continue;
        best = error;
        region.quadric = q;
        region.sums = sums *= region.area / sums.weight();
    }
}

bool RegionSet::merge(std::int32_t a, std::int32_t b, bool refined) {
    Region &large = regions_[size(a) >= size(b) ? a : b], &small = regions_[size(a) >= size(b) ? b : a];
    Region merged;
    merged.area = large.area + small.area;
    merged.sums = large.sums;
    merged.sums += small.sums;
    merged.quadric = merged.sums.system().solve(normal_weight_);
    const bool served = serves(merged.quadric, small) && serves(merged.quadric, large);
    if (!served) {
        const auto near = [&](const Region& r) {
            return worst_error(merged.quadric, r) <= kRefinable * tolerance_;
        };
        if (!refined || !near(small) || !near(large)) return false;
    }
    merged.faces = served ? std::move(large.faces) : large.faces;
    merged.faces.insert(merged.faces.end(), small.faces.begin(), small.faces.end());
    if (!served) {
        refine(merged, tolerance_);
        if (!serves(merged.quadric, merged)) return false;
    }
    small = large = {};
    regions_[std::min(a, b)] = std::move(merged);
    return true;
}

void RegionSet::refine_all(const Task& task) {
    parallel_chunks(regions_.size(), 64, task, [&](std::size_t begin, std::size_t end) {
        for (std::size_t r = begin; r < end; ++r) {
            if (regions_[r].faces.size() < 2) continue;
            task.check();
            refine(regions_[r], 0);
        }
    });
}

Region RegionSet::sum_of(const std::vector<std::int32_t>& faces) const {
    Region sum;
    sum.faces = faces;
    for (const std::int32_t f : faces) {
        sum.sums += regions_[f].sums;
        sum.area += regions_[f].area;
    }
    sum.quadric = sum.sums.system().solve(normal_weight_);
    return sum;
}

bool RegionSet::unite(const std::vector<std::int32_t>& faces) {
    Region all = sum_of(faces);
    if (!serves(all.quadric, all)) return false;
    for (const std::int32_t f : faces) regions_[f] = {};
    regions_[faces[0]] = std::move(all);
    return true;
}

void RegionSet::unite(const WholeQuadric& whole) {
    Region all = sum_of(whole.faces);
    if (!serves(all.quadric, all)) all.quadric = whole.quadric;
    all.whole = true;
    all.hidden = whole.hidden;
    for (const std::int32_t f : whole.faces) regions_[f] = {};
    regions_[whole.faces[0]] = std::move(all);
}

std::vector<Region> RegionSet::take() {
    std::vector<Region> result;
    for (Region& region : regions_) {
        if (region.faces.empty()) continue;
        if (region.faces.size() == 1) region.quadric = region.sums.system().solve(normal_weight_);
        std::ranges::sort(region.faces);
        result.push_back(std::move(region));
    }
    regions_.clear();
    std::ranges::stable_sort(result, [](const Region& x, const Region& y) { return x.area > y.area; });
    return result;
}

}  // namespace pfgeom
