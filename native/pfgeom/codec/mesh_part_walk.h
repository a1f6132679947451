// The walk over a mesh part, run by encoder and decoder alike: from gate to gate, a face at a time.
// At each gate it is coded whether a face follows, and whether its third vertex is the neighbour across the
// narrower wedge, the one across the wider, new, or any other one that is known already. The last makes
// handles, splits and non-manifold edges and vertices one thing. Faces against their neighbours' direction
// are marked.
#pragma once

#include "pfgeom/base/status.h"
#include "pfgeom/codec/entropy.h"
#include "pfgeom/codec/mesh_part_faces.h"
#include "pfgeom/codec/mesh_part_front.h"
#include "pfgeom/codec/mesh_part_positions.h"
#include "pfgeom/codec/mixer.h"
#include "pfgeom/function/model.h"

#include <cstdint>
#include <vector>

namespace pfgeom {

class MeshPartWalk {
  public:
    /// `mirror_axis`: of a mirrored part, or kNoMirror. `written`: what an encoder writes, in any order; null
    /// in a decoder.
    MeshPartWalk(EntropyCoder& coder, ContextMixer& mixer, int mirror_axis, const MeshPart* written);

    /// Codes `count` faces; more than budget_bytes can hold are refused before anything is allocated.
    FormatStatus run(std::size_t count, std::size_t budget_bytes);

    /// What was coded, in the order of the walk.
    const std::vector<GridPoint>& positions() const { return front_.positions(); }
    std::vector<Triangle>& faces() { return faces_; }
    /// Encoder: of each vertex of the walk, its row in the written part.
    const std::vector<std::int32_t>& written_rows() const { return written_rows_; }

  private:
    /// A vertex of a face to come: in the written part (encoder only), and in the walk (-1: not yet).
    struct Corner {
        std::int32_t written = -1, known = -1;
    };
    struct Surroundings;

    // They return false if what was read is impossible.
    bool seed();
    bool step(const Gate& gate);
    bool code_third(const Surroundings& around, Corner& corner);
    bool code_reference(Corner& corner);
    bool add_vertex(const Gate* gate, Corner& corner);

    bool code_border(const Surroundings& around, bool border);
    bool is_seam(const Gate& gate) const;
    Corner corner_of(std::int32_t written) const;

    EntropyCoder& coder_;
    ContextMixer& mixer_;
    int mirror_axis_;
    const MeshPart* written_;
    FacesLeft left_;
    std::vector<std::int32_t> known_;         // encoder: written vertex -> vertex of the walk, or -1
    std::vector<std::int32_t> written_rows_;  // encoder: the inverse
    Front front_;
    PositionCoder vertex_coder_;
    std::vector<std::uint8_t> borders_;  // of each vertex: kLeaves, kArrives
    std::vector<Triangle> faces_;
};

}  // namespace pfgeom
