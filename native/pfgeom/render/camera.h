// Where a picture is seen from.
#pragma once

#include "pfgeom/base/box.h"
#include "pfgeom/render/ray.h"

#include <span>

namespace pfgeom {

struct PictureSize {
    int width = 1024, height = 1024;
    int samples = 1;  ///< colours are the mean of so many rays squared: 1 to 16
};

/// InvalidInput unless both sides are from 1 to Limits::picture_side, and samples as above.
void check_size(const PictureSize& size);

/// From where to see boxes.
struct View {
    Vec3 towards{-1, -1, -1};  ///< any length but zero
    Vec3 up{0, 0, 1};          ///< not along `towards`
    double slope = 0.25;   ///< tangent of half the field of view, across the shorter side; 0: orthographic
    double margin = 0.04;  ///< share of the picture that stays free at each side, at least; below 1/2
};

/// A pixel's ray begins on the eye's plane for an orthographic camera, else in the eye; at parameter t it is
/// t beyond the plane through the eye across the view.
struct Camera {
    Vec3 eye;
    Vec3 forward, right,
        up;  ///< orthogonal; forward has unit length, the others reach to the picture's sides
    bool orthographic = false;

    /// x, y: -1 … 1 from left to right and from bottom to top.
    Ray ray(double x, double y) const {
        const Vec3 sideways = x * right + y * up;
        return orthographic ? Ray{eye + sideways, forward} : Ray{eye, forward + sideways};
    }
};

/// The camera that sees all of the boxes as large as they can be seen in this view. InvalidInput: there are
/// no boxes, they are not finite, or something of the view or the size is not as said above.
Camera fit_camera(std::span<const Box> boxes, const View& view, const PictureSize& size);

}  // namespace pfgeom
