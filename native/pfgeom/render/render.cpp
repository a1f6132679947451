#include "pfgeom/render/render.h"

#include "pfgeom/base/parallel.h"
#include "pfgeom/render/shade.h"
#include "pfgeom/render/tiles.h"

namespace pfgeom {
namespace {

constexpr std::size_t kRays = 256;  // a chunk

bool is_castable(const Ray& ray) {
    const double squared = squared_norm(ray.direction);
    return is_finite(ray.origin) && squared > 0 && std::isfinite(squared);
}

class Renderer {
  public:
    Renderer(const RayScene& scene, const Camera& camera, const PictureSize& size)
        : scene_(scene), camera_(camera), shading_(camera) {
        const auto pixels = static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
        picture_.size = size;
        picture_.depth.assign(pixels, std::numeric_limits<double>::infinity());
        picture_.normals.resize(pixels);
        picture_.objects.assign(pixels, -1);
        picture_.functions.assign(pixels, -1);
        picture_.colours.resize(pixels);
    }

    void run(const Task& task) {
        const std::vector<Tile> tiles = tiles_showing(scene_.cover(), camera_, picture_.size);
        for (std::size_t first = 0; first < tiles.size(); first += kTilesBetweenReports) {
            task.report(static_cast<double>(first) / static_cast<double>(tiles.size()), "rendering");
            const std::size_t count = std::min(kTilesBetweenReports, tiles.size() - first);
            parallel_chunks(count, 1, task,
                            [&](std::size_t begin, std::size_t) { draw(tiles[first + begin], task); });
        }
        task.report(1, "rendering");
    }

    Picture take() { return std::move(picture_); }

  private:
    static constexpr std::size_t kTilesBetweenReports = 512;

    void draw(const Tile& tile, const Task& task) {
        for (int y = tile.top; y < tile.bottom; ++y) {
            task.check();
            for (int x = tile.left; x < tile.right; ++x) draw(x, y);
        }
    }

    void draw(int x, int y) {
        const PictureSize& size = picture_.size;
        const Ray ray = camera_.ray((2 * x + 1 - size.width) / (1.0 * size.width),
                                    (size.height - 2 * y - 1) / (1.0 * size.height));
        const SurfaceHit hit = scene_.first_hit(ray);
        if (!hit.found()) return;
        const auto i =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) + static_cast<std::size_t>(x);
        const Vec3& n = hit.normal;
        picture_.depth[i] = hit.t;
        picture_.normals[i] = {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
        picture_.objects[i] = hit.object;
        picture_.functions[i] = hit.function;
        picture_.colours[i] = shading_.colour(n, ray.direction);
    }

    const RayScene& scene_;
    const Camera& camera_;
    Shading shading_;
    Picture picture_;
};

}  // namespace

std::vector<SurfaceHit> cast_rays(const RayScene& scene, std::span<const Ray> rays, const RaySpan& span,
                                  const Task& task) {
    std::vector<SurfaceHit> hits(rays.size());
    parallel_chunks(rays.size(), kRays, task, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            task.check();
            if (is_castable(rays[i])) hits[i] = scene.first_hit(rays[i], span);
        }
    });
    return hits;
}

Picture render(const RayScene& scene, const Camera& camera, const PictureSize& size, const Task& task) {
    check_size(size);
    Renderer renderer(scene, camera, size);
    renderer.run(task);
    return renderer.take();
}

}  // namespace pfgeom
