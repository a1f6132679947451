// The public header of the whole: mesh -> model within a tolerance -> mesh. Owns the candidates, the choice
// by bytes, and the closed loop encode -> decode -> polygonize -> measure -> repair.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/function/model.h"
#include "pfgeom/mesh/face_materials.h"
#include "pfgeom/mesh/prepare.h"
#include "pfgeom/report/deviation.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pfgeom {

/// How long to look for fewer bytes. The promise is the same.
enum class Effort : std::uint8_t { fast, normal, best };

struct CompressOptions {
    double tolerance = 1e-3;  ///< > 0
    bool relative = true;     ///< tolerance is a share of the bounding box's diagonal
    Metric metric = Metric::max;
    Effort effort = Effort::normal;
};

/// What became of one island.
struct IslandReport {
    std::int64_t faces = 0;
    /// "quadric", "sheet", "tree", "hierarchy", "cut hierarchy", "mesh" or "patches".
    std::string candidate;
    std::int64_t copies = 1;  ///< so many islands, this one included, are one object
    double bytes = 0;         ///< estimated: objects share one stream, copies one pattern
};

/// How the default mesh's materials compare with the input's.
struct PaintReport {
    std::size_t bytes = 0;  ///< of the file, that the materials take
    double right = 1;       ///< share of the area that has the material of the input's surface beside it
    double stray = 0;  ///< share that has not, and is farther than the tolerance from a border of what it has
};

struct CompressReport {
    MeshDefects defects;
    std::vector<IslandReport> islands;
    std::int64_t input_vertices = 0, input_faces = 0;
    std::int64_t raw_bytes = 0;   ///< as the paper counts: 12 a vertex and 12 a triangle
    Deviation deviation;          ///< input against the default mesh, as measured at the end
    std::int64_t mesh_faces = 0;  ///< of the default mesh
    PaintReport paint;
};

struct Compressed {
    Model model;  ///< decoded from `bytes`: what everyone else will see
    std::vector<std::uint8_t> bytes;
    CompressReport report;
};

/// Throws InvalidInput, LimitExceeded, Cancelled.
Compressed compress(const TriangleMesh& mesh, const CompressOptions& options, const Task& task = {});
/// The same functions, and materials of the surface. The promise is about the surface; its materials are
/// fitted within the tolerance and measured.
Compressed compress(const PaintedMesh& mesh, const CompressOptions& options, const Task& task = {});

/// The model grown by the distance, or shrunk where that is negative (in the model's units): its surface is
/// where the distance to the surface between inside and outside, as the default mesh has it, is that. No
/// quadric's offset is a quadric but for planes, spheres and a few more, so functions are fitted anew, within
/// the tolerance of that surface; a relative one is a share of the model's diagonal. What the result's
/// promise says is about the offset of the default mesh (of a maximum, as measured at samples): what bounds
/// the model's own error may come on top. Materials, names and labels are dropped; `report` is about the mesh
/// of the offset that was compressed. Throws InvalidInput if the model has an open surface, or nothing is
/// left; LimitExceeded, Cancelled.
Compressed offset(const Model& model, double distance, CompressOptions options, const Task& task = {});

struct MeshOptions {
    /// Extra error of the mesh against the functions, in the mesh's units.
    std::optional<double> tolerance{};
    /// Cells along the longest side, 8 .. 4096; not together with tolerance.
    std::optional<int> resolution{};
    /// The default mesh of set trees goes without vertices that it can spare and, by the maximum, without
    /// low steps between its surfaces. Models with materials keep all.
    bool thin = true;
};

/// The default mesh (neither option set) is the one that the promise is about.
TriangleMesh to_mesh(const Model& model, const MeshOptions& options = {}, const Task& task = {});
/// The same surface, its faces cut along the borders of materials; no materials if the model has none.
PaintedMesh to_painted_mesh(const Model& model, const MeshOptions& options = {}, const Task& task = {});

/// The headline figure: surface functions + separators and trims + perturbations, and apart from
/// them the flat and the curved faces of mesh parts. Every distinct quadric of a tree counts as a surface
/// function, those that only separate included: which are which is a question about space, not about the
/// tree.
struct FunctionCount {
    std::int64_t surface = 0, separators = 0, perturbations = 0, mesh_part_faces = 0, patches = 0;
};
FunctionCount count_functions(const Model& model);

}  // namespace pfgeom
