#include "pfgeom/render/camera.h"

#include "pfgeom/base/error.h"
#include "pfgeom/base/limits.h"

#include <algorithm>
#include <string>

namespace pfgeom {
namespace {

struct Axes {
    Vec3 forward, right, up;  // of unit length
};

Axes axes_of(const View& view) {
    if (!is_finite(view.towards) || !(squared_norm(view.towards) > 0))
        throw InvalidInput("the direction of the view must be finite and other than zero");
    if (!is_finite(view.up)) throw InvalidInput("the view's up must be finite");
    const Vec3 forward = normalized(view.towards);
    const Vec3 right = cross(forward, normalized(view.up));
    if (!(norm(right) > 1e-6)) throw InvalidInput("the view's up must not lie along its direction");
    const Vec3 across = normalized(right);
    return {forward, across, cross(across, forward)};
}

// Calls visit(corner) for the corners of boxes, in right, up, forward.
template <class Visit>
void for_corners(const Axes& axes, std::span<const Box> boxes, Visit visit) {
    for (const Box& box : boxes) {
        for (unsigned i = 0; i < 8; ++i) {
            const Vec3 c{(i & 1U) != 0 ? box.hi.x : box.lo.x, (i & 2U) != 0 ? box.hi.y : box.lo.y,
                         (i & 4U) != 0 ? box.hi.z : box.lo.z};
            visit(Vec3{dot(axes.right, c), dot(axes.up, c), dot(axes.forward, c)});
        }
    }
}

void check(const View& view, const Box& all) {
    if (!(view.slope >= 0 && view.slope < 100))
        throw InvalidInput("the field of view must be below 179 degrees");
    if (!(view.margin >= 0 && view.margin < 0.5))
        throw InvalidInput("the margin must be from 0 to below 1/2");
    if (all.empty()) throw InvalidInput("there is nothing to see");
    if (!is_finite(all.lo) || !is_finite(all.hi)) throw InvalidInput("what is to be seen is not finite");
}

}  // namespace

void check_size(const PictureSize& size) {
    const int most = Limits{}.picture_side;
    if (size.width < 1 || size.height < 1 || size.width > most || size.height > most)
        throw InvalidInput("a picture's sides must be from 1 to " + std::to_string(most) + " pixels");
    if (size.samples < 1 || size.samples > 16) throw InvalidInput("samples must be from 1 to 16 a side");
}

// A corner c is in the picture where |c.x - eye.x| <= s (c.z - eye.z), with s the half width at distance 1:
// so -s eye.z is at least half the sum of max(c.x - s c.z) and max(-c.x - s c.z), and eye.x half their
// difference. Orthographic: s = 0, and the half sum is the picture's half width.
Camera fit_camera(std::span<const Box> boxes, const View& view, const PictureSize& size) {
    check_size(size);
    Box all;
    for (const Box& box : boxes) all.grow(box);
    check(view, all);
    const Axes axes = axes_of(view);
    const double shorter = std::min(size.width, size.height), used = 1 - 2 * view.margin;
    const double wide = size.width / shorter, high = size.height / shorter;
    const double sx = view.slope * wide * used, sy = view.slope * high * used;
    Vec3 most{-Box::kInf, -Box::kInf, -Box::kInf},
        least = most;  // of c.x - s c.z and c.y - s c.z; -c.x - s c.z …
    for_corners(axes, boxes, [&](const Vec3& c) {
        most = max(most, {c.x - sx * c.z, c.y - sy * c.z, c.z});
        least = max(least, {-c.x - sx * c.z, -c.y - sy * c.z, -c.z});
    });
    const Vec3 middle = (most - least) * 0.5, half = (most + least) * 0.5;

    const double diagonal = all.diagonal() > 0 ? all.diagonal() : 1;
    Camera camera{{}, axes.forward, {}, {}, view.slope == 0};
    double reach = view.slope, back = least.z + 0.01 * diagonal;  // the eye's distance behind the origin
    if (camera.orthographic) {
        reach = std::max({half.x / (wide * used), half.y / (high * used), 1e-3 * diagonal});
    } else {
        back = std::max({back, half.x / sx, half.y / sy});
    }
    camera.right = axes.right * (reach * wide);
    camera.up = axes.up * (reach * high);
    camera.eye = axes.right * middle.x + axes.up * middle.y - axes.forward * back;
    return camera;
}

}  // namespace pfgeom
