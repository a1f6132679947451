#include "pfgeom/function/trim.h"

#include "codec/random_model.h"
#include "pfgeom/eval/solid_field.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

// The value of the expression, whose sign the decision tree tells at every point that is not on a plane.
TEST(Trim, SaysWhatTheDecisionTreeSays) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Random random(seed);
        Sheet sheet{0, -1, {}};
        test::grow_material_tree(random, root_cell(), 1 + test::below(random, 6), 2, sheet.cut);
        const Trim trim = trim_of(test::ball(), sheet);
        Model model;
        model.functions = trim.functions;
        const SolidField field(model, Solid{trim.nodes});
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
        Sheet sheet{0, -1, {}};
        test::grow_material_tree(random, root_cell(), 4, 2, sheet.cut);
        const Trim trim = trim_of(test::ball(), sheet);
        if (trim.functions.empty()) continue;
        Model model;
        model.functions = trim.functions;
        const SolidField field(model, Solid{trim.nodes});
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
