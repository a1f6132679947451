// Where a cube [-1,1]³ lies in the world. The values are exact by construction (a table and powers of two),
// so that a frame read from a file is the frame that was written.
#pragma once

#include "pfgeom/base/box.h"

#include <array>
#include <cstdint>

namespace pfgeom {

/// Centre = offset · half / 32, half = 2^(scale_code / 8).
struct Frame {
    static constexpr int kMinScale = -8 * 120, kMaxScale = 8 * 120;
    static constexpr std::int64_t kMaxOffset = std::int64_t{1} << 45;

    int scale_code = 0;
    std::array<std::int64_t, 3> offset{};

    double half() const;
    Vec3 centre() const;
    Vec3 to_world(const Vec3& p) const { return centre() + p * half(); }
    Vec3 to_local(const Vec3& p) const { return (p - centre()) / half(); }

    /// The smallest frame whose cube, shrunk to `fill`, holds the box (of finite, non-empty extent).
    static Frame around(const Box& box, double fill = 0.95);
    friend bool operator==(const Frame&, const Frame&) = default;
};

/// 2^(code / 8) for |code| <= 8 * 1000, without libm.
double exp2_eighths(int code);

}  // namespace pfgeom
