#include "pfgeom/render/tiles.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pfgeom {
namespace {

constexpr int kTile = 16;  // pixels

int tiles(int pixels) {
    return (pixels + kTile - 1) / kTile;
}

class TileMask {
  public:
    TileMask(const Camera& camera, const PictureSize& size)
        : camera_(camera),
          size_(size),
          x_axis_(camera.right / squared_norm(camera.right)),
          y_axis_(camera.up / squared_norm(camera.up)),
          columns_(tiles(size.width)),
          rows_(tiles(size.height)),
          shown_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

    void add(const Box& box) {
        constexpr double kInf = std::numeric_limits<double>::infinity();
        double left = kInf, right = -kInf, bottom = kInf, top = -kInf;
        for (unsigned i = 0; i < 8; ++i) {
            const Vec3 c = Vec3{(i & 1U) != 0 ? box.hi.x : box.lo.x, (i & 2U) != 0 ? box.hi.y : box.lo.y,
                                (i & 4U) != 0 ? box.hi.z : box.lo.z} -
                           camera_.eye;
            const double depth = camera_.orthographic ? 1 : dot(c, camera_.forward);
            const bool behind = !(depth > 0);
            const double x = behind ? kInf : dot(c, x_axis_) / depth, y = dot(c, y_axis_) / depth;
            left = std::min(left, behind ? -kInf : x), right = std::max(right, x);
            bottom = std::min(bottom, behind ? -kInf : y), top = std::max(top, behind ? kInf : y);
        }
        mark(tile_at(left, size_.width), tile_at(right, size_.width), tile_at(-top, size_.height),
             tile_at(-bottom, size_.height));
    }

    std::vector<Tile> take() const {
        std::vector<Tile> shown;
        for (int row = 0; row < rows_; ++row) {
            for (int column = 0; column < columns_; ++column) {
                if (shown_[index(column, row)] == 0) continue;
                const int left = column * kTile, top = row * kTile;
                shown.push_back(
                    {left, top, std::min(left + kTile, size_.width), std::min(top + kTile, size_.height)});
            }
        }
        return shown;
    }

  private:
    std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(column);
    }

    // Of a place from -1 to 1 across so many pixels.
    static double tile_at(double place, int pixels) { return (place + 1) / 2 * pixels / kTile; }

    // All tiles within a margin of half a pixel and more.
    void mark(double left, double right, double top, double bottom) {
        constexpr double kMargin = 1.0 / kTile;
        const auto first = [](double at) { return static_cast<int>(std::clamp(at - kMargin, 0.0, 1e6)); };
        const auto last = [](double at, int count) {
            return static_cast<int>(std::clamp(at + kMargin, -1.0, count - 1.0));
        };
        for (int row = first(top); row <= last(bottom, rows_); ++row) {
            for (int column = first(left); column <= last(right, columns_); ++column)
                shown_[index(column, row)] = 1;
        }
    }

    const Camera& camera_;
    PictureSize size_;
    Vec3 x_axis_, y_axis_;  // their products with a point at depth 1 are its place in the picture
    int columns_, rows_;
    std::vector<std::uint8_t> shown_;
};

}  // namespace

std::vector<Tile> tiles_showing(std::span<const Box> boxes, const Camera& camera, const PictureSize& size) {
    TileMask mask(camera, size);
    for (const Box& box : boxes) mask.add(box);
    return mask.take();
}

}  // namespace pfgeom
