#include "pfgeom/mesh/sample.h"

#include "pfgeom/base/error.h"
#include "pfgeom/base/random.h"

namespace pfgeom {
namespace {

Vec3 area_normal(const TriangleMesh& mesh, const Triangle& face) {
    const Vec3& a = mesh.vertices[face[0]];
    return cross(mesh.vertices[face[1]] - a, mesh.vertices[face[2]] - a);
}

// Uniform on the triangle: Osada et al., "Shape distributions", ACM Trans. Graph. 21(4), 2002, sec. 4.2.
Vec3 random_weights(Random& random) {
    const double r = std::sqrt(random.uniform()), s = random.uniform();
    return {1 - r, r * (1 - s), r * s};
}

}  // namespace

SurfaceSamples sample_surface(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed) {
    std::vector<double> area_up_to;  // and including each face
    area_up_to.reserve(mesh.faces.size());
    double total = 0;
    for (const Triangle& face : mesh.faces) area_up_to.push_back(total += norm(area_normal(mesh, face)));
    if (count == 0) return {};
    if (!(total > 0)) throw InvalidInput("a surface without area cannot be sampled");

    Random random(seed);
    SurfaceSamples samples;
    samples.points.reserve(count);
    samples.faces.reserve(count);
    samples.barycentric.reserve(count);
    std::size_t row = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double at = (static_cast<double>(i) + random.uniform()) / static_cast<double>(count) * total;
        while (area_up_to[row] <= at && area_up_to[row] < total) ++row;
        const Triangle& face = mesh.faces[row];
        const Vec3 weights = random_weights(random);
        samples.points.push_back(mesh.vertices[face[0]] * weights.x + mesh.vertices[face[1]] * weights.y +
                                 mesh.vertices[face[2]] * weights.z);
        samples.faces.push_back(static_cast<std::int32_t>(row));
        samples.barycentric.push_back(weights);
    }
    return samples;
}

std::vector<Vec3> vertex_normals(const TriangleMesh& mesh) {
    std::vector<Vec3> normals(mesh.vertices.size());
    for (const Triangle& face : mesh.faces) {
        const Vec3 n = area_normal(mesh, face);
        for (const std::int32_t v : face) normals[v] += n;
    }
    for (Vec3& n : normals) n = normalized(n);
    return normals;
}

}  // namespace pfgeom
