#include "pfgeom/fit/tree_seams.h"

#include "pfgeom/base/parallel.h"
#include "pfgeom/mesh/edges.h"
#include "pfgeom/segment/region_set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

namespace pfgeom {
namespace {

// Cosine between the gradients of two quadrics that touch: 8°. The triangles of a rounded edge turn more than
// that, their quadrics do not.
constexpr double kTangent = 0.99;
// A separator may leave its seam by so many tolerances, as long as the quadrics are then no further apart
// than this share of the tolerance: the tree may take either.
constexpr std::array<double, 5> kAside{16, 8, 4, 2, 1};
constexpr double kApart = 0.3;
// In tolerances: a shorter seam is settled by cuts.
constexpr double kLeastLength = 8;
constexpr double kLeastGradient = 0.1;
constexpr std::size_t kMostSeams = 256;  // which are joined pair by pair

using Between = std::pair<std::int32_t, std::int32_t>;

double signed_distance(const Quadric& q, const Vec3& p) {
    return q.value(p) / std::max(norm(q.gradient(p)), kLeastGradient);
}

struct SeamPoint {
    CheckPoint check;  // outwards: along the surface, from the first quadric's side to the second's
    double weight = 0;
};

struct Seam {
    std::vector<Between> between;
    std::vector<SeamPoint> points;
    double length = 0;
    std::optional<QuantisedQuadric> quadric;

    PowerSums sums() const {
        PowerSums sums;
        for (const SeamPoint& s : points) sums.add(s.check.point, s.check.outwards, s.weight);
        return sums;
    }
    std::vector<CheckPoint> checks() const {
        std::vector<CheckPoint> list;
        for (const SeamPoint& s : points) list.push_back(s.check);
        return list;
    }
};

class SeamFinder {
  public:
    SeamFinder(const TriangleMesh& mesh, std::span<const QuantisedQuadric> quadrics,
               const std::vector<std::int32_t>& of_face, double tolerance)
        : mesh_(mesh), quadrics_(quadrics), of_face_(of_face), tolerance_(tolerance) {}

    // The longest ones, by falling length.
    std::vector<Seam> run() {
        EdgeTable(mesh_.faces, mesh_.vertices.size()).for_each([&](std::span<const EdgeUse> uses) {
            if (uses.size() == 2) add(uses[0], uses[1]);
        });
        std::vector<Seam> seams;
        for (auto& [between, seam] : seams_) {
            if (seam.length >= kLeastLength * tolerance_) seams.push_back(std::move(seam));
        }
        std::ranges::stable_sort(seams, std::greater<>{}, &Seam::length);
        seams.resize(std::min(seams.size(), kMostSeams));
        return seams;
    }

  private:
    const Quadric& quadric(std::int32_t q) const {
        return quadrics_[static_cast<std::size_t>(q)].quadric.quadric;
    }

    void add(const EdgeUse& one, const EdgeUse& two) {
        std::int32_t f = one.face(), g = two.face();
        if (of_face_[f] == of_face_[g]) return;
        if (of_face_[f] > of_face_[g]) std::swap(f, g);
        const Between between{of_face_[f], of_face_[g]};
        const Vec3 &a = mesh_.vertices[one.lo], &b = mesh_.vertices[one.hi], middle = (a + b) * 0.5;
        const double length = norm(b - a);
        std::array<SeamPoint, 3> points;
        std::size_t n = 0;
        for (const Vec3& p : {a, b, middle}) {
            const Vec3 u = normalized(quadric(between.first).gradient(p)),
                       v = normalized(quadric(between.second).gradient(p));
            if (!(std::abs(dot(u, v)) >= kTangent)) return;
            Vec3 across = normalized(cross(b - a, u));
            if (dot(across, centroid(g) - centroid(f)) < 0) across = -across;
            points[n] = {{.point = p, .limit = room(p, across, between), .outwards = across},
                         n == 2 ? length / 2 : length / 4};
            ++n;
        }
        Seam& seam = seams_[between];
        seam.between = {between};
        seam.length += length;
        seam.points.insert(seam.points.end(), points.begin(), points.end());
    }

    Vec3 centroid(std::int32_t face) const {
        const auto& [a, b, c] = mesh_.faces[face];
        return (mesh_.vertices[a] + mesh_.vertices[b] + mesh_.vertices[c]) / 3;
    }

    // How far the separator may pass from p: what counts is by how much the quadrics part on the way there,
    // not that each of them may miss the seam.
    double room(const Vec3& p, const Vec3& across, const Between& between) const {
        const auto apart = [&](const Vec3& x) {
            const Quadric &one = quadric(between.first), &two = quadric(between.second);
            const double sense = dot(one.gradient(p), two.gradient(p)) < 0 ? -1 : 1;
            return signed_distance(one, x) - sense * signed_distance(two, x);
        };
        const double here = apart(p);
        for (const double aside : kAside) {
            const Vec3 step = across * (aside * tolerance_);
            const double most = std::max(std::abs(apart(p + step) - here), std::abs(apart(p - step) - here));
            if (most <= kApart * tolerance_) return aside * tolerance_;
        }
        return kAside.back() * tolerance_;
    }

    const TriangleMesh& mesh_;
    std::span<const QuantisedQuadric> quadrics_;
    const std::vector<std::int32_t>& of_face_;
    double tolerance_;
    std::map<Between, Seam> seams_;
};

Seam joined(const Seam& one, const Seam& two, double sense) {
    Seam both = one;
    both.length += two.length;
    both.between.insert(both.between.end(), two.between.begin(), two.between.end());
    for (SeamPoint s : two.points) {
        s.check.outwards *= sense;
        both.points.push_back(s);
    }
    return both;
}

class Joiner {
  public:
    Joiner(std::vector<Seam> seams, int resolution, int scales, double tolerance)
        : seams_(std::move(seams)),
          resolution_(resolution),
          scales_(scales),
          reach_(kAside.front() * tolerance) {}

    std::vector<QuantisedQuadric> run(const Task& task) {
        parallel_chunks(seams_.size(), 1, task, [&](std::size_t i, std::size_t) { round(seams_[i]); });
        std::erase_if(seams_, [](const Seam& seam) { return !seam.quadric; });
        for (std::size_t i = 0; i < seams_.size(); ++i) {
            for (std::size_t j = i + 1; j < seams_.size();) {
                task.check();
                if (join(seams_[i], seams_[j]))
                    seams_.erase(seams_.begin() + static_cast<std::ptrdiff_t>(j));
                else
                    ++j;
            }
        }
        std::vector<QuantisedQuadric> separators;
        for (Seam& seam : seams_) {
            std::ranges::sort(seam.between);
            seam.quadric->between = std::move(seam.between);
            separators.push_back(*std::move(seam.quadric));
        }
        return separators;
    }

  private:
    // The way across counts like the place: where a separator may pass far from its seam, directions are what
    // is left.
    double normal_weight() const { return reach_ * reach_; }

    void round(Seam& seam) const {
        std::vector<CheckPoint> checks = seam.checks();
        seam.quadric = quantise(seam.sums(), checks, resolution_, scales_, normal_weight());
    }

    // Makes one of both if that takes fewer bits than two.
    bool join(Seam& one, const Seam& two) const {
        for (const double sense : {1.0, -1.0}) {
            Seam both = joined(one, two, sense);
            if (!passes(both.sums().system().solve(normal_weight()), both.checks())) continue;
            round(both);
            if (!both.quadric || both.quadric->bits > one.quadric->bits + two.quadric->bits) continue;
            one = std::move(both);
            return true;
        }
        return false;
    }

    std::vector<Seam> seams_;
    int resolution_, scales_;
    double reach_;
};

}  // namespace

std::vector<QuantisedQuadric> find_separators(const TriangleMesh& mesh,
                                              std::span<const QuantisedQuadric> quadrics,
                                              const std::vector<std::int32_t>& of_face, int resolution,
                                              int scales, double tolerance, const Task& task) {
    return Joiner(SeamFinder(mesh, quadrics, of_face, tolerance).run(), resolution, scales, tolerance)
        .run(task);
}

}  // namespace pfgeom
