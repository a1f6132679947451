#include "pfgeom/polygonize/plain_leaf.h"

#include "pfgeom/polygonize/leaf_surface.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pfgeom {
namespace {

constexpr int kDepth = 2;

// Given signs at the corners of the cell at (1,1,1) of 4³, outside elsewhere.
class SignField final : public ScalarField {
  public:
    explicit SignField(unsigned inside) : inside_(inside) {}
    double value(const Vec3& p) const override {
        unsigned corner = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const int at = static_cast<int>(std::lround((p[axis] + 1) * 2));
            if (at != 1 && at != 2) return -1;
            corner |= static_cast<unsigned>(at - 1) << axis;
        }
        return (inside_ >> corner & 1U) != 0 ? 1 : -1;
    }
    double value_and_gradient(const Vec3& p, Vec3& gradient) const override {
        gradient = {};
        return value(p);
    }
    Interval range(const Box& /*box*/) const override { return {-1, 1}; }

  private:
    unsigned inside_;
};

void expect_same(const PlainLeaf& plain, const OctreeNode& leaf, const LeafSheets& sheets) {
    EXPECT_EQ(plain.sheets, sheets.count);
    ASSERT_EQ(plain.crossings, sheets.crossings.size());
    for (std::size_t i = 0; i < sheets.crossings.size(); ++i) {
        const PlainCrossing& ours = plain.crossing[i];
        const Crossing& theirs = sheets.crossings[i];
        EXPECT_EQ(cube_corner(leaf.corner, 1, ours.low), theirs.edge.low);
        EXPECT_EQ(cube_corner(leaf.corner, 1, ours.high), moved(theirs.edge.low, theirs.edge.axis, 1));
        EXPECT_EQ(ours.axis, theirs.edge.axis);
        EXPECT_EQ(1U << ours.quadrant, theirs.quadrants);
        EXPECT_EQ(ours.sheet, theirs.sheet);
        EXPECT_TRUE(theirs.own);
    }
}

TEST(PlainLeaf, IsWhatTheSearchForSheetsFinds) {
    const PolygonizeOptions options{.min_depth = kDepth, .max_depth = kDepth};
    int ambiguous = 0;
    for (unsigned inside = 1; inside < 255; ++inside) {
        SCOPED_TRACE(inside);
        const SignField field(inside);
        const CubeField cube(field, kDepth);
        const Octree octree(cube, options, 1, {});
        const OctreeNode& leaf = octree.nodes()[static_cast<std::size_t>(octree.find({1, 1, 1}, kDepth))];
        ASSERT_EQ(leaf.inside, inside);
        ASSERT_TRUE(octree.plain(leaf));
        LeafSheets sheets;
        find_sheets(octree, leaf, sheets);
        const PlainLeaf& plain = plain_leaf(leaf.inside);
        EXPECT_EQ(plain.ambiguous, !sheets.pieces.empty());
        ambiguous += plain.ambiguous ? 1 : 0;
        if (!plain.ambiguous) expect_same(plain, leaf, sheets);
    }
    EXPECT_GT(ambiguous, 0);
}

}  // namespace
}  // namespace pfgeom
