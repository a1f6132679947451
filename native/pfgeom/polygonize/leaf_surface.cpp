// A leaf is taken as a polyhedron: its faces are cut by smaller neighbours into minimal faces, their sides
// into minimal edges, and the field's signs at all these vertices decide everything. In a minimal face the
// crossed edges are joined in pairs by pieces of the surface; in the leaf these pieces close up into cycles,
// each of which bounds one sheet, a disk. Since both leaves at a face see the same pairs, all disks together
// form a closed 2-manifold, with no condition on the field or on the sizes of the cells.
//
// Source: S. Schaefer, T. Ju, J. Warren, "Manifold dual contouring", IEEE TVCG 13(3), 2007 (sheets of a
// cell). Departure: cycles over minimal faces take the place of a table of cubes, so that no collapse of a
// uniform grid is needed to have cells of different size.
#include "pfgeom/polygonize/leaf_surface.h"

namespace pfgeom {
namespace {

class SheetFinder {
  public:
    SheetFinder(const Octree& octree, const OctreeNode& leaf, LeafSheets& sheets)
        : octree_(octree), leaf_(leaf), size_(octree.size_at(leaf.depth)), out_(sheets) {}

    void run() {
        out_.crossings.clear();
        out_.pieces.clear();
        for (int k = 0; k < 8; ++k) corner_[k] = octree_.value(cube_corner(leaf_.corner, size_, k));
        for (int axis = 0; axis < 3; ++axis) {
            face({leaf_.corner, axis, leaf_.depth}, -1);
            face({moved(leaf_.corner, axis, size_), axis, leaf_.depth}, 1);
        }
        number_sheets();
    }

  private:
    struct Face {
        LatticePoint low;
        int axis, depth;
    };
    // A crossed edge met on the way around a face.
    struct Met {
        std::int32_t crossing;
        std::uint8_t direction;
        bool entering;  // from outside to inside on the way
    };

    void face(const Face& f, int side) {
        const std::int32_t size = octree_.size_at(f.depth);
        if (octree_.is_split(side < 0 ? moved(f.low, f.axis, -size) : f.low, f.depth)) {
            const int u = next_axis(f.axis), v = last_axis(f.axis);
            for (int i = 0; i < 4; ++i)
                face(
                    {moved(moved(f.low, u, (i & 1) * size / 2), v, (i >> 1) * size / 2), f.axis, f.depth + 1},
                    side);
            return;
        }
        met_.clear();
        const int u = next_axis(f.axis), v = last_axis(f.axis);
        walk({f.low, u}, f.depth, true, v, true);
        walk({moved(f.low, u, size), v}, f.depth, true, u, false);
        walk({moved(f.low, v, size), u}, f.depth, false, v, false);
        walk({f.low, v}, f.depth, false, u, true);
        if (!met_.empty()) join(f);
    }

    // Is the edge cut by a smaller leaf about it?
    bool divided(const LatticeEdge& edge, int depth) const {
        const std::int32_t size = octree_.size_at(depth);
        const int u = next_axis(edge.axis), v = last_axis(edge.axis);
        for (int i = 0; i < 4; ++i)
            if (octree_.is_split(moved(moved(edge.low, u, -(i & 1) * size), v, -(i >> 1) * size), depth))
                return true;
        return false;
    }

    // Along one side of a face, which lies towards +inward or -inward of it.
    void walk(const LatticeEdge& side, int depth, bool forward, int inward, bool inward_up) {
        const std::int32_t size = octree_.size_at(depth);
        if (divided(side, depth)) {
            for (int half = 0; half < 2; ++half) {
                const std::int32_t shift = (half == 0) == forward ? 0 : size / 2;
                walk({moved(side.low, side.axis, shift), side.axis}, depth + 1, forward, inward, inward_up);
            }
            return;
        }
        const double low = value(side.low);
        const double high = value(moved(side.low, side.axis, size));
        const bool rising = high >= 0;
        if (rising == (low >= 0)) return;
        const bool along_u = inward == next_axis(side.axis);
        const int direction = along_u ? (inward_up ? 1 : 3) : (inward_up ? 2 : 0);
        met_.push_back(
            {crossing(side, size, low, high), static_cast<std::uint8_t>(direction), rising == forward});
    }

    // Of the field at a vertex of the leaf: its corners' are known.
    double value(const LatticePoint& p) const {
        std::size_t corner = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::int32_t off = p[axis] - leaf_.corner[axis];
            if (off != 0 && off != size_) return octree_.value(p);
            corner |= off == 0 ? 0 : std::size_t{1} << axis;
        }
        return corner_[corner];
    }

    std::int32_t crossing(const LatticeEdge& edge, std::int32_t length, double low, double high) {
        for (std::size_t i = 0; i < out_.crossings.size(); ++i)
            if (out_.crossings[i].edge.key() == edge.key()) return static_cast<std::int32_t>(i);
        Crossing c;
        c.edge = edge;
        c.length = length;
        c.sheet = static_cast<std::int32_t>(out_.crossings.size());
        c.rising = high >= 0;
        c.quadrants = quadrants(edge);
        c.own = length == size_ && (c.quadrants & (c.quadrants - 1)) == 0;
        c.point = crossing_point(octree_.field(), edge, length, low, high);
        out_.crossings.push_back(c);
        return c.sheet;
    }

    // The quadrants about the edge that the leaf fills: one, or two where the edge lies within a face of it.
    std::uint8_t quadrants(const LatticeEdge& edge) const {
        const auto u = static_cast<std::size_t>(next_axis(edge.axis));
        const auto v = static_cast<std::size_t>(last_axis(edge.axis));
        const bool below_u = leaf_.corner[u]<edge.low[u], above_u = leaf_.corner[u] + size_> edge.low[u];
        const bool below_v = leaf_.corner[v]<edge.low[v], above_v = leaf_.corner[v] + size_> edge.low[v];
        return static_cast<std::uint8_t>((below_u && below_v) | (above_u && below_v) << 1 |
                                         (above_u && above_v) << 2 | (below_u && above_v) << 3);
    }

    // Pairs the crossings of a face. Where there are more than two, the sign at the face's centre decides
    // whether its inside or its outside parts are joined.
    void join(const Face& f) {
        const std::size_t n = met_.size();
        bool centre_inside = false;
        if (n > 2) {
            const LatticePoint far = moved(moved(f.low, next_axis(f.axis), octree_.size_at(f.depth)),
                                           last_axis(f.axis), octree_.size_at(f.depth));
            const CubeField& field = octree_.field();
            centre_inside = field.value((field.position(f.low) + field.position(far)) * 0.5) >= 0;
        }
        for (std::size_t i = 0; i < n; ++i) {
            if (met_[i].entering == centre_inside) continue;
            const Met &a = met_[i], &b = met_[(i + 1) % n];
            unite(a.crossing, b.crossing);
            if (n == 2) continue;
            const Crossing &ca = out_.crossings[a.crossing], &cb = out_.crossings[b.crossing];
            out_.pieces.push_back({ca.edge, cb.edge, a.direction, b.direction, octree_.size_at(f.depth),
                                   (ca.point + cb.point) * 0.5});
        }
    }

    std::int32_t root(std::int32_t i) const {
        while (out_.crossings[i].sheet != i) i = out_.crossings[i].sheet;
        return i;
    }
    void unite(std::int32_t a, std::int32_t b) {
        a = root(a);
        b = root(b);
        out_.crossings[std::max(a, b)].sheet = std::min(a, b);
    }

    // Roots become 0, 1, 2 ... in the order of the list; links only point down it.
    void number_sheets() {
        out_.count = 0;
        for (std::size_t i = 0; i < out_.crossings.size(); ++i) {
            Crossing& c = out_.crossings[i];
            c.sheet = c.sheet == static_cast<std::int32_t>(i) ? out_.count++ : out_.crossings[c.sheet].sheet;
        }
    }

    const Octree& octree_;
    const OctreeNode& leaf_;
    std::int32_t size_;
    LeafSheets& out_;
    std::array<double, 8> corner_{};
    std::vector<Met> met_;
};

}  // namespace

Vec3 crossing_point(const CubeField& field, const LatticeEdge& edge, std::int32_t length, double low,
                    double high) {
    const Vec3 a = field.position(edge.low);
    const Vec3 b = field.position(moved(edge.low, edge.axis, length));
    const double t = low / (low - high);
    return t >= 0 && t <= 1 ? a + (b - a) * t : (a + b) * 0.5;
}

void find_sheets(const Octree& octree, const OctreeNode& leaf, LeafSheets& sheets) {
    SheetFinder(octree, leaf, sheets).run();
}

}  // namespace pfgeom
