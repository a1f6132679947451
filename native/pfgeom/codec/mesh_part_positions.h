// A vertex of the mesh part, predicted across a gate and coded in grid steps.
// Source: Touma, Gotsman, "Triangle mesh compression", 1998 (parallelogram). Departures: the axis along which
// the surface is steepest is coded last, given the two others and the plane behind the gate, so that its
// residual is the small one; that plane is bent as the surface bent before; residual bits are mixed from many
// contexts.
#pragma once

#include "pfgeom/codec/entropy.h"
#include "pfgeom/codec/mesh_part_front.h"
#include "pfgeom/codec/mixer.h"

#include <array>
#include <cstdint>
#include <vector>

namespace pfgeom {

constexpr int kNoMirror = -1;

/// Is it on the plane of a part that is mirrored across this axis?
inline bool on_mirror(const GridPoint& p, int mirror_axis) {
    return mirror_axis != kNoMirror && p[static_cast<std::size_t>(mirror_axis)] == 0;
}

class PositionCoder {
  public:
    /// Coordinates are below this, so that a prediction fits into 32 bits.
    static constexpr std::int32_t kMaxCoordinate = 1 << 27;

    PositionCoder(EntropyCoder& coder, ContextMixer& mixer, int mirror_axis)
        : coder_(coder), mixer_(mixer), mirror_axis_(mirror_axis) {}

    /// Codes the next vertex, the third one of the face at `gate`; `p` is what is written or read.
    /// Returns false if what was read is out of range.
    bool code(const std::vector<GridPoint>& positions, const Gate& gate, GridPoint& p);
    /// The same for a vertex without a gate, given one that came before.
    bool code_free(const GridPoint& before, GridPoint& p);

    /// How the surface bends into the face at `gate` with the third vertex p: to be handed to its own gates.
    static double bend(const std::vector<GridPoint>& positions, const Gate& gate, const GridPoint& p);

  private:
    int code_level(int level, const std::array<int, 3>& around);
    bool code_on_mirror(bool on, const GridPoint& a, const GridPoint& b, const GridPoint& d);

    /// Magnitudes of the residuals of each vertex: tangential and normal, in log2_sixteenths / 8.
    struct Magnitude {
        std::uint8_t tangential = 0, normal = 0;
    };

    EntropyCoder& coder_;
    ContextMixer& mixer_;
    int mirror_axis_;
    std::vector<Magnitude> magnitudes_;
    double gain_ = 0.3;  // learned: how much of a bend goes on across a gate
};

}  // namespace pfgeom
