// The edges at the moving vertex of a curved patch: what their bulges may be.
#pragma once

#include "pfgeom/fit/collapse_mesh.h"

#include <array>
#include <cstddef>
#include <vector>

namespace pfgeom {

class Bvh;

struct Spoke {
    std::int32_t end = -1;
    Vec3 along;             ///< from the moving vertex
    Vec3 normal, sideways;  ///< unit vectors across it, or zero: the mean of the faces', and within them
    double fold = 1;        ///< cosine between the normals of its two faces
    int faces = 0;          ///< with images
    bool bent = false;      ///< it may bulge sideways too
    bool seam = false;      ///< it lies on the mirror's plane: its face has an image, and it bulges within
    const Bvh* line = nullptr;  ///< the border or the crease of the original that it follows
};

class Spokes {
  public:
    explicit Spokes(const Patch& patch);

    const std::vector<Spoke>& list() const { return list_; }
    std::vector<Spoke>& list() { return list_; }
    /// Of a row of the patch: the spokes to its corners 1 and 2.
    const std::array<std::size_t, 2>& of_row(std::size_t row) const { return of_row_[row]; }
    /// Sets a spoke's bulge in all rows, no longer than it may be.
    void set(Patch& patch, std::size_t spoke, const Vec3& bulge) const;
    const Vec3& bulge(const Patch& patch, std::size_t spoke) const;

  private:
    std::vector<Spoke> list_;
    std::vector<std::array<std::size_t, 2>> of_row_;
};

}  // namespace pfgeom
