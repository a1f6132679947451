// The nearest points of a surface to many others.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/render/scene.h"

#include <span>
#include <vector>

namespace pfgeom {

/// Of each point, as RayScene::nearest has it; none where a coordinate is not finite. The same for any number
/// of threads.
std::vector<NearestPoint> closest_points(const RayScene& scene, std::span<const Vec3> points, double accuracy,
                                         const Task& task);

}  // namespace pfgeom
