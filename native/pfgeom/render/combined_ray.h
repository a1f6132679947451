// Rays against set operations: every piece that a ray meets tells where it is entered and left, and the
// expression tells which of these places are the result's surface.
//
// Source: S. D. Roth, "Ray casting for modeling solids", Computer Graphics and Image Processing 18, 1982.
// Departure: crossings are found one at a time, front to back, and not beyond the first that counts.
#pragma once

#include "pfgeom/function/model.h"
#include "pfgeom/render/box_tree.h"
#include "pfgeom/render/ray_piece.h"

#include <span>
#include <vector>

namespace pfgeom {

class CombinedPieces {
  public:
    CombinedPieces(const Model& model, const std::vector<CombinationNode>& tree);
    /// The pieces since the last call are those of operand `node`.
    void set_operand(std::size_t node, std::span<const RayPiece> pieces);

    SurfaceHit first_hit(std::span<const RayPiece> pieces, const BoxTree& boxes, const Ray& ray,
                         const RaySpan& span) const;
    /// Boxes that hold the result's surface.
    std::vector<Box> cover(std::span<const RayPiece> pieces) const;

  private:
    friend class CombinedRay;
    struct Node {
        CombinationStep::Kind kind = CombinationStep::Kind::operand;
        std::int32_t a = -1, b = -1, parent = -1;
        std::int32_t first = 0, last = 0;  // operand: slots of its objects
    };
    std::vector<Box> cover(std::span<const RayPiece> pieces, std::int32_t node) const;

    std::vector<Node> nodes_;              // the root last
    std::vector<std::int32_t> outer_;      // by slot: the slot that it is a cavity of, or -1
    std::vector<std::int32_t> node_of_;    // by piece
    std::vector<std::int32_t> slot_of_;    // by piece
    std::vector<std::int32_t> object_of_;  // by slot
};

}  // namespace pfgeom
