#include "pfgeom/fit/tree_seams.h"

#include "shapes.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

QuantisedQuadric surface(const Quadric& q) {
    return {round_finely(q, 12), 60};
}

// A half cylinder of radius 0.4 around y for z > 0 that goes over into flat sides x = ±0.4 for z < 0.
struct Arch {
    TriangleMesh mesh;
    std::vector<std::int32_t> of_face;

    Arch() {
        constexpr int kColumns = 34;
        for (int i = 0; i < kColumns; ++i) {
            const bool first = i == 0, last = i == kColumns - 1;
            const auto [c, s] = shapes::on_circle((i - 1) / (2.0 * (kColumns - 3)));
            for (const double y : {-0.7, 0.7}) {
                mesh.vertices.push_back(first  ? Vec3{0.4, y, -0.6}
                                        : last ? Vec3{-0.4, y, -0.6}
                                               : Vec3{0.4 * c, y, 0.4 * s});
            }
            if (first) continue;
            const int a = 2 * i - 2;
            mesh.faces.insert(mesh.faces.end(), {{a, a + 1, a + 3}, {a, a + 3, a + 2}});
            const bool flat = i == 1 || last;
            of_face.insert(of_face.end(), 2, flat ? 0 : 1);
        }
    }
};

TEST(TreeSeams, APlaneTellsAFlatSideFromItsRounding) {
    const Arch arch;
    const std::vector<QuantisedQuadric> quadrics{surface({{-1.25, 0, 0, 0, 0, 0, 0, 0, 0, 0.2}}),
                                                 surface({{-1.25, 0, -1.25, 0, 0, 0, 0, 0, 0, 0.2}})};
    const auto found = find_separators(arch.mesh, quadrics, arch.of_face, 12, 40, 0.002, {});
    ASSERT_EQ(found.size(), 1U) << "both seams lie in one plane";
    EXPECT_EQ(found[0].between, (std::vector<std::pair<std::int32_t, std::int32_t>>{{0, 1}}));
    const Quadric& q = found[0].quadric.quadric;
    for (const double x : {-0.4, 0.4}) {
        EXPECT_NE(q.value({x, 0.1, 0.1}) > 0, q.value({x, 0.1, -0.1}) > 0);
        EXPECT_NE(q.value({x, 0.1, 0.1}) > 0, q.value({-x, -0.3, -0.1}) > 0);
    }
}

TEST(TreeSeams, CreasesNeedNone) {
    const TriangleMesh mesh = shapes::cube(0.5);
    std::vector<std::int32_t> of_face;
    for (const auto& [a, b, c] : mesh.faces) {
        const Vec3 n =
            normalized(cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]));
        of_face.push_back(std::abs(n.x) > 0.5 ? 0 : std::abs(n.y) > 0.5 ? 1 : 2);
    }
    const std::vector<QuantisedQuadric> slabs{surface({{-1, 0, 0, 0, 0, 0, 0, 0, 0, 0.25}}),
                                              surface({{0, -1, 0, 0, 0, 0, 0, 0, 0, 0.25}}),
                                              surface({{0, 0, -1, 0, 0, 0, 0, 0, 0, 0.25}})};
    EXPECT_TRUE(find_separators(mesh, slabs, of_face, 12, 40, 0.002, {}).empty());
}

}  // namespace
}  // namespace pfgeom
