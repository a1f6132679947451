// A picture's tiles, and which of them can show anything.
#pragma once

#include "pfgeom/base/box.h"
#include "pfgeom/render/camera.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

/// Pixels [left, right) × [top, bottom).
struct Tile {
    int left = 0, top = 0, right = 0, bottom = 0;
};

/// The tiles that the boxes' images reach, row by row from the top. The image of a box lies within the
/// rectangle around those of its corners, unless it reaches behind the camera: then all tiles count.
std::vector<Tile> tiles_showing(std::span<const Box> boxes, const Camera& camera, const PictureSize& size);

}  // namespace pfgeom
