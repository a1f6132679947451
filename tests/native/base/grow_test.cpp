#include "pfgeom/base/grow.h"

#include <gtest/gtest.h>

namespace pfgeom {
namespace {

TEST(Grow, AddsTheValueAndKeepsWhatIsThere) {
    std::vector<int> values{7};
    grow(values, 200'000, {}, -1);
    ASSERT_EQ(values.size(), 200'000U);
    EXPECT_EQ(values.front(), 7);
    EXPECT_EQ(std::count(values.begin(), values.end(), -1), 199'999);
}

TEST(Grow, IsCancelled) {
    CancelToken token;
    token.cancel();
    std::vector<int> values;
    EXPECT_THROW(grow(values, 200'000, {1, &token, {}}), Cancelled);
    EXPECT_TRUE(values.empty());
}

}  // namespace
}  // namespace pfgeom
