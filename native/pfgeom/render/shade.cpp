#include "pfgeom/render/shade.h"

#include <algorithm>

namespace pfgeom {
namespace {

// Of the lights, linear: warm from the upper left, cool from the right, and a sky. The sum stays below 1.
constexpr Vec3 kKey{0.62, 0.58, 0.52}, kFill{0.14, 0.17, 0.22}, kSky{0.13, 0.14, 0.16};

// Linear light to eight bits: a square root is close to the screen's curve, and exact everywhere.
std::uint8_t to_byte(double light) {
    return static_cast<std::uint8_t>(255 * std::sqrt(std::clamp(light, 0.0, 1.0)) + 0.5);
}

}  // namespace

Shading::Shading(const Camera& camera) {
    const Vec3 right = normalized(camera.right), up = normalized(camera.up), back = -camera.forward;
    key_ = normalized(-0.45 * right + 0.65 * up + 0.8 * back);
    fill_ = normalized(0.85 * right - 0.1 * up + 0.5 * back);
    up_ = up;
}

std::array<std::uint8_t, 4> Shading::colour(const Vec3& normal, const Vec3& direction) const {
    const Vec3 n = dot(normal, direction) > 0 ? -normal : normal;
    const Vec3 light = kKey * std::max(dot(n, key_), 0.0) + kFill * std::max(dot(n, fill_), 0.0) +
                       kSky * (0.6 + 0.4 * dot(n, up_));
    return {to_byte(light.x), to_byte(light.y), to_byte(light.z), 255};
}

}  // namespace pfgeom
