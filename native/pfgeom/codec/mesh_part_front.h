// The front of a mesh part that grows face by face: its open edges ("gates"), and which of them comes next.
// Source: Lee, Alliez, Desbrun, "Angle-Analyzer: a triangle-quad mesh codec", Eurographics 2002: the gate at
// the smallest angle first. Departures: gates find each other by their vertices instead of in loops, so that
// any triangle soup grows by one mechanism: whatever does not match stays open and is later coded as a
// border.
#pragma once

#include "pfgeom/base/vec.h"

#include <array>
#include <cstdint>
#include <queue>
#include <vector>

namespace pfgeom {

using GridPoint = std::array<std::int32_t, 3>;

inline Vec3 to_vec(const GridPoint& p) {
    return {1.0 * p[0], 1.0 * p[1], 1.0 * p[2]};
}

/// An open edge: the face that is looked for has the directed edge from -> to, the one behind has to -> from.
struct Gate {
    std::int32_t from = -1, to = -1;
    std::int32_t apex = -1;  ///< third vertex of the face behind
    bool flipped = false;    ///< the face behind is stored against the direction of the walk
    double bend = 0;         ///< curvature of the surface behind, see mesh_part_positions.h
};

/// A neighbouring gate, seen across the wedge that a new face may close.
struct Wedge {
    static constexpr int kNone = 1024;  ///< four right angles, and no neighbour at all
    std::int32_t vertex = -1;           ///< far end of the neighbour, or -1
    int angle = kNone;                  ///< 0 .. 1024, rises with the angle
};

class Front {
  public:
    /// A vertex and its place; rows in the order of the calls.
    void add_vertex(const GridPoint& p);
    /// A first face.
    void seed(std::int32_t a, std::int32_t b, std::int32_t c);
    /// The face gate.from, gate.to, c in the direction of the walk, at a gate that was taken out. Its two
    /// other edges close the gates that they fit, or open one each.
    void grow(const Gate& gate, std::int32_t c, bool flipped, double bend);
    /// Takes the next gate out; false if none is left.
    bool pop(Gate& gate);

    Wedge before(const Gate& gate) const;  ///< the gate that ends where this one begins
    Wedge after(const Gate& gate) const;   ///< the gate that begins where this one ends

    const std::vector<GridPoint>& positions() const { return positions_; }
    /// Faces at a vertex so far.
    int valence(std::int32_t vertex) const { return ends_[static_cast<std::size_t>(vertex)].faces; }

  private:
    // Gates at a vertex hang in two lists. Walks along a list stop after kReach gates, so that no input can
    // make them long; what lies further on is not seen, by neither encoder nor decoder.
    static constexpr int kReach = 12;
    struct Node {
        Gate gate;
        std::uint32_t serial = 0;                                    // 0: closed
        std::array<std::int32_t, 2> next{-1, -1}, previous{-1, -1};  // [0]: same `from`, [1]: same `to`
    };
    struct VertexEnds {
        std::array<std::int32_t, 2> first{-1, -1};
        std::int32_t faces = 0;
    };
    struct Candidate {
        std::int32_t angle;
        std::uint32_t serial;
        std::int32_t node;
        bool operator<(const Candidate& o) const {
            return angle != o.angle ? angle > o.angle : serial > o.serial;
        }
    };

    Vec3 at(std::int32_t v) const { return to_vec(positions_[static_cast<std::size_t>(v)]); }
    int wedge_angle(const Gate& gate, std::int32_t corner, std::int32_t other, std::int32_t neighbour) const;
    void edge(std::int32_t from, std::int32_t to, const Gate& opened);
    std::int32_t find(std::int32_t from, std::int32_t to) const;
    void open(const Gate& gate);
    void close(std::int32_t node);
    void schedule(std::int32_t node);

    std::vector<GridPoint> positions_;
    std::vector<VertexEnds> ends_;
    std::vector<Node> nodes_;
    std::vector<std::int32_t> unused_;
    std::priority_queue<Candidate> queue_;
    std::uint32_t serial_ = 0;
};

}  // namespace pfgeom
