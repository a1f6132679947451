// What a search for a point of a surface asks of the octree that the surface is kept in.
#pragma once

#include "pfgeom/render/condition.h"
#include "pfgeom/render/ray_octree.h"

#include <cstdint>
#include <vector>

namespace pfgeom {

/// What the point is to belong to: one side of a closed surface, up to its surface, or an open surface.
enum class Side : std::uint8_t { outside, inside, sheet };

/// Immutable and safe to use from many threads. Leaves are right a little around their cells (kReach).
class SurfaceCells {
  public:
    virtual ~SurfaceCells() = default;
    virtual const RayOctree& octree() const = 0;
    virtual bool open() const = 0;
    /// Regions whose union holds that side in the leaf's cell; `regions` is overwritten.
    virtual void regions(std::int32_t leaf, Side side, std::vector<SignRegion>& regions) const = 0;
    /// Of a function of the leaf, around a point of its cell.
    virtual Expansion expand(std::int32_t leaf, std::int32_t function, const Vec3& at) const = 0;
    /// Is this point of the cell inside? Of an open surface: would it be of it, if it lay on it?
    virtual bool is_inside(std::int32_t leaf, const Vec3& p) const = 0;
};

}  // namespace pfgeom
