// PLY and STL, binary little-endian.
#include "pfgeom/base/error.h"
#include "pfgeom/mesh/formats.h"
#include "pfgeom/mesh/value_writer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace pfgeom {
namespace {

// Single precision is what every reader expects of a PLY file. It is taken while it moves no coordinate by
// more than this share of the diagonal, far below any tolerance; else (far from the origin) double.
constexpr double kFloatShare = 1e-7;

bool fits_float(double value) {
    return !(std::abs(value) > std::numeric_limits<float>::max());
}

bool floats_suffice(const TriangleMesh& mesh) {
    const double allowed = kFloatShare * diagonal(mesh);
    return std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [&](const Vec3& v) {
        for (int axis = 0; axis < 3; ++axis)
            if (!fits_float(v[axis]) || std::abs(double{static_cast<float>(v[axis])} - v[axis]) > allowed)
                return false;
        return true;
    });
}

template <class Real>
void put_point(ValueWriter& out, const Vec3& p) {
    for (int axis = 0; axis < 3; ++axis) out.put(static_cast<Real>(p[axis]));
}

}  // namespace

std::vector<std::uint8_t> write_ply(const TriangleMesh& mesh, const FaceMaterials& materials) {
    const bool painted = !materials.of_face.empty();
    const bool single = floats_suffice(mesh);
    const std::string type = single ? "float" : "double";
    ValueWriter out(300 + mesh.vertices.size() * (single ? 12 : 24) +
                    mesh.faces.size() * (painted ? 17 : 13));
    out.put_text("ply\nformat binary_little_endian 1.0\nelement vertex " +
                 std::to_string(mesh.vertices.size()) + "\nproperty " + type + " x\nproperty " + type +
                 " y\nproperty " + type + " z\nelement face " + std::to_string(mesh.faces.size()) +
                 "\nproperty list uchar int vertex_indices\n" +
                 (painted ? "property int material_index\n" : "") + "end_header\n");
    for (const Vec3& v : mesh.vertices) single ? put_point<float>(out, v) : put_point<double>(out, v);
    for (std::size_t row = 0; row < mesh.faces.size(); ++row) {
        out.put(std::uint8_t{3});
        for (const std::int32_t v : mesh.faces[row]) out.put(v);
        if (painted) out.put(materials.of_face[row]);
    }
    return out.take();
}

std::vector<std::uint8_t> write_stl(const TriangleMesh& mesh) {
    ValueWriter out(84 + mesh.faces.size() * 50);
    std::string header = "binary STL";
    header.resize(80, ' ');
    out.put_text(header);
    out.put(static_cast<std::uint32_t>(mesh.faces.size()));
    for (const auto& [i, j, k] : mesh.faces) {
        const Vec3 corners[] = {mesh.vertices[i], mesh.vertices[j], mesh.vertices[k]};
        for (const Vec3& p : corners)
            if (!fits_float(p.x) || !fits_float(p.y) || !fits_float(p.z))
                throw InvalidInput("a coordinate is too large for STL, which has single precision");
        put_point<float>(out, normalized(cross(corners[1] - corners[0], corners[2] - corners[0])));
        for (const Vec3& p : corners) put_point<float>(out, p);
        out.put(std::uint16_t{0});
    }
    return out.take();
}

}  // namespace pfgeom
