// Closest points of intersections of quadrics by Gauss-Newton: the point closest to the centre on the planes
// tangent at the last one (sequential quadratic programming without curvature).
#include "pfgeom/report/tree_bound_ball.h"

#include "pfgeom/mesh/bvh.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pfgeom {
namespace {

constexpr std::size_t kQuadrics = 7;  // at most so many are combined: 63 intersections
constexpr int kSteps = 6;
constexpr double kAround = 1.0 / 64;  // of the ball: how far from a closest point the other label is sought
constexpr double kLonger = 8;         // then so many times as far, along the way out of a crevice
constexpr double kDamping = 1e-9;

const std::array<Vec3, 26>& directions() {
    static const std::array<Vec3, 26> all = [] {
        std::array<Vec3, 26> list;
        std::size_t n = 0;
        for (int count = 1; count <= 3; ++count)
            for (int k = 0; k < 27; ++k) {
                const Vec3 d{double(k % 3 - 1), double(k / 3 % 3 - 1), double(k / 9 - 1)};
                if (squared_norm(d) == count) list[n++] = normalized(d);
            }
        return list;
    }();
    return all;
}

// Solves the symmetric positive definite system a x = b of the first `size` rows, in place, by elimination.
using Matrix3 = std::array<std::array<double, 3>, 3>;
void solve(Matrix3& a, std::array<double, 3>& b, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i)
        for (std::size_t row = i + 1; row < size; ++row) {
            const double share = a[row][i] / a[i][i];
            for (std::size_t column = i; column < size; ++column) a[row][column] -= share * a[i][column];
            b[row] -= share * b[i];
        }
    for (std::size_t i = size; i-- > 0;) {
        for (std::size_t column = i + 1; column < size; ++column) b[i] -= a[i][column] * b[column];
        b[i] /= a[i][i];
    }
}

// About the point closest to `centre` where all of the quadrics vanish.
Vec3 closest_on(std::span<const Quadric* const> quadrics, const Vec3& centre) {
    const std::size_t size = quadrics.size();
    Vec3 p = centre;
    for (int step = 0; step < kSteps; ++step) {
        std::array<Vec3, 3> gradients;
        std::array<double, 3> weights{};
        for (std::size_t i = 0; i < size; ++i) {
            gradients[i] = quadrics[i]->gradient(p);
            weights[i] = dot(gradients[i], p - centre) - quadrics[i]->value(p);
        }
        Matrix3 products{};
        double trace = 0;
        for (std::size_t i = 0; i < size; ++i) {
            for (std::size_t j = 0; j < size; ++j) products[i][j] = dot(gradients[i], gradients[j]);
            trace += products[i][i];
        }
        if (!(trace > 0)) return p;
        for (std::size_t i = 0; i < size; ++i) products[i][i] += kDamping * trace;
        solve(products, weights, size);
        p = centre;
        for (std::size_t i = 0; i < size; ++i) p += gradients[i] * weights[i];
    }
    return p;
}

// The direction in which the one of the quadrics that rises least rises most; against it they all fall. In a
// crevice between ellipsoids there is hardly another way out. It leads to the point closest to the origin on
// the hull of the unit gradients.
Vec3 common_rise(std::span<const Quadric* const> quadrics, const Vec3& p) {
    std::array<Vec3, 3> g;
    for (std::size_t i = 0; i < 3; ++i)
        g[i] = normalized(quadrics[std::min(i, quadrics.size() - 1)]->gradient(p));
    return normalized(closest_point_on_triangle({}, g[0], g[1], g[2]));
}

std::vector<const Quadric*> quadrics_of(const TreePruner& pruner, const PrunedTree& tree) {
    std::vector<std::int32_t> questions;
    for (const PrunedNode& node : tree) {
        if (node.question < 0) continue;
        if (std::find(questions.begin(), questions.end(), node.question) == questions.end())
            questions.push_back(node.question);
    }
    questions.resize(std::min(questions.size(), kQuadrics));
    std::vector<const Quadric*> quadrics;
    for (const std::int32_t question : questions) quadrics.push_back(&pruner.quadric(question));
    return quadrics;
}

}  // namespace

std::span<const Vec3> spread_directions() {
    return directions();
}

bool label_changes_within(const TreePruner& pruner, const PrunedTree& tree, const Ball& ball,
                          const Vec3& normal) {
    const auto label = [&](const Vec3& offset) {
        return pruner.contains(tree, ball.centre + offset * ball.radius);
    };
    const bool above = label(normal);
    if (label(-normal) != above || label({}) != above) return true;
    return std::any_of(directions().begin(), directions().end(),
                       [&](const Vec3& direction) { return label(direction) != above; });
}

bool label_changes_near_quadrics(const TreePruner& pruner, const PrunedTree& tree, const Ball& ball) {
    const bool label = pruner.contains(tree, ball.centre);
    const auto differs_at = [&](const Vec3& p) { return pruner.contains(tree, p) != label; };
    const auto differs_around = [&](const Vec3& p, const Vec3& along) {
        const double room = ball.radius - norm(p - ball.centre),
                     around = std::min(kAround * ball.radius, room);
        if (!(around > 0)) return false;
        double step = around;
        while (step <= room) {
            if (differs_at(p + along * step) || differs_at(p - along * step)) return true;
            step *= kLonger;
        }
        return std::any_of(directions().begin(), directions().end(),
                           [&](const Vec3& direction) { return differs_at(p + direction * around); });
    };
    const std::vector<const Quadric*> all = quadrics_of(pruner, tree);
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = i; j < all.size(); ++j)
            for (std::size_t k = j; k < all.size(); ++k) {
                if (i == j && j != k) continue;
                const std::array<const Quadric*, 3> chosen{all[i], all[j == i ? k : j], all[k]};
                const std::size_t size = i == k ? 1 : j == k ? 2 : 3;
                const Vec3 p = closest_on(std::span(chosen).first(size), ball.centre);
                if (differs_around(p, common_rise(std::span(chosen).first(size), p))) return true;
            }
    return false;
}

}  // namespace pfgeom
