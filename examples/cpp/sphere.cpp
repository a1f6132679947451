// sphere OUT.pfg OUT.ply: a sphere's mesh into functions, and functions back into a mesh.

#include "pfgeom/base/file.h"
#include "pfgeom/codec/codec.h"
#include "pfgeom/compress/compress.h"
#include "pfgeom/mesh/mesh.h"

#include <cmath>
#include <cstdio>
#include <exception>

namespace {

// A cube's six grids of n × n squares, pushed out to the unit sphere; `prepare` welds the seams.
pfgeom::TriangleMesh make_sphere(int n) {
    pfgeom::TriangleMesh mesh;
    for (int side = 0; side < 6; ++side) {
        const auto first = static_cast<std::int32_t>(mesh.vertices.size());
        const double sign = side < 3 ? 1 : -1;
        for (int i = 0; i <= n; ++i) {
            for (int j = 0; j <= n; ++j) {
                pfgeom::Vec3 p;
                p[side % 3] = sign;
                p[(side + 1) % 3] = 2.0 * i / n - 1;
                p[(side + 2) % 3] = sign * (2.0 * j / n - 1);
                mesh.vertices.push_back(pfgeom::normalized(p));
            }
        }
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j < n; ++j) {
                const std::int32_t a = first + i * (n + 1) + j, b = a + n + 1;
                mesh.faces.push_back({a, b, b + 1});
                mesh.faces.push_back({a, b + 1, a + 1});
            }
        }
    }
    return mesh;
}

void run(const char* pfg, const char* ply) {
    const pfgeom::Compressed sphere = pfgeom::compress(make_sphere(24), {.tolerance = 1e-3});
    pfgeom::write_file(pfg, sphere.bytes);

    const auto model = pfgeom::decode(pfgeom::read_file(pfg));
    if (!model) throw pfgeom::InvalidInput(std::string(pfgeom::describe(model.status())));
    const pfgeom::TriangleMesh rebuilt = pfgeom::to_mesh(*model);
    pfgeom::write_mesh(ply, rebuilt);

    std::printf("%zu bytes, %zu triangles, deviation at most %.2g\n", sphere.bytes.size(),
                rebuilt.faces.size(), model->promise.bound_mesh);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fprintf(stderr, "usage: sphere OUT.pfg OUT.ply\n");
        return 2;
    }
    try {
        run(argv[1], argv[2]);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "sphere: %s\n", error.what());
        return 1;
    }
}
