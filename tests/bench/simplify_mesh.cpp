// The yardstick of docs/RESULTS.md: what the simplifier of mesh parts makes of a mesh within a share of its
// diagonal. simplify_mesh MESH SHARE [OUT]

#include "pfgeom/eval/mesh_part.h"
#include "pfgeom/fit/simplify.h"
#include "pfgeom/mesh/mesh.h"
#include "pfgeom/report/deviation.h"

#include <cstdio>
#include <cstdlib>
#include <exception>

int main(int count, char** arguments) {
    if (count < 3) {
        std::fputs("simplify_mesh MESH SHARE [OUT]\n", stderr);
        return 2;
    }
    try {
        const pfgeom::TriangleMesh mesh = pfgeom::prepare_mesh(pfgeom::read_mesh(arguments[1]), 0).mesh;
        const pfgeom::Bvh bvh(mesh);
        const double tolerance = std::atof(arguments[2]) * bvh.bounds().diagonal();
        const pfgeom::TriangleMesh simplified =
            mesh_of(pfgeom::fit_mesh_part(mesh, {.tolerance = tolerance}), {});
        const pfgeom::Deviation deviation = pfgeom::measure_deviation(
            mesh, bvh, simplified, pfgeom::Bvh(simplified), {.samples = 10'000, .bound = true});
        std::printf("%zu triangles, largest distance %.3f of the share\n", simplified.faces.size(),
                    deviation.max() / tolerance);
        if (count > 3) pfgeom::write_mesh(arguments[3], simplified);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
