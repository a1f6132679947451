// A mesh part that is made only if it takes few enough bytes.
#include "pfgeom/compress/candidate.h"
#include "pfgeom/fit/simplify.h"
#include "shapes.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

Outcome attempt(const TriangleMesh& mesh, Effort effort, std::size_t most_bytes) {
    const Bvh bvh(mesh);
    const double size = diagonal(mesh);
    return try_mesh({mesh, bvh, 5e-3 * size, Metric::max, size, false, effort}, {}, most_bytes, {});
}

TEST(TryMesh, HoldsWithinTheBytesThatItTakesAndNoFewer) {
    for (const Effort effort : {Effort::fast, Effort::normal}) {
        const TriangleMesh mesh = shapes::bumpy_sphere(4);
        const Outcome free = attempt(mesh, effort, kAnyBytes);
        ASSERT_TRUE(free.holds);
        const Outcome just = attempt(mesh, effort, free.bytes);
        EXPECT_TRUE(just.holds);
        EXPECT_EQ(just.object, free.object);
        EXPECT_FALSE(attempt(mesh, effort, free.bytes - 1).holds);
        EXPECT_FALSE(attempt(mesh, effort, free.bytes / 4).holds);
    }
}

TEST(TryMesh, FitsGiveUpWithoutAFace) {
    const TriangleMesh mesh = shapes::bumpy_sphere(3);
    for (const bool curved : {false, true}) {
        MeshPartOptions options;
        options.tolerance = 5e-3 * diagonal(mesh);
        options.curved = curved;
        const std::size_t faces = std::get<MeshPart>(fit_mesh_part(mesh, options, {}).shape).faces.size();
        ASSERT_GT(faces, 10U);
        options.most_faces = faces / 2;
        EXPECT_TRUE(std::get<MeshPart>(fit_mesh_part(mesh, options, {}).shape).faces.empty());
    }
}

}  // namespace
}  // namespace pfgeom
