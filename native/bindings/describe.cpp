#include "describe.h"

#include "pfgeom/codec/codec.h"
#include "pfgeom/function/quadric_family.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string>

namespace py = pybind11;
using namespace py::literals;

namespace pfgeom::bindings {
namespace {

py::dict describe_shape(const Solid& solid) {
    return py::dict("kind"_a = "solid", "nodes"_a = solid.nodes.size());
}
py::dict describe_shape(const Sheet& sheet) {
    const auto planes = std::ranges::count_if(sheet.cut.nodes, std::not_fn(&MaterialNode::leaf));
    return py::dict("kind"_a = "sheet", "cutting_planes"_a = planes);
}
py::dict describe_shape(const MeshPart& part) {
    return py::dict("kind"_a = part.curved() ? "patches" : "mesh", "vertices"_a = part.positions.size(),
                    "faces"_a = part.faces.size(), "mirrored"_a = part.mirror.has_value());
}
// Its quadrics by family, in the order of the families.
py::dict describe_shape(const SetTree& tree) {
    std::array<int, kQuadricFamilies> count{};
    for (const TreeQuadric& q : tree.quadrics) ++count[q.family];
    py::dict families;
    for (std::size_t i = 0; i < kQuadricFamilies; ++i) {
        if (count[i] > 0) families[py::str(std::string(quadric_families()[i].name))] = count[i];
    }
    return py::dict("kind"_a = "tree", "nodes"_a = tree.nodes.size(), "quadrics"_a = tree.quadrics.size(),
                    "families"_a = families);
}

void add_normals(py::dict& figures, const NormalAngles& all, const NormalAngles& smooth) {
    figures["normal_deg_mean"] = all.mean, figures["normal_deg_p99"] = all.p99;
    figures["normal_deg_max"] = all.max, figures["smooth_normal_deg_mean"] = smooth.mean;
    figures["smooth_normal_deg_p99"] = smooth.p99, figures["smooth_normal_deg_max"] = smooth.max;
}

py::dict describe_one_sided(const OneSided& side) {
    py::dict figures("max"_a = side.max, "max_bound"_a = side.max_bound, "rms"_a = side.rms,
                     "mean"_a = side.mean, "p99"_a = side.p99,
                     "worst"_a = py::make_tuple(side.worst.x, side.worst.y, side.worst.z));
    add_normals(figures, side.normals, side.smooth_normals);
    return figures;
}

py::dict describe_figures(const DepthFigures& f) {
    return py::dict("both"_a = f.both, "only_a"_a = f.only_a, "only_b"_a = f.only_b, "mean"_a = f.mean(),
                    "max"_a = f.max, "away"_a = f.away, "away_mean"_a = f.away_mean(),
                    "away_max"_a = f.away_max, "differing"_a = f.differing,
                    "differing_away"_a = f.differing_away, "silhouette_away"_a = f.silhouette_away);
}

py::dict describe_defects(const MeshDefects& d) {
    return py::dict("unused_vertices"_a = d.unused_vertices, "duplicate_vertices"_a = d.duplicate_vertices,
                    "degenerate_faces"_a = d.degenerate_faces, "duplicate_faces"_a = d.duplicate_faces,
                    "boundary_edges"_a = d.boundary_edges, "seam_edges"_a = d.seam_edges,
                    "non_manifold_edges"_a = d.non_manifold_edges,
                    "non_manifold_vertices"_a = d.non_manifold_vertices,
                    "misoriented_edges"_a = d.misoriented_edges);
}

}  // namespace

py::tuple describe_functions(const Model& model) {
    const FunctionCount count = count_functions(model);
    return py::make_tuple(count.surface, count.separators, count.perturbations, count.mesh_part_faces,
                          count.patches);
}

py::list describe_objects(const Model& model) {
    py::list objects;
    for (const Object& object : model.objects) {
        py::dict entry = std::visit([](const auto& shape) { return describe_shape(shape); }, object.shape);
        entry["cavity_of"] = object.cavity_of < 0 ? py::object(py::none()) : py::int_(object.cavity_of);
        entry["instances"] = copies_of(object).size();
        objects.append(entry);
    }
    return objects;
}

py::dict describe_promise(const Model& model) {
    const Promise& promise = model.promise;
    return py::dict("metric"_a = promise.metric == Metric::max ? "max" : "rms",
                    "tolerance"_a = promise.tolerance, "bound_mesh"_a = promise.bound_mesh,
                    "certified"_a = promise.certified, "rms"_a = promise.rms,
                    "bound_functions"_a = promise.bound_functions,
                    "functions_certified"_a = promise.functions_certified, "diagonal"_a = model.diagonal);
}

py::dict describe_sizes(const Model& model) {
    const SizeReport sizes = measure_size(model);
    return py::dict("total"_a = sizes.total, "head"_a = sizes.head, "by_object"_a = sizes.bytes_of_object,
                    "by_level"_a = sizes.bytes_of_level);
}

py::dict describe_deviation(const Deviation& d) {
    py::dict figures("max"_a = d.max(), "max_bound"_a = d.max_bound(), "rms"_a = d.rms(), "mean"_a = d.mean(),
                     "p99"_a = d.p99(), "certified"_a = d.certified,
                     "a_to_b"_a = describe_one_sided(d.a_to_b), "b_to_a"_a = describe_one_sided(d.b_to_a));
    add_normals(figures, d.normals(), d.smooth_normals());
    return figures;
}

py::dict describe_depths(const DepthComparison& depths) {
    py::list views;
    for (const DepthView& view : depths.views) {
        const Vec3& d = view.direction;
        views.append(py::dict("direction"_a = py::make_tuple(d.x, d.y, d.z), "pixel"_a = view.pixel,
                              "figures"_a = describe_figures(view.figures)));
    }
    return py::dict("total"_a = describe_figures(depths.total), "views"_a = views);
}

py::dict describe_report(const CompressReport& report) {
    py::list islands;
    for (const IslandReport& island : report.islands)
        islands.append(py::dict("faces"_a = island.faces, "candidate"_a = island.candidate,
                                "copies"_a = island.copies, "bytes"_a = island.bytes));
    return py::dict("vertices"_a = report.input_vertices, "faces"_a = report.input_faces,
                    "raw_bytes"_a = report.raw_bytes, "mesh_faces"_a = report.mesh_faces,
                    "deviation"_a = describe_deviation(report.deviation), "islands"_a = islands,
                    "materials"_a = py::dict("bytes"_a = report.paint.bytes, "right"_a = report.paint.right,
                                             "stray"_a = report.paint.stray),
                    "defects"_a = describe_defects(report.defects));
}

}  // namespace pfgeom::bindings
