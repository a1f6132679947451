#include "pfgeom/compress/inside_mesh.h"

#include "pfgeom/compress/object_mesh.h"
#include "pfgeom/eval/model_field.h"
#include "pfgeom/polygonize/polygonize.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace pfgeom {
namespace {

constexpr int kMostDepthOfAll = 16;  // of objects of very different sizes

// Of all copies of all objects of all operands.
struct Extremes {
    double chord = std::numeric_limits<double>::infinity(), half = chord;
};

Extremes extremes_of(const Model& model, const std::vector<CombinationNode>& tree) {
    Extremes least;
    for (const CombinationNode& node : tree) {
        const double stretch = node.moved ? most_stretch(node.place) : 1;
        for (std::int32_t i = node.first; i < node.last; ++i) {
            const Object& object = model.objects[static_cast<std::size_t>(i)];
            const double scale = stretch * largest_scale(object);
            least.chord = std::min(least.chord, chord_of(object, node.diagonal) * scale);
            least.half = std::min(least.half, object.frame.half() * scale);
        }
    }
    return least;
}

}  // namespace

// One cube for all. Without a tolerance the finest of the objects' chords serves; cells may be as fine as
// each object's own would be.
TriangleMesh mesh_of_inside(const Model& model, const MeshOptions& options, const Task& task) {
    const Box box = ModelField(model).bounds();
    const Vec3 extent = box.hi - box.lo;
    if (!(extent.x > 0 && extent.y > 0 && extent.z > 0)) return {};
    const Frame frame = Frame::around(box);
    const Extremes least = extremes_of(model, combination_tree(model));
    PolygonizeOptions how;
    how.min_depth = kLeastDepth;
    how.max_depth =
        std::min(kMostDepth + depth_for(frame.half(), 2 * least.half) - kLeastDepth, kMostDepthOfAll);
    how.tolerance = (options.tolerance ? *options.tolerance : least.chord) / frame.half();
    if (options.resolution) {
        const double cell = std::max({extent.x, extent.y, extent.z}) / *options.resolution;
        how.min_depth = how.max_depth = depth_for(frame.half(), cell);
    }
    TriangleMesh mesh = polygonize_combination(model, frame, how, task);
    for (Vec3& v : mesh.vertices) v = frame.to_world(v);
    return mesh;
}

}  // namespace pfgeom
