// The surface at a distance from a model's, refitted: the level of the distance field is polygonized well
// within the tolerance, and what that leaves is for the functions.
#include "pfgeom/algebra/closed.h"
#include "pfgeom/base/error.h"
#include "pfgeom/base/parallel.h"
#include "pfgeom/codec/codec.h"
#include "pfgeom/compress/compress.h"
#include "pfgeom/compress/inside_mesh.h"
#include "pfgeom/compress/object_mesh.h"
#include "pfgeom/eval/distance_field.h"
#include "pfgeom/mesh/islands.h"
#include "pfgeom/polygonize/placed_field.h"
#include "pfgeom/polygonize/polygonize.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace pfgeom {
namespace {

// Chord of the level's mesh, in tolerances.
constexpr double kChord = 0.125;
// The smallest cells, in tolerances. Creases of the level are cut off by them: of a cube shrunk by a tenth of
// its diagonal 1/4, 1/2, 1 leave 0.10, 0.08, 0.21 tolerances and 105,000, 53,000, 25,000 triangles.
constexpr double kCell = 0.5;
// Of what is left: files round a tolerance up by 2^-16, and bounds are rounded against it.
constexpr double kRounding = 1 - 1e-4;
// Distances, in diagonals: at the default tolerance a sphere of this radius has more triangles than one call
// may make.
constexpr double kFarthest = 1000;
constexpr std::size_t kChunk = 256;  // faces a job

// Positive where the mesh is nearer than the distance, or encloses the point.
class OffsetField final : public ScalarField {
  public:
    OffsetField(const TriangleMesh& mesh, double distance, const Task& task)
        : field_(mesh, task), distance_(distance) {}

    double value(const Vec3& p) const override { return field_.value(p) + distance_; }
    double value_and_gradient(const Vec3& p, Vec3& gradient) const override {
        return field_.value_and_gradient(p, gradient) + distance_;
    }
    Interval range(const Box& box) const override {
        const Interval own = field_.range(box);
        return {own.lo + distance_, own.hi + distance_};
    }
    Box bounds() const {
        const double reach = std::max(distance_, 0.0);
        const Box own = field_.bounds();
        return {own.lo - Vec3{reach, reach, reach}, own.hi + Vec3{reach, reach, reach}};
    }

  private:
    DistanceField field_;
    double distance_;
};

// May pieces of the mesh lie in or across each other? Of very many it is taken for granted.
bool pieces_may_meet(const TriangleMesh& mesh) {
    constexpr std::size_t kMany = 4096;
    const std::vector<std::vector<std::int32_t>> pieces = find_pieces(mesh);
    if (pieces.size() > kMany) return true;
    std::vector<Box> boxes(pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        for (const std::int32_t v : pieces[i]) boxes[i].grow(mesh.vertices[v]);
        for (std::size_t j = 0; j < i; ++j) {
            const Box common{max(boxes[i].lo, boxes[j].lo), min(boxes[i].hi, boxes[j].hi)};
            if (common.lo.x <= common.hi.x && common.lo.y <= common.hi.y && common.lo.z <= common.hi.z)
                return true;
        }
    }
    return false;
}

// Distance counts from the surface between inside and outside, not from what lies inside of other pieces.
TriangleMesh surface_of(const Model& model, const Task& task) {
    TriangleMesh mesh = to_mesh(model, {}, part_of(task, 0, 0.5));
    return pieces_may_meet(mesh) ? mesh_of_inside(model, {}, part_of(task, 0.5, 1)) : mesh;
}

TriangleMesh level_mesh(const std::shared_ptr<const OffsetField>& field, double tolerance, const Task& task) {
    const Frame frame = Frame::around(field->bounds());
    PolygonizeOptions how;
    how.tolerance = kChord * tolerance / frame.half();
    how.max_depth = std::max(how.min_depth, depth_for(frame.half(), kCell * tolerance));
    TriangleMesh mesh = polygonize(PlacedField(field, affine_of(frame)), how, task);
    for (Vec3& v : mesh.vertices) v = frame.to_world(v);
    return mesh;
}

// How far the mesh is from the level: where it is smooth the field's value is that distance.
struct Miss {
    double max = 0, squares = 0, area = 0;

    void add(const Miss& other) {
        max = std::max(max, other.max);
        squares += other.squares;
        area += other.area;
    }
    double rms() const { return area > 0 ? std::sqrt(squares / area) : 0; }
};

Miss miss_of_face(const OffsetField& field, const Vec3& a, const Vec3& b, const Vec3& c) {
    Miss miss;
    miss.area = norm(cross(b - a, c - a)) / 2;
    for (const Vec3& p : {(a + b + c) / 3, (a + b) * 0.5, (b + c) * 0.5, (c + a) * 0.5}) {
        const double off = std::abs(field.value(p));
        miss.max = std::max(miss.max, off);
        miss.squares += off * off * miss.area / 4;
    }
    return miss;
}

Miss miss_of(const OffsetField& field, const TriangleMesh& mesh, const Task& task) {
    const std::size_t count = mesh.faces.size();
    std::vector<Miss> misses((count + kChunk - 1) / kChunk);
    parallel_chunks(count, kChunk, task, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            const auto& [i, j, k] = mesh.faces[f];
            misses[begin / kChunk].add(
                miss_of_face(field, mesh.vertices[i], mesh.vertices[j], mesh.vertices[k]));
        }
    });
    Miss all;
    for (const Miss& miss : misses) all.add(miss);
    return all;
}

// What is known of the functions against the level, by way of its mesh.
void widen(Promise& promise, double tolerance, const Miss& miss) {
    promise.tolerance = tolerance;
    promise.bound_mesh += miss.max;
    promise.rms += miss.rms();
    promise.certified = promise.functions_certified = false;
    if (promise.bound_functions > 0) promise.bound_functions += miss.max;
}

void check_offset(const Model& model, double distance, const CompressOptions& options) {
    if (!std::isfinite(distance)) throw InvalidInput("an offset's distance must be a finite number");
    if (!(options.tolerance > 0 && std::isfinite(options.tolerance)))
        throw InvalidInput("the tolerance must be a positive number");
    if (std::abs(distance) > kFarthest * model.diagonal)
        throw InvalidInput(
            "an offset's distance is too far: more than a thousand times the model's diagonal");
    require_closed(model);
}

}  // namespace

Compressed offset(const Model& model, double distance, CompressOptions options, const Task& task) {
    check_offset(model, distance, options);
    const double tolerance = options.tolerance * (options.relative ? model.diagonal : 1.0);
    const TriangleMesh surface = surface_of(model, part_of(task, 0, 0.1));
    if (surface.faces.empty()) throw InvalidInput("a model without a surface has no offset");
    const auto field = std::make_shared<const OffsetField>(surface, distance, task);
    const TriangleMesh level = level_mesh(field, tolerance, part_of(task, 0.1, 0.3));
    if (level.faces.empty())
        throw InvalidInput("the offset leaves nothing: no point is as deep inside as the distance");
    const Miss miss = miss_of(*field, level, quiet(task, task.threads));
    const double used = options.metric == Metric::max ? miss.max : miss.rms();
    if (!(used < tolerance)) throw LimitExceeded("the offset's surface is too fine for the tolerance");
    options.tolerance = (tolerance - used) * kRounding;
    options.relative = false;
    Compressed result = compress(level, options, part_of(task, 0.3, 1));
    widen(result.model.promise, tolerance, miss);
    result.bytes = encode(result.model);
    result.model = *decode(result.bytes);
    return result;
}

}  // namespace pfgeom
