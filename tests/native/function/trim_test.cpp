#include "pfgeom/function/trim.h"

#include "codec/random_model.h"
#include "pfgeom/eval/solid_field.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

Sheet cut_sheet(Random& random, int depth) {
    Sheet sheet{0, -1, {}};
    test::grow_material_tree(random, root_cell(), depth, 2, sheet.cut);
    return sheet;
}

SolidField field_of(const Trim& trim) {
    Model model;
    model.functions = trim.functions;
    return {model, Solid{trim.nodes}};
}

// The value of the expression, whose sign the decision tree tells at every point that is not on a plane.
TEST(Trim, SaysWhatTheDecisionTreeSays) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const Sheet sheet = cut_sheet(random, 1 + test::below(random, 6));
        const SolidField field = field_of(trim_of(test::ball(), sheet));
        for (int i = 0; i < 300; ++i) {
            const Vec3 p{test::between(random, -1, 1), test::between(random, -1, 1),
                         test::between(random, -1, 1)};
            EXPECT_EQ(field.value(p) >= 0, material_at(sheet.cut, p) == Sheet::kKept) << seed;
        }
    }
}

// Where a plane parts what is kept from what is cut, the value is zero: it has no jumps.
TEST(Trim, HasNoJumps) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const Trim trim = trim_of(test::ball(), cut_sheet(random, 4));
        if (trim.functions.empty()) continue;
        const SolidField field = field_of(trim);
        for (int i = 0; i < 300; ++i) {
            const Vec3 p{test::between(random, -1, 1), test::between(random, -1, 1),
                         test::between(random, -1, 1)};
            const Vec3 step = Vec3{1, 1, 1} * 1e-7;
            EXPECT_NEAR(field.value(p + step), field.value(p), 1e-6) << seed;
        }
    }
}

TEST(Trim, OfAFunctionIsThatFunction) {
    const Trim trim = trim_of(test::ball(), Sheet{0, 0, {}});
    ASSERT_EQ(trim.functions.size(), 1U);
    EXPECT_EQ(trim.functions[0], test::ball().functions[0]);
    std::vector<SetNode> nodes{{SetNode::Kind::function, 0}};
    append_trim(trim, 1, nodes);
    EXPECT_EQ(nodes.back(), (SetNode{SetNode::Kind::function, 1}));
}

}  // namespace
}  // namespace pfgeom
