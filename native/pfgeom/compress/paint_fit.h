// The materials of one object: samples, the trees with the fewest bytes, and what of the mesh has the wrong
// material then.
#pragma once

#include "pfgeom/compress/compress.h"
#include "pfgeom/compress/labelled_surface.h"
#include "pfgeom/mesh/bvh.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

/// A copy of the object, and the input that it stands for.
struct PaintedCopy {
    const LabelledSurface* surface = nullptr;
    Similarity place;
};

struct PaintError {
    double area = 0;   ///< looked at
    double wrong = 0;  ///< of it, has not the material of the input's surface beside it
    double stray = 0;  ///< of that, is farther than the tolerance from the border to the material it has

    PaintError& operator+=(const PaintError& more) {
        area += more.area, wrong += more.wrong, stray += more.stray;
        return *this;
    }
};

class PaintFit {
  public:
    /// `tolerance` in the mesh's units; `materials`: how many there are.
    PaintFit(const Model& model, const Object& object, double tolerance, std::size_t materials, Effort effort,
             const Task& task);

    /// The object's, in place.
    const TriangleMesh& mesh() const { return mesh_; }

    /// One paint for all these copies, and what it misses; the second is what `best_of` compares.
    Paint fit(std::span<const PaintedCopy> copies, PaintError& error);
    /// Whether what is known of the copies agrees, so that one paint can serve them all.
    bool agree(std::span<const PaintedCopy> copies);
    PaintError measure(const Paint& paint, std::span<const PaintedCopy> copies);

  private:
    struct Samples {
        std::vector<MaterialSample> list;
        std::vector<std::int32_t> tree;  // which tree serves it, if there is one for each quadric
    };
    void add_sample(const PaintedCopy& copy, const Vec3& near, Samples& samples) const;
    void add_samples(const PaintedCopy& copy, std::size_t share, Samples& samples) const;
    std::vector<BorderPiece> border_pieces(const PaintedCopy& copy) const;
    Paint cheapest(const Samples& samples, std::span<const BorderPiece> borders) const;
    Paint fitted(const Samples& samples, std::span<const BorderPiece> borders, bool by_quadric,
                 double weight) const;
    std::size_t bytes_of(const Paint& paint) const;
    PaintError measure(const Paint& paint, std::span<const PaintedCopy> copies, Samples* strays);

    const Model& model_;
    const Object& object_;
    double tolerance_;
    std::size_t materials_;
    Effort effort_;
    const Task& task_;
    TriangleMesh mesh_;                   // in place
    std::vector<std::int32_t> quadrics_;  // of its faces, if it is a set tree
    Bvh bvh_;
};

}  // namespace pfgeom
