#include "pfgeom/function/frame.h"

namespace pfgeom {

double exp2_eighths(int code) {
    // 2^(i/8) for i = 0..7, correctly rounded.
    constexpr std::array<double, 8> kRoots{1.0,
                                           0x1.172b83c7d517bp+0,
                                           0x1.306fe0a31b715p+0,
                                           0x1.4bfdad5362a27p+0,
                                           0x1.6a09e667f3bcdp+0,
                                           0x1.8ace5422aa0dbp+0,
                                           0x1.ae89f995ad3adp+0,
                                           0x1.d5818dcfba487p+0};
    const int octave = code >= 0 ? code / 8 : -((7 - code) / 8);
    return std::ldexp(kRoots[static_cast<std::size_t>(code - octave * 8)], octave);
}

double Frame::half() const {
    return exp2_eighths(scale_code);
}

Vec3 Frame::centre() const {
    const double unit = half() / 32;
    return {static_cast<double>(offset[0]) * unit, static_cast<double>(offset[1]) * unit,
            static_cast<double>(offset[2]) * unit};
}

Frame Frame::around(const Box& box, double fill) {
    Frame frame;
    frame.scale_code = kMinScale;
    const Vec3 extent = box.extent(), middle = box.centre();
    // The centre is off by at most half / 64, which the second term makes room for.
    const auto fits = [&](int code) {
        const double half = exp2_eighths(code);
        return std::max({extent.x, extent.y, extent.z}) / 2 + half / 64 <= fill * half;
    };
    int low = kMinScale, high = kMaxScale;
    while (low < high) {
        const int code = low + (high - low) / 2;
        if (fits(code))
            high = code;
        else
            low = code + 1;
    }
    frame.scale_code = low;
    for (int axis = 0; axis < 3; ++axis) {
        frame.offset[static_cast<std::size_t>(axis)] =
            static_cast<std::int64_t>(std::floor(middle[axis] / (frame.half() / 32) + 0.5));
    }
    return frame;
}

}  // namespace pfgeom
