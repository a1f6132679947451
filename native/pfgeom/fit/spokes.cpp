#include "pfgeom/fit/spokes.h"

#include <algorithm>

namespace pfgeom {
namespace {

// Faces that meet at more than 73 degrees make a crease. At 37 degrees coarse meshes of round shapes (spot at
// 5e-3) are full of them, and bulges sideways take half as many bytes as those along the normals.
constexpr double kCreaseCosine = 0.3;
// A bulge is at most this share of its chord: a half circle has a half.
constexpr double kMostBulge = 0.3;

// With the image of its one face.
void join(Spoke& s, int axis) {
    s.fold = 1 - 2 * s.normal[axis] * s.normal[axis];
    s.normal[axis] = 0;
    s.faces = 2;
    s.seam = true;
}

}  // namespace

Spokes::Spokes(const Patch& patch) {
    std::vector<Vec3> first_normal;
    for (std::size_t row = 0; row < patch.triangles.size(); ++row) {
        const auto& t = patch.triangles[row];
        const Vec3 normal = normalized(cross(t[1] - t[0], t[2] - t[0]));
        of_row_.emplace_back();
        for (std::size_t k = 0; k < 2; ++k) {
            const std::int32_t end = patch.ends[row][k];
            const auto known =
                std::find_if(list_.begin(), list_.end(), [&](const Spoke& s) { return s.end == end; });
            const auto i = static_cast<std::size_t>(known - list_.begin());
            of_row_.back()[k] = i;
            if (known == list_.end()) {
                list_.push_back({end, t[k + 1] - t[0], normal, {}, 1, 1, false, false, nullptr});
                first_normal.push_back(normal);
                continue;
            }
            const double cosine = dot(first_normal[i], normal);
            known->normal += cosine < 0 ? -normal : normal;
            known->fold = std::min(known->fold, cosine);
            ++known->faces;
        }
    }
    for (Spoke& s : list_) {
        if (patch.fixed_axis != Patch::kNoAxis && s.along[patch.fixed_axis] == 0) join(s, patch.fixed_axis);
        s.bent = !s.seam && (s.fold < kCreaseCosine || s.faces != 2);
        const Vec3 along = normalized(s.along);
        s.normal = normalized(s.normal - along * dot(along, s.normal));
        s.sideways = cross(s.normal, along);
    }
}

const Vec3& Spokes::bulge(const Patch& patch, std::size_t spoke) const {
    std::size_t row = 0;
    while (of_row_[row][0] != spoke && of_row_[row][1] != spoke) ++row;
    return patch.bulges[row][of_row_[row][0] == spoke ? 0 : 2];
}

void Spokes::set(Patch& patch, std::size_t spoke, const Vec3& bulge) const {
    const double most = kMostBulge * norm(list_[spoke].along), size = norm(bulge);
    const Vec3 kept = size > most ? bulge * (most / size) : bulge;
    for (std::size_t row = 0; row < of_row_.size(); ++row) {
        if (of_row_[row][0] == spoke) patch.bulges[row][0] = kept;
        if (of_row_[row][1] == spoke) patch.bulges[row][2] = kept;
    }
}

}  // namespace pfgeom
