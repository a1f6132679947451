// Source: Vyatkin, Dolgovesov, "Compression of Geometric Data with the Use of Perturbation Functions", 2018:
// the deviation as the difference of depth buffers. Departures: orthographic views, and what lies at depth
// discontinuities, where the smallest deviation makes the largest difference, is told apart.
#include "pfgeom/render/depth_buffers.h"

#include "pfgeom/base/error.h"
#include "pfgeom/base/parallel.h"
#include "pfgeom/render/camera.h"
#include "pfgeom/render/tiles.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pfgeom {
namespace {

constexpr std::size_t kReach = 2;  // pixels around a discontinuity
constexpr double kJump = 2;        // pixels' sides: see DepthFigures
constexpr double kTolerances = 3;  // a larger difference counts

using Depths = std::vector<double>;      // a pixel, row by row from the top; infinity: nothing
using Mask = std::vector<std::uint8_t>;  // likewise

std::vector<Vec3> directions() {
    std::vector<Vec3> all;
    for (int axis = 0; axis < 3; ++axis) {
        for (const double sign : {-1.0, 1.0}) {
            Vec3 along;
            along[axis] = sign;
            all.push_back(along);
        }
    }
    for (unsigned i = 0; i < 8; ++i)
        all.push_back(
            normalized({(i & 1U) != 0 ? 1.0 : -1.0, (i & 2U) != 0 ? 1.0 : -1.0, (i & 4U) != 0 ? 1.0 : -1.0}));
    return all;
}

Depths draw(const RayScene& scene, const std::vector<Box>& cover, const Camera& camera, int side,
            const Task& task) {
    const auto width = static_cast<std::size_t>(side);
    Depths depths(width * width, Box::kInf);
    const std::vector<Tile> tiles = tiles_showing(cover, camera, {side, side});
    parallel_chunks(tiles.size(), 1, task, [&](std::size_t i, std::size_t) {
        const Tile& tile = tiles[i];
        for (int y = tile.top; y < tile.bottom; ++y) {
            task.check();
            for (int x = tile.left; x < tile.right; ++x) {
                const Ray ray = camera.ray(2 * (x + 0.5) / side - 1, 1 - 2 * (y + 0.5) / side);
                depths[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)] =
                    scene.first_hit(ray).t;
            }
        }
    });
    return depths;
}

template <class Visit>
void for_pixels(std::size_t side, const Task& task, Visit visit) {
    for (std::size_t y = 0; y < side; ++y) {
        task.check();
        for (std::size_t x = 0; x < side; ++x) visit(x, y, y * side + x);
    }
}

// Both pixels of each pair of neighbours in a row or a column that a jump parts.
Mask discontinuities(const Depths& depths, std::size_t side, double jump, const Task& task) {
    Mask found(depths.size(), 0);
    const auto compare = [&](std::size_t i, std::size_t j) {
        // Not a number where neither is covered, infinity where one is.
        if (std::abs(depths[i] - depths[j]) > jump) found[i] = found[j] = 1;
    };
    for_pixels(side, task, [&](std::size_t x, std::size_t y, std::size_t i) {
        if (x + 1 < side) compare(i, i + 1);
        if (y + 1 < side) compare(i, i + side);
    });
    return found;
}

// The pixels up to kReach from those of the mask, along rows or along columns.
Mask widened(const Mask& mask, std::size_t side, bool along_rows, const Task& task) {
    Mask wide(mask.size(), 0);
    const std::size_t step = along_rows ? 1 : side;
    for_pixels(side, task, [&](std::size_t x, std::size_t y, std::size_t i) {
        if (mask[i] == 0) return;
        const std::size_t place = along_rows ? x : y, line = i - place * step;
        const std::size_t end = std::min(place + kReach + 1, side);
        for (std::size_t k = place - std::min(place, kReach); k < end; ++k) wide[line + k * step] = 1;
    });
    return wide;
}

Mask near_discontinuities(const Depths& depths, std::size_t side, double jump, const Task& task) {
    const Mask found = discontinuities(depths, side, jump, task);
    return widened(widened(found, side, true, task), side, false, task);
}

void count_both(DepthFigures& figures, double difference, bool away, double limit) {
    ++figures.both;
    figures.sum += difference;
    figures.max = std::max(figures.max, difference);
    if (difference > limit) ++figures.differing;
    if (!away) return;
    ++figures.away;
    figures.away_sum += difference;
    figures.away_max = std::max(figures.away_max, difference);
    if (difference > limit) ++figures.differing_away;
}

DepthFigures compare(const Depths& a, const Depths& b, std::size_t side, double jump, double limit,
                     const Task& task) {
    const Mask near_a = near_discontinuities(a, side, jump, task);
    const Mask near_b = near_discontinuities(b, side, jump, task);
    DepthFigures figures;
    for_pixels(side, task, [&](std::size_t, std::size_t, std::size_t i) {
        const bool in_a = a[i] < Box::kInf, in_b = b[i] < Box::kInf;
        const bool away = (near_a[i] & near_b[i]) == 0;
        if (in_a && in_b) count_both(figures, std::abs(a[i] - b[i]), away, limit);
        if (in_a == in_b) return;
        ++(in_a ? figures.only_a : figures.only_b);
        if (away) ++figures.silhouette_away;
    });
    return figures;
}

}  // namespace

DepthFigures& DepthFigures::operator+=(const DepthFigures& other) {
    both += other.both, only_a += other.only_a, only_b += other.only_b;
    sum += other.sum, max = std::max(max, other.max);
    away += other.away;
    away_sum += other.away_sum, away_max = std::max(away_max, other.away_max);
    differing += other.differing, differing_away += other.differing_away;
    silhouette_away += other.silhouette_away;
    return *this;
}

DepthComparison compare_depths(const RayScene& a, const RayScene& b, const DepthOptions& options,
                               const Task& task) {
    if (!(options.tolerance > 0)) throw InvalidInput("the tolerance of depth buffers must be positive");
    const std::vector<Box> cover_a = a.cover(), cover_b = b.cover();
    std::vector<Box> cover = cover_a;
    cover.insert(cover.end(), cover_b.begin(), cover_b.end());
    DepthComparison comparison;
    const std::vector<Vec3> all = directions();
    for (const Vec3& direction : all) {
        task.report(static_cast<double>(comparison.views.size()) / static_cast<double>(all.size()),
                    "depth buffers");
        const Vec3 up = direction.x == 0 && direction.y == 0 ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
        const Camera camera = fit_camera(cover, {direction, up, 0}, {options.side, options.side});
        const double pixel = 2 * norm(camera.right) / options.side;
        const Depths depths_a = draw(a, cover_a, camera, options.side, task);
        const Depths depths_b = draw(b, cover_b, camera, options.side, task);
        const DepthFigures figures = compare(depths_a, depths_b, static_cast<std::size_t>(options.side),
                                             kJump * pixel, kTolerances * options.tolerance, task);
        comparison.views.push_back({direction, pixel, figures});
        comparison.total += figures;
    }
    task.report(1, "depth buffers");
    return comparison;
}

}  // namespace pfgeom
