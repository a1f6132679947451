// Samples of the original surface, each on the face of the current mesh that it was found closest to. Those
// of a face lie side by side: as one list through all of them, in the order in which they had come to their
// faces, waiting for memory took a quarter of the time of collapses (igea).
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/mesh/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pfgeom {

struct MissedPoint;

struct FaceSample {
    Vec3 p;
    double weight = 0;         ///< area that it stands for
    double squared = 0;        ///< distance to the current mesh
    std::int32_t origin = -1;  ///< face of the original
};

class FaceSamples {
  public:
    /// Of vertices, faces and edges; `spacing` is that on larger faces and edges. The current mesh is the
    /// original.
    FaceSamples(const TriangleMesh& original, double spacing);

    /// The mesh that changes begins as a part of the original only, whose faces stand first in it. Returns
    /// the weighted sum of the squared distances.
    double start_from(const TriangleMesh& part, const Task& task);

    /// The last that came is the last.
    const std::vector<FaceSample>& of(std::int32_t face) const {
        return of_faces_[static_cast<std::size_t>(face)];
    }
    double total_weight() const { return total_weight_; }
    double mean_weight() const { return total_weight_ / static_cast<double>(count_); }

    /// More of them, without a weight.
    void add(const std::vector<MissedPoint>& missed);
    /// For faces with higher ids than the original's.
    void make_room(std::size_t face_ids) { of_faces_.resize(face_ids); }

    /// Handing over: a face's samples go ...
    void clear(std::int32_t face) { of_faces_[static_cast<std::size_t>(face)].clear(); }
    /// ... and come to others. Different faces may be handed over by different threads.
    void put(std::int32_t face, const FaceSample& sample) {
        of_faces_[static_cast<std::size_t>(face)].push_back(sample);
    }

  private:
    void add(const Vec3& p, double weight, std::size_t face);
    void sample_faces(const TriangleMesh& mesh, double spacing);
    void sample_edges(const TriangleMesh& mesh, double spacing);

    std::vector<std::vector<FaceSample>> of_faces_;
    std::size_t count_ = 0;
    double total_weight_ = 0;
};

}  // namespace pfgeom
