// Depth-first branch and bound over the faces of a surface, for its largest distance to another.
#pragma once

#include "pfgeom/report/distance_bound.h"
#include "pfgeom/report/piece.h"

#include <vector>

namespace pfgeom {

// What a search reads.
struct DistanceProblem {
    const TriangleMesh& from;
    const TriangleMesh& to;
    const Bvh& to_bvh;
    const DistanceBoundOptions& options;
    const Task& task;
    std::vector<ClosestPoint> at_vertices;  // of `from`; face -1 where no face uses the vertex

    double distance(const Vec3& p, std::int32_t face) const {
        const Corners t = corners_of(to, face);
        return norm(closest_point_on_triangle(p, t[0], t[1], t[2]) - p);
    }
    // Largest distance of a point of the piece to one face.
    double reach(const Corners& piece, std::int32_t face) const {
        return std::max({distance(piece[0], face), distance(piece[1], face), distance(piece[2], face)});
    }
    // What the closest points of its vertices say about a face of `from`.
    double bound_from_vertices(std::int32_t face) const;
};

// Depth-first search of a group of faces; can be interrupted and continued.
class DistanceSearch {
  public:
    DistanceSearch(const DistanceProblem& problem, std::size_t begin, std::size_t end)
        : problem_(&problem), next_(begin), end_(end) {}

    // `known` of all groups so far. Spends at most `budget` queries, give or take those of one piece.
    void run(const DistanceBound& known, std::int64_t budget);

    bool done() const { return next_ == end_ && open_.empty(); }
    std::int64_t spent() const { return spent_; }
    const DistanceBound& found() const { return found_; }  // its bound: of what is closed
    double bound() const;                                  // of the whole group

  private:
    struct Piece {
        Corners corners;
        double bound;
        std::int32_t face;  // of `to`, probably close
    };

    double goal() const {
        const DistanceBoundOptions& options = problem_->options;
        if (options.certify_below > 0) return options.certify_below;
        return std::max((1 + options.gap) * found_.max, options.resolution);
    }
    bool refuted() const {
        return problem_->options.certify_below > 0 && found_.max > problem_->options.certify_below;
    }
    ClosestPoint query(const Vec3& p, std::int32_t hint);
    void examine(const Piece& piece);
    void split(const Piece& piece, std::int32_t face);
    void keep(const Piece& piece);  // closes it or leaves it open

    const DistanceProblem* problem_;
    std::size_t next_, end_;  // faces not begun
    std::vector<Piece> open_;
    std::vector<Corners> parts_;  // scratch of split()
    DistanceBound found_;
    std::int64_t spent_ = 0;
};

}  // namespace pfgeom
