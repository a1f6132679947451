// Where a ray changes sides in the tree, exactly one question changes its answer: that is whose surface it
// is. An area follows from the counts by Crofton's formula: a patch with the unit normal n is met by
// (|n_x| + |n_y| + |n_z|) / d² rays of distance d an area. Source: Santaló, "Integral Geometry and Geometric
// Probability", 1976. Departure: three fixed directions and the known normal instead of random directions.
#include "pfgeom/eval/tree_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace pfgeom {
namespace {

constexpr std::size_t kFew = 40;  // points of a patch
constexpr int kFiner = 4;         // for quadrics that were not met
constexpr int kLocalSteps = 24;
constexpr double kPlace = 0.4871;    // of a ray in its square: not where cuts, or symmetric parts, have edges
constexpr double kTouching = 1e-9;   // in the cube; what rounding makes of a double root is shorter
constexpr double kMostVisits = 3e8;  // of nodes by rays; a printed part of 571 nodes takes a fifth at most
constexpr double kMargin = 0.25;     // around what is known of a patch, of its size

// Along a ray: p + t e_axis.
struct Ray {
    Vec3 from;
    int axis = 0;
    Vec3 at(double t) const {
        Vec3 p = from;
        p[axis] = t;
        return p;
    }
};

// A change of sides at t; `question`: the node that is responsible.
struct Side {
    double begin = 0;
    bool inside = false;
    std::int32_t question = -1;  // that changes its answer where this side begins
};

// Rising. Where the ray touches the surface it stays on its side.
int roots_on_ray(const Quadric& q, const Ray& ray, std::array<double, 2>& roots) {
    const Vec3 origin = ray.at(0);
    const double a = q.c[static_cast<std::size_t>(ray.axis)];
    const double b = q.gradient(origin)[ray.axis], c = q.value(origin);
    const double discriminant = b * b - 4 * a * c;
    if (discriminant < 0) return 0;
    const double s = -(b + (b < 0 ? -1 : 1) * std::sqrt(discriminant)) / 2;  // no cancellation
    int count = 0;
    if (a != 0) roots[static_cast<std::size_t>(count++)] = s / a;
    if (s != 0) roots[static_cast<std::size_t>(count++)] = c / s;
    if (count == 2 && roots[0] > roots[1]) std::swap(roots[0], roots[1]);
    return count == 2 && !(roots[1] - roots[0] > kTouching) ? 0 : count;
}

// steps² rays along each axis: shoot(ray, the area across it that it stands for).
template <class Shoot>
void shoot_rays(const Box& window, int steps, const Task& task, Shoot shoot) {
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const double du = window.extent()[u] / steps, dv = window.extent()[v] / steps;
        for (int i = 0; i < steps; ++i) {
            task.check();
            for (int j = 0; j < steps; ++j) {
                Ray ray{{}, axis};
                ray.from[u] = window.lo[u] + (i + kPlace) * du;
                ray.from[v] = window.lo[v] + (j + kPlace) * dv;
                shoot(ray, du * dv);
            }
        }
    }
}

class RayWalk {
  public:
    explicit RayWalk(const SetTree& tree) : tree_(tree) {}

    // The sides along the ray from lo to hi, in order.
    const std::vector<Side>& run(const Ray& ray, double lo, double hi) {
        ray_ = ray;
        sides_.clear();
        walk(0, lo, hi, -1);
        return sides_;
    }

  private:
    // `question`: the one that changes its answer at lo.
    void walk(std::int32_t index, double lo, double hi, std::int32_t question) {
        const TreeNode& node = tree_.nodes[static_cast<std::size_t>(index)];
        if (node.leaf()) {
            const bool inside = node.kind == TreeNode::Kind::inside;
            if (sides_.empty() || sides_.back().inside != inside) sides_.push_back({lo, inside, question});
            return;
        }
        std::array<double, 2> roots{};
        const int count = crossings(node, lo, hi, roots);
        double from = lo;
        for (int i = 0; i <= count; ++i) {
            const double to = i < count ? roots[static_cast<std::size_t>(i)] : hi;
            const bool high = is_high(node, (from + to) / 2);
            walk(high ? node.high : node.low, from, to, i == 0 ? question : index);
            from = to;
        }
    }

    bool is_high(const TreeNode& node, double t) const {
        if (node.kind == TreeNode::Kind::cut) return ray_.at(t)[node.axis] >= node.cut;
        return quadric(node).value(ray_.at(t)) >= 0;
    }

    // Of the question's surface, strictly between lo and hi, rising.
    int crossings(const TreeNode& node, double lo, double hi, std::array<double, 2>& roots) const {
        std::array<double, 2> all{};
        int count = 0;
        if (node.kind == TreeNode::Kind::cut) {
            if (node.axis == ray_.axis) all[static_cast<std::size_t>(count++)] = node.cut;
        } else {
            count = roots_on_ray(quadric(node), ray_, all);
        }
        int kept = 0;
        for (int i = 0; i < count; ++i) {
            const double t = all[static_cast<std::size_t>(i)];
            if (t > lo && t < hi) roots[static_cast<std::size_t>(kept++)] = t;
        }
        return kept;
    }

    const Quadric& quadric(const TreeNode& node) const {
        return tree_.quadrics[static_cast<std::size_t>(node.quadric)].quadric;
    }

    const SetTree& tree_;
    Ray ray_;
    std::vector<Side> sides_;
};

class SurfaceSearch {
  public:
    SurfaceSearch(const SetTree& tree, const Task& task)
        : tree_(tree), box_(tree.box()), task_(task), walk_(tree) {
        surface_.patches.resize(tree.quadrics.size());
    }

    // meet(hit) for all that rays through this window meet in the box.
    template <class Meet>
    void shoot(const Box& window, int steps, Meet meet) {
        shoot_rays(window, steps, task_, [&](const Ray& ray, double area) { follow(ray, area, meet); });
    }

    TreeSurface run(int steps) {
        const auto affordable = [this](int wanted) {
            int n = wanted;
            while (n > 1 && 3.0 * n * n * static_cast<double>(tree_.nodes.size()) > kMostVisits) n /= 2;
            return n;
        };
        shoot(box_, affordable(steps), [this](const Hit& hit) { add(hit); });
        const auto met = [](const QuadricPatch& p) { return !p.points.empty(); };
        if (!std::ranges::all_of(surface_.patches, met)) look_closer(affordable(kFiner * steps));
        for (std::size_t q = 0; q < surface_.patches.size(); ++q) {
            if (const std::size_t n = surface_.patches[q].points.size(); n > 0 && n < kFew)
                look_at(q, affordable(kLocalSteps));
        }
        return std::move(surface_);
    }

  private:
    struct Hit {
        Vec3 point;
        const TreeNode* question = nullptr;  // none: a side of the box
        int axis = 0;                        // of the ray
        bool enters = false;                 // the solid, in the ray's direction
        double area = 0;                     // across the ray, that it stands for
    };

    template <class Meet>
    void follow(const Ray& ray, double area, Meet meet) {
        const double lo = box_.lo[ray.axis], hi = box_.hi[ray.axis];
        const std::vector<Side>& sides = walk_.run(ray, lo, hi);
        for (std::size_t i = 0; i < sides.size(); ++i) {
            if (i == 0 && !sides[0].inside) continue;
            const TreeNode* question =
                i == 0 ? nullptr : &tree_.nodes[static_cast<std::size_t>(sides[i].question)];
            meet(Hit{ray.at(sides[i].begin), question, ray.axis, sides[i].inside, area});
        }
        if (sides.back().inside) meet(Hit{ray.at(hi), nullptr, ray.axis, false, area});
    }

    void add(const Hit& hit) {
        if (hit.question == nullptr) {
            surface_.box_area[2 * static_cast<std::size_t>(hit.axis) + (hit.enters ? 0U : 1U)] += hit.area;
        } else if (hit.question->kind == TreeNode::Kind::cut) {
            surface_.cut_area += hit.area;
        } else {
            add_to(surface_.patches[static_cast<std::size_t>(hit.question->quadric)], hit);
        }
    }

    void add_to(QuadricPatch& patch, const Hit& hit) const {
        const Vec3 g =
            tree_.quadrics[static_cast<std::size_t>(hit.question->quadric)].quadric.gradient(hit.point);
        const double sum = std::abs(g.x) + std::abs(g.y) + std::abs(g.z);
        if (!(sum > 0)) return;
        const double area = hit.area * norm(g) / sum;
        patch.points.push_back(hit.point);
        patch.area += area;
        if ((g[hit.axis] > 0) == hit.enters) patch.area_above += area;
    }

    // For those that were not met.
    void look_closer(int steps) {
        std::vector<bool> unmet(surface_.patches.size());
        for (std::size_t q = 0; q < unmet.size(); ++q) unmet[q] = surface_.patches[q].points.empty();
        shoot(box_, steps, [&](const Hit& hit) {
            if (asks(hit) && unmet[static_cast<std::size_t>(hit.question->quadric)]) add(hit);
        });
    }

    // More points of one quadric, from where it has been met.
    void look_at(std::size_t q, int steps) {
        QuadricPatch& known = surface_.patches[q];
        Box window;
        for (const Vec3& p : known.points) window.grow(p);
        const double margin =
            kMargin * window.diagonal() + box_.diagonal() / (4.0 * kLocalSteps * kLocalSteps);
        window.lo = max(window.lo - Vec3{margin, margin, margin}, box_.lo);
        window.hi = min(window.hi + Vec3{margin, margin, margin}, box_.hi);
        QuadricPatch found;
        shoot(window, steps, [&](const Hit& hit) {
            if (asks(hit) && static_cast<std::size_t>(hit.question->quadric) == q &&
                window.contains(hit.point))
                add_to(found, hit);
        });
        known.points.insert(known.points.end(), found.points.begin(), found.points.end());
    }

    static bool asks(const Hit& hit) {
        return hit.question != nullptr && hit.question->kind == TreeNode::Kind::ask;
    }

    const SetTree& tree_;
    Box box_;
    const Task& task_;
    RayWalk walk_;
    TreeSurface surface_;
};

}  // namespace

std::vector<Vec3> points_on(const Quadric& quadric, const Box& box, int steps) {
    std::vector<Vec3> points;
    shoot_rays(box, steps, {}, [&](const Ray& ray, double) {
        std::array<double, 2> roots{};
        const int count = roots_on_ray(quadric, ray, roots);
        for (int i = 0; i < count; ++i) {
            const Vec3 p = ray.at(roots[static_cast<std::size_t>(i)]);
            if (box.contains(p)) points.push_back(p);
        }
    });
    return points;
}

TreeSurface find_surface(const SetTree& tree, const Task& task, int steps) {
    return SurfaceSearch(tree, task).run(steps);
}

}  // namespace pfgeom
