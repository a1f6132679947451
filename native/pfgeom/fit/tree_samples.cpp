#include "pfgeom/fit/tree_samples.h"

#include "pfgeom/base/parallel.h"
#include "pfgeom/base/random.h"
#include "pfgeom/mesh/sample.h"

#include <algorithm>
#include <utility>

namespace pfgeom {
namespace {

constexpr double kShellRatio = 1.7;
constexpr double kFarthest = 0.5;            // of the box's diagonal
constexpr std::size_t kLeastOfShell = 3000;  // far shells are few and large, so is what they see
constexpr std::size_t kMostFaces =
    100'000;                        // a million faces with their own: half the time of a fit, the same tree
constexpr double kRounding = 1e-9;  // a point set off by the tube is in distance that, but for rounding

Vec3 random_direction(Random& random) {
    for (;;) {
        const Vec3 d{2 * random.uniform() - 1, 2 * random.uniform() - 1, 2 * random.uniform() - 1};
        const double n = squared_norm(d);
        if (n > 1e-4 && n <= 1) return normalized(d);
    }
}

class Sampler {
  public:
    Sampler(const TriangleMesh& mesh, const SignedDistance& distance, const Box& box,
            const std::vector<std::int32_t>& patches, const SampleOptions& options, const Task& task)
        : mesh_(mesh), distance_(distance), box_(box), patches_(patches), options_(options), task_(task) {}

    // Both sides of surface points, along the normal and every third time in any direction.
    void add_shell(double offset, std::size_t count, std::uint64_t seed) {
        const SurfaceSamples surface = sample_surface(mesh_, count, seed);
        add(count, [&](std::size_t i, std::vector<TreeSample>& out) {
            Random random(seed * 0x9E3779B97F4A7C15ULL + i);
            const std::int32_t face = surface.faces[i];
            const Vec3 d = i % 3 == 2 ? random_direction(random) : distance_.face_normal(face);
            for (const double side : {-1.0, 1.0})
                add_point(surface.points[i] + d * (offset * side), face, out);
        });
    }

    // Above and below every face, so that small ones are seen as well; of very many, of every second, third,
    // …
    void add_faces(double offset) {
        const std::size_t stride = mesh_.faces.size() / kMostFaces + 1;
        add(mesh_.faces.size() / stride, [&](std::size_t i, std::vector<TreeSample>& out) {
            const auto face = static_cast<std::int32_t>(i * stride);
            const auto& [a, b, c] = mesh_.faces[face];
            const Vec3 p = (mesh_.vertices[a] + mesh_.vertices[b] + mesh_.vertices[c]) / 3;
            for (const double side : {-1.0, 1.0})
                add_point(p + distance_.face_normal(face) * (offset * side), face, out);
        });
    }

    std::vector<TreeSample> take() { return std::move(samples_); }

  private:
    template <class Make>
    void add(std::size_t count, const Make& make) {
        constexpr std::size_t kChunk = 512;
        std::vector<std::vector<TreeSample>> found((count + kChunk - 1) / kChunk);
        parallel_chunks(count, kChunk, task_, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) make(i, found[begin / kChunk]);
        });
        for (const auto& some : found) samples_.insert(samples_.end(), some.begin(), some.end());
    }

    void add_point(const Vec3& p, std::int32_t hint, std::vector<TreeSample>& out) const {
        if (!box_.contains(p)) return;
        const SignedClosest c = distance_(p, hint);
        if (std::abs(c.distance) < options_.tube * (1 - kRounding)) return;
        out.push_back({p, patches_[c.face], c.distance > 0});
    }

    const TriangleMesh& mesh_;
    const SignedDistance& distance_;
    const Box& box_;
    const std::vector<std::int32_t>& patches_;
    const SampleOptions& options_;
    const Task& task_;
    std::vector<TreeSample> samples_;
};

}  // namespace

std::vector<TreeSample> sample_sides(const TriangleMesh& mesh, const SignedDistance& distance, const Box& box,
                                     const std::vector<std::int32_t>& patches, const SampleOptions& options,
                                     const Task& task) {
    Sampler sampler(mesh, distance, box, patches, options, task);
    std::uint64_t seed = options.seed;
    std::size_t count = options.count;
    double shell = options.tube;
    while (shell < kFarthest * box.diagonal()) {
        sampler.add_shell(shell, count, seed++);
        shell *= kShellRatio;
        count = std::max(count / 2, std::min(options.count, kLeastOfShell));
    }
    sampler.add_faces(options.tube);
    std::vector<TreeSample> samples = sampler.take();
    Random random(seed);
    for (std::size_t i = samples.size(); i > 1; --i) std::swap(samples[i - 1], samples[random.below(i)]);
    return samples;
}

}  // namespace pfgeom
