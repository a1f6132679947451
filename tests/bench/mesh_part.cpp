// The mesh part alone, as docs/PATCHES.md has it, without a mirror: within a share of the diagonal, or flat,
// every vertex kept, on a grid of so many bits along the longest side, as Draco counts them.
//     mesh_part MESH SHARE
//     mesh_part MESH bits BITS...

#include "pfgeom/codec/codec.h"
#include "pfgeom/codec/mesh_part_codec.h"
#include "pfgeom/compress/candidate.h"
#include "pfgeom/fit/integer_grid.h"
#include "pfgeom/mesh/mesh.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>

namespace {

using namespace pfgeom;

void within(const TriangleMesh& mesh, double share) {
    const Bvh bvh(mesh);
    const double diagonal = bvh.bounds().diagonal();
    const Goal goal{mesh, bvh, share * diagonal, Metric::max, diagonal};
    MeshEstimate estimate = estimate_mesh(goal, {});
    estimate.mirror.reset();
    const Outcome outcome = try_mesh(goal, estimate, kAnyBytes, {});
    const auto& part = std::get<MeshPart>(outcome.object.shape);
    std::printf("%zu bytes, %zu %s, largest distance %.3f of the share\n", outcome.bytes, part.faces.size(),
                part.curved() ? "patches" : "triangles", outcome.deviation.max() / goal.tolerance);
}

void on_grid(const TriangleMesh& mesh, int bits) {
    const Box box = bounds(mesh);
    const Vec3 extent = box.extent();
    const double step = std::max({extent.x, extent.y, extent.z}) / ((1 << bits) - 1);
    Model model;
    model.objects = {part_on_grid(mesh, Grid::around(box, step))};
    auto& part = std::get<MeshPart>(model.objects.front().shape);
    part = canonical(part);
    model.diagonal = box.diagonal();
    model.promise = {Metric::max, step, step, false, step};
    std::printf("%d bits: %zu bytes\n", bits, encode(model).size());
}

}  // namespace

int main(int count, char** arguments) {
    if (count < 3) {
        std::fputs("mesh_part MESH SHARE | mesh_part MESH bits BITS...\n", stderr);
        return 2;
    }
    try {
        const TriangleMesh mesh = prepare_mesh(read_mesh(arguments[1]), 0).mesh;
        if (std::strcmp(arguments[2], "bits") != 0) within(mesh, std::strtod(arguments[2], nullptr));
        for (int i = 3; i < count; ++i)
            on_grid(mesh, static_cast<int>(std::clamp(std::strtol(arguments[i], nullptr, 10), 1L, 24L)));
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
