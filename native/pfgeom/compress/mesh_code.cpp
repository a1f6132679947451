#include "pfgeom/compress/mesh_code.h"

#include <cmath>

namespace pfgeom {

std::uint8_t mesh_code_for(const Goal& goal, double chord) {
    int code = 0;
    while (code < 255 && goal.diagonal * exp2_eighths(-2 * code) > chord) ++code;
    return static_cast<std::uint8_t>(code);
}

double rounding_step(double tolerance) {
    int exponent = 0;
    std::frexp(tolerance / 16, &exponent);
    return std::ldexp(1.0, exponent - 1);
}

Solid single_function(bool inward) {
    Solid solid{{{SetNode::Kind::function, 0, -1, -1}}};
    if (inward) solid.nodes.push_back({SetNode::Kind::complement, 0, -1, -1});
    return solid;
}

}  // namespace pfgeom
