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

    // Through the point of the picture at x, y pixels from its left and top.
    Ray ray_at(double x, double y) const {
        return camera_.ray(2 * x / picture_.size.width - 1, 1 - 2 * y / picture_.size.height);
    }

    void draw(int x, int y) {
        const Ray ray = ray_at(x + 0.5, y + 0.5);
        const SurfaceHit hit = scene_.first_hit(ray);
        const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.size.width) +
                       static_cast<std::size_t>(x);
        if (picture_.size.samples > 1) picture_.colours[i] = mean_colour(x, y);
        if (!hit.found()) return;
        const Vec3& n = hit.normal;
        picture_.depth[i] = hit.t;
        picture_.normals[i] = {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
        picture_.objects[i] = hit.object;
        picture_.functions[i] = hit.function;
        if (picture_.size.samples == 1) picture_.colours[i] = shading_.colour(n, ray.direction);
    }

    // The alpha is the share of the samples that meet something, the colour the mean of theirs.
    std::array<std::uint8_t, 4> mean_colour(int x, int y) const {
        const int n = picture_.size.samples;
        std::array<int, 4> sum{};
        int met = 0;
        for (int k = 0; k < n * n; ++k) {
            const Ray ray = ray_at(x + (k % n + 0.5) / n, y + (k / n + 0.5) / n);
            const SurfaceHit hit = scene_.first_hit(ray);
            if (!hit.found()) continue;
            ++met;
            const auto colour = shading_.colour(hit.normal, ray.direction);
            for (std::size_t c = 0; c < 4; ++c) sum[c] += colour[c];
        }
        std::array<std::uint8_t, 4> mean{};
        if (met == 0) return mean;
        for (std::size_t c = 0; c < 3; ++c) mean[c] = static_cast<std::uint8_t>((sum[c] + met / 2) / met);
        mean[3] = static_cast<std::uint8_t>((sum[3] + n * n / 2) / (n * n));
        return mean;
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
