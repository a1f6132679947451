// A picture of a model, straight from its functions: rays through an octree of pruned functions, no polygons
// between (but for mesh parts, which are some).
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/render/camera.h"
#include "pfgeom/render/scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace pfgeom {

/// The first hit of each ray; none where a number is not finite or the direction is zero.
std::vector<SurfaceHit> cast_rays(const RayScene& scene, std::span<const Ray> rays, const RaySpan& span,
                                  const Task& task);

/// One entry a pixel, row by row from the top. Where nothing is seen: infinity, zeros, -1 and transparent.
struct Picture {
    PictureSize size;
    std::vector<double> depth;                         ///< from the camera's plane, in the model's units
    std::vector<std::array<float, 3>> normals;         ///< SurfaceHit::normal
    std::vector<std::int32_t> objects, functions;      ///< SurfaceHit::object, SurfaceHit::function
    std::vector<std::array<std::uint8_t, 4>> colours;  ///< two lights, red green blue alpha
};

/// The centre of each pixel is looked at, for colours also `samples` squared places of it: the same bits for
/// any number of threads. What lies behind the eye is not seen. InvalidInput: as fit_camera has it.
Picture render(const RayScene& scene, const Camera& camera, const PictureSize& size, const Task& task = {});

}  // namespace pfgeom
