// Each step is taken only if fewer triangles around it are turned over afterwards.
#include "pfgeom/polygonize/crease_mend.h"

#include "pfgeom/polygonize/crease_tests.h"

#include <algorithm>
#include <vector>

namespace pfgeom {
namespace {

constexpr int kRounds = 8;
// How flat a triangle may be whose crease is given up, and how far its apex may be moved, in tolerances.
constexpr double kBeside = 1;
// Heights below this vanish where coordinates are stored in single precision (2^-24 of the size).
constexpr double kLeastHeight = 1.0 / (1 << 20);
// How far vertices are moved off such triangles, in tolerances and as shares of the way to the middle.
constexpr double kNudge = 0.1;
constexpr double kShares[] = {0.5, 0.25, 0.125, 0.0625};

class Mender {
  public:
    Mender(const LabelSurface& surface, const AdaptOptions& options, LabelledMesh& mesh, const Task& task)
        : surface_(surface), options_(options), m_(mesh), tests_(mesh, surface), task_(task) {}

    void run() {
        for (int round = 0; round < kRounds; ++round) {
            bool any = false;
            for (std::int32_t f = 0; 3 * f < m_.mesh.half_edges(); ++f) {
                if (f % 1024 == 0) task_.check();
                if (m_.mesh.alive(f) && tests_.turned_over(f)) any |= mend(f);
            }
            m_.compact();
            if (!any) break;
        }
        for (std::int32_t h = 0; h < m_.mesh.half_edges(); ++h) {
            if (h % 1024 == 0) task_.check();
            if (invisible(h / 3)) nudge(h);
        }
    }

  private:
    bool mend(std::int32_t face);
    bool turn(std::int32_t h);
    bool merge(std::int32_t h);
    bool turn_crease(std::int32_t h);
    bool move(std::int32_t h);
    bool keeps_heights(std::int32_t h, const Vec3& p);
    bool invisible(std::int32_t face) const;
    int invisible_around(std::int32_t h) const;
    int turned_around(std::int32_t h) const {
        return tests_.turned_over(h / 3) + tests_.others_turned_over(h, m_.mesh.position[m_.mesh.from(h)]);
    }
    void nudge(std::int32_t h);
    std::vector<Label> labels_around(std::int32_t h) const;

    const LabelSurface& surface_;
    const AdaptOptions& options_;
    LabelledMesh& m_;
    CreaseTests tests_;
    const Task& task_;
};

bool Mender::mend(std::int32_t face) {
    const std::int32_t first = 3 * face, last = first + 3;
    for (std::int32_t h = first; h < last; ++h)
        if (turn(h)) return true;
    for (std::int32_t h = first; h < last; ++h)
        if (merge(h) || merge(m_.mesh.twin(h))) return true;
    for (std::int32_t h = first; h < last; ++h)
        if (turn_crease(h)) return true;
    for (std::int32_t h = first; h < last; ++h)
        if (move(h)) return true;
    return false;
}

bool Mender::turn(std::int32_t h) {
    if (!tests_.flip_mends(h, options_.edge_tolerance)) return false;
    m_.mesh.flip(h);
    return true;
}

bool Mender::merge(std::int32_t h) {
    return tests_.merge_mends(h, options_.edge_tolerance) && m_.mesh.collapse(h);
}

// Of the faces around from(h), each once, but for h's own.
std::vector<Label> Mender::labels_around(std::int32_t h) const {
    std::vector<Label> labels;
    for (std::int32_t spoke = m_.mesh.twin(SurfaceMesh::previous(h)); spoke != h;
         spoke = m_.mesh.twin(SurfaceMesh::previous(spoke)))
        if (std::find(labels.begin(), labels.end(), m_.label_at(spoke)) == labels.end())
            labels.push_back(m_.label_at(spoke));
    return labels;
}

//        c              The triangle above a crease a-b is flat: its apex goes onto the crease, and the
//      /   .            triangle to the side below.
//    a ----- b
//      .   /
//        d
bool Mender::turn_crease(std::int32_t h) {
    if (!m_.crease(h) || !tests_.may_turn(h) || !tests_.is_step(h)) return false;
    const std::int32_t g = m_.mesh.twin(h), a = m_.mesh.from(h), b = m_.mesh.to(h), c = m_.mesh.apex(h),
                       d = m_.mesh.apex(g), spoke = SurfaceMesh::previous(h);
    const Label below = m_.label_at(g);
    const auto at = [&](std::int32_t v) -> const Vec3& { return m_.mesh.position[v]; };
    const double off = kBeside * options_.face_tolerance;
    const double area = norm(cross(at(b) - at(a), at(c) - at(a)));
    if (area * area > off * off * tests_.squared_length(h)) return false;
    std::vector<Label> labels = labels_around(spoke);
    if (std::find(labels.begin(), labels.end(), below) == labels.end()) labels.push_back(below);
    Vec3 foot = at(c);
    if (!surface_.project(labels, off, options_.accuracy, foot, LabelSurface::kLeastSineOfCreases))
        return false;
    const int now = 1 + tests_.turned_over(g / 3) + tests_.others_turned_over(spoke, at(c));
    const int then = tests_.turned_over(below, foot, at(d), at(b)) +
                     tests_.turned_over(below, at(d), foot, at(a)) + tests_.others_turned_over(spoke, foot);
    if (then >= now || tests_.height(below, below, c, d) > options_.edge_tolerance) return false;
    m_.mesh.flip(h);
    m_.label[h / 3] = m_.label[g / 3] = below;
    m_.mesh.position[c] = foot;
    return true;
}

// from(h) to the middle of its neighbours, of those along the crease if it is on one.
bool Mender::move(std::int32_t h) {
    std::vector<Label> labels = labels_around(h);
    if (std::find(labels.begin(), labels.end(), m_.label_at(h)) == labels.end())
        labels.push_back(m_.label_at(h));
    Vec3 sum;
    int count = 0, creases = 0;
    std::int32_t spoke = h;
    do {
        const bool crease = m_.crease(spoke);
        creases += crease;
        if (labels.size() == 1 || crease) {
            sum += m_.mesh.position[m_.mesh.to(spoke)];
            ++count;
        }
        spoke = m_.mesh.twin(SurfaceMesh::previous(spoke));
    } while (spoke != h);
    if (creases != 0 && creases != 2) return false;
    Vec3& p = m_.mesh.position[m_.mesh.from(h)];
    Vec3 foot = sum / count;
    const Vec3 before = p;
    if (!surface_.project(labels, norm(foot - p) / 2, options_.accuracy, foot,
                          LabelSurface::kLeastSineOfCreases))
        return false;
    const int now = turned_around(h);
    p = foot;
    if (turned_around(h) < now && keeps_heights(h, before)) return true;
    p = before;
    return false;
}

// No edge from from(h) above the tolerance, unless it was so before, with the vertex at p.
bool Mender::keeps_heights(std::int32_t h, const Vec3& p) {
    std::int32_t spoke = h;
    do {
        const double height = tests_.height(spoke);
        if (height > options_.edge_tolerance) {
            Vec3& here = m_.mesh.position[m_.mesh.from(h)];
            const Vec3 now = here;
            here = p;
            const double before = tests_.height(spoke);
            here = now;
            if (height > before) return false;
        }
        spoke = m_.mesh.twin(SurfaceMesh::previous(spoke));
    } while (spoke != h);
    return true;
}

bool Mender::invisible(std::int32_t face) const {
    const auto& [a, b, c] = m_.mesh.faces()[face];
    const auto& p = m_.mesh.position;
    double longest = 0;
    for (std::int32_t h = 3 * face; h < 3 * face + 3; ++h)
        longest = std::max(longest, tests_.squared_length(h));
    const double square = squared_norm(cross(p[b] - p[a], p[c] - p[a]));
    return square <= kLeastHeight * kLeastHeight * longest;
}

int Mender::invisible_around(std::int32_t h) const {
    int count = 0;
    m_.mesh.for_each_spoke(h, [&](std::int32_t spoke) { count += invisible(spoke / 3); });
    return count;
}

// Where no merge is possible: as two corners of a narrow passage that fall together. from(h) goes a little
// towards the middle of its neighbours.
void Mender::nudge(std::int32_t h) {
    Vec3 sum;
    int count = 0;
    m_.mesh.for_each_spoke(h, [&](std::int32_t spoke) {
        sum += m_.mesh.position[m_.mesh.to(spoke)];
        ++count;
    });
    Vec3& p = m_.mesh.position[m_.mesh.from(h)];
    const Vec3 before = p, way = sum / count - p;
    const double most = kNudge * options_.face_tolerance / std::max(norm(way), 1e-300);
    const int unseen = invisible_around(h), turned = turned_around(h);
    for (const double share : kShares) {
        p = before + way * std::min(share, share * most);
        if (invisible_around(h) < unseen && turned_around(h) <= turned) return;
    }
    p = before;
}

}  // namespace

void mend_creases(const LabelSurface& surface, const AdaptOptions& options, LabelledMesh& mesh,
                  const Task& task) {
    Mender(surface, options, mesh, task).run();
}

}  // namespace pfgeom
