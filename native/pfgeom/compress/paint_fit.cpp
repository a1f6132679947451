#include "pfgeom/compress/paint_fit.h"

#include "pfgeom/base/parallel.h"
#include "pfgeom/codec/material_codec.h"
#include "pfgeom/compress/object_mesh.h"
#include "pfgeom/eval/nearest_quadric.h"
#include "pfgeom/mesh/sample.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace pfgeom {
namespace {

// Of the tolerance: nearer to a border than this a sample may have either material. What is left is for the
// faces' own deviation and for what lies between the samples.
constexpr double kNear = 0.6;
// Distances from a border at which samples are taken, in tolerances: two that it may move over, then the
// first that it may not, and on to what is known from the samples all over the surface.
constexpr double kOffsets[] = {0.25, 0.5, 0.7, 1, 1.6, 2.6, 4.5};
constexpr double kSpacing = 0.75;  // along it
constexpr std::size_t kMostBand = 150'000;
constexpr std::size_t kEverywhere = 20'000, kMeasured = 60'000;
// Weights of a question against what it settles (MaterialFit::plane_weight), as many as the effort says; the
// fewest bytes win.
constexpr double kWeights[] = {8, 40, 2};
constexpr int kRounds = 4;
constexpr std::size_t kChunk = 256;
constexpr std::uint64_t kSeed = 11, kMeasureSeed = 12;

}  // namespace

PaintFit::PaintFit(const Model& model, const Object& object, double tolerance, std::size_t materials,
                   Effort effort, const Task& task)
    : model_(model),
      object_(object),
      tolerance_(tolerance),
      materials_(materials),
      effort_(effort),
      task_(task),
      mesh_(mesh_in_place(model, {model.objects, model.diagonal}, object, quiet(task, task.threads))),
      bvh_(mesh_, task) {
    const auto* tree = std::get_if<SetTree>(&object.shape);
    if (tree != nullptr && !tree->quadrics.empty())
        quadrics_ = nearest_quadrics(*tree, object.frame, mesh_, quiet(task, task.threads));
}

// The point of the object's mesh next to `near`, a point of the world.
void PaintFit::add_sample(const PaintedCopy& copy, const Vec3& near, Samples& samples) const {
    const ClosestPoint at = bvh_.closest(copy.place.apply_inverse(near));
    MaterialSample sample = copy.surface->ask(copy.place.apply(at.point), kNear * tolerance_);
    sample.p = object_.frame.to_local(at.point);
    samples.list.push_back(sample);
    samples.tree.push_back(quadrics_.empty() ? 0 : quadrics_[static_cast<std::size_t>(at.face)]);
}

// `share`: of how many copies this is one.
void PaintFit::add_samples(const PaintedCopy& copy, std::size_t share, Samples& samples) const {
    std::vector<Vec3> points;
    for (const Vec3& p :
         sample_surface(mesh_, std::max<std::size_t>(kEverywhere / share, 1000), kSeed).points)
        points.push_back(copy.place.apply(p));
    double length = 0;
    for (const BorderEdge& e : copy.surface->borders()) length += norm(e.to - e.from);
    const std::size_t pieces = kMostBand / share / (2 * std::size(kOffsets));
    const double spacing =
        std::max(kSpacing * tolerance_, length / static_cast<double>(std::max<std::size_t>(pieces, 1)));
    double left = 0;  // of the way to the next place
    for (const BorderEdge& e : copy.surface->borders()) {
        const Vec3 along = e.to - e.from, across = normalized(cross(along, e.normal));
        const double size = norm(along);
        while (left < size) {
            const Vec3 middle = e.from + along * (left / size);
            for (const double offset : kOffsets) {
                points.push_back(middle + across * (offset * tolerance_));
                points.push_back(middle - across * (offset * tolerance_));
            }
            left += spacing;
        }
        left -= size;
    }
    const std::size_t chunks = (points.size() + kChunk - 1) / kChunk;
    std::vector<Samples> parts(chunks);
    parallel_chunks(points.size(), kChunk, quiet(task_, task_.threads),
                    [&](std::size_t begin, std::size_t end) {
                        for (std::size_t i = begin; i < end; ++i)
                            add_sample(copy, points[i], parts[begin / kChunk]);
                    });
    for (const Samples& part : parts) {
        samples.list.insert(samples.list.end(), part.list.begin(), part.list.end());
        samples.tree.insert(samples.tree.end(), part.tree.begin(), part.tree.end());
    }
}

std::vector<BorderPiece> PaintFit::border_pieces(const PaintedCopy& copy) const {
    std::vector<BorderPiece> pieces;
    for (const BorderEdge& e : copy.surface->borders()) {
        const Vec3 across = copy.place.turn_back(normalized(cross(e.to - e.from, e.normal)));
        pieces.push_back({object_.frame.to_local(copy.place.apply_inverse((e.from + e.to) / 2)), across});
    }
    return pieces;
}

Paint PaintFit::fitted(const Samples& samples, std::span<const BorderPiece> borders, bool by_quadric,
                       double weight) const {
    const MaterialFit options{tolerance_ / object_.frame.half(), weight};
    const Task task = quiet(task_, 1);
    Paint paint;
    paint.by_quadric = by_quadric;
    if (!by_quadric) {
        paint.trees.push_back(fit_material_tree(samples.list, borders, options, task));
        return paint;
    }
    std::vector<std::vector<MaterialSample>> of_tree(std::get<SetTree>(object_.shape).quadrics.size());
    for (std::size_t i = 0; i < samples.list.size(); ++i)
        of_tree[static_cast<std::size_t>(samples.tree[i])].push_back(samples.list[i]);
    std::int32_t last = samples.list.front().material;  // for quadrics that are met nowhere: what is cheapest
    for (const auto& list : of_tree) {
        paint.trees.push_back(list.empty() ? plain_paint(last).trees.front()
                                           : fit_material_tree(list, borders, options, task));
        last = paint.trees.back().nodes.back().material;
    }
    return paint;
}

std::size_t PaintFit::bytes_of(const Paint& paint) const {
    Model alone;
    alone.objects = {object_};
    alone.materials.names.resize(materials_);
    alone.materials.objects = {{paint}};
    return write_materials(alone).size();
}

Paint PaintFit::cheapest(const Samples& samples, std::span<const BorderPiece> borders) const {
    const std::size_t tries = effort_ == Effort::fast ? 1 : effort_ == Effort::normal ? 2 : 3;
    Paint best;
    std::size_t least = SIZE_MAX;
    for (std::size_t k = 0; k < tries; ++k) {
        for (const bool by_quadric : {true, false}) {
            if (by_quadric && quadrics_.empty()) continue;
            Paint paint = fitted(samples, borders, by_quadric, kWeights[k]);
            const std::size_t bytes = bytes_of(paint);
            if (bytes >= least) continue;
            least = bytes;
            best = std::move(paint);
        }
    }
    return best;
}

Paint PaintFit::fit(std::span<const PaintedCopy> copies, PaintError& error) {
    Samples samples;
    std::vector<BorderPiece> borders;
    for (const PaintedCopy& copy : copies) {
        add_samples(copy, copies.size(), samples);
        const std::vector<BorderPiece> more = border_pieces(copy);
        borders.insert(borders.end(), more.begin(), more.end());
    }
    Paint best;
    for (int round = 0; round < kRounds; ++round) {
        Paint paint = cheapest(samples, borders);
        Samples strays;
        const PaintError now = measure(paint, copies, &strays);
        if (round == 0 || now.stray < error.stray || (now.stray == error.stray && now.wrong < error.wrong)) {
            best = std::move(paint);
            error = now;
        }
        if (strays.list.empty()) break;
        samples.list.insert(samples.list.end(), strays.list.begin(), strays.list.end());
        samples.tree.insert(samples.tree.end(), strays.tree.begin(), strays.tree.end());
    }
    return best;
}

PaintError PaintFit::measure(const Paint& paint, std::span<const PaintedCopy> copies) {
    return measure(paint, copies, nullptr);
}

PaintError PaintFit::measure(const Paint& paint, std::span<const PaintedCopy> copies, Samples* strays) {
    TriangleMesh mesh = mesh_;
    const std::vector<std::int32_t> materials =
        paint_mesh(mesh, object_, paint, border_snap(model_), quiet(task_, task_.threads));
    const std::size_t count = std::max<std::size_t>(kMeasured / copies.size(), 2000);
    const SurfaceSamples points = sample_surface(mesh, count, kMeasureSeed);
    PaintError error;
    for (const PaintedCopy& copy : copies) {
        std::vector<std::uint8_t> verdict(count);  // 1: wrong, 2: stray
        parallel_chunks(count, kChunk, quiet(task_, task_.threads), [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const MaterialSample truth =
                    copy.surface->ask(copy.place.apply(points.points[i]), tolerance_);
                const std::int32_t m = materials[static_cast<std::size_t>(points.faces[i])];
                verdict[i] = m == truth.material ? 0 : truth.allows(m) ? 1 : 2;
            }
        });
        const double each =
            surface_area(mesh) * copy.place.scale * copy.place.scale / static_cast<double>(count);
        for (std::size_t i = 0; i < count; ++i) {
            error.area += each;
            error.wrong += verdict[i] > 0 ? each : 0;
            error.stray += verdict[i] > 1 ? each : 0;
            if (verdict[i] > 1 && strays != nullptr)
                add_sample(copy, copy.place.apply(points.points[i]), *strays);
        }
    }
    return error;
}

bool PaintFit::agree(std::span<const PaintedCopy> copies) {
    PaintError error;
    const Paint paint = fit(copies.first(1), error);
    for (const PaintedCopy& copy : copies.subspan(1)) {
        const PaintError here = measure(paint, {&copy, 1});
        if (here.stray > 2 * error.stray + 1e-3 * here.area) return false;
    }
    return true;
}

}  // namespace pfgeom
