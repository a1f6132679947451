#include "pfgeom/render/folded_solid.h"

#include "codec/random_model.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

// With some signs known, what is left answers as the whole does, for all signs of the others.
TEST(FoldedSolid, AnswersAsTheWhole) {
    Random random(3);
    std::vector<std::uint8_t> scratch;
    for (int i = 0; i < 2000; ++i) {
        const Solid solid = test::random_solid(random, 4);
        std::vector<KnownSign> known;
        for (int f = 0; f < 4; ++f) known.push_back(static_cast<KnownSign>(test::below(random, 3) - 1));
        const std::vector<SetNode> left = fold(solid.nodes, known);
        ASSERT_LE(left.size(), 2 * solid.nodes.size());
        for (unsigned signs = 0; signs < 16; ++signs) {
            std::vector<std::uint8_t> sign(4);
            for (unsigned f = 0; f < 4; ++f) {
                sign[f] = known[f] == KnownSign::unknown
                              ? static_cast<std::uint8_t>(signs >> f & 1U)
                              : static_cast<std::uint8_t>(known[f] == KnownSign::inside);
            }
            EXPECT_EQ(is_inside(left, sign, scratch), is_inside(solid.nodes, sign, scratch));
        }
        for (const SetNode& node : left) {
            if (node.kind != SetNode::Kind::function) continue;
            EXPECT_EQ(known[static_cast<std::size_t>(node.a)], KnownSign::unknown);
        }
    }
}

}  // namespace
}  // namespace pfgeom
