#include "pfgeom/render/span_roots.h"

#include "pfgeom/base/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace pfgeom {
namespace {

template <class Function>
std::vector<double> roots_of(Function f, double bend, const RaySpan& span) {
    std::vector<double> roots;
    const auto found = [&](double t) {
        roots.push_back(t);
        return false;
    };
    SpanRoots search(f, bend, 1e-11, found);
    search.run(span);
    return roots;
}

// Products of three linear factors: cubics with three known zeros, some far from the span.
TEST(SpanRoots, FindsAllZerosOfCubics) {
    Random random(1);
    for (int i = 0; i < 2000; ++i) {
        std::vector<double> zeros;
        for (int k = 0; k < 3; ++k) zeros.push_back(3 * random.uniform() - 1);
        if (i % 4 == 0) zeros[1] = zeros[0] + 1e-7;
        std::sort(zeros.begin(), zeros.end());
        const auto f = [&](double t) { return (t - zeros[0]) * (t - zeros[1]) * (t - zeros[2]); };
        const std::vector<double> roots = roots_of(f, 2 * 3 * 3, {0, 1});  // |f''| = 2 |Σ (t - zero)|
        std::vector<double> expected;
        for (const double z : zeros) {
            if (z > 0 && z < 1) expected.push_back(z);
        }
        ASSERT_EQ(roots.size(), expected.size()) << i;
        for (std::size_t k = 0; k < roots.size(); ++k) EXPECT_NEAR(roots[k], expected[k], 1e-8);
    }
}

TEST(SpanRoots, LeavesOutZerosThatOnlyTouch) {
    EXPECT_TRUE(roots_of([](double t) { return (t - 0.3) * (t - 0.3); }, 2, {0, 1}).empty());
    EXPECT_TRUE(roots_of([](double t) { return (t - 0.3) * (t - 0.3) + 1e-9; }, 2, {0, 1}).empty());
    EXPECT_EQ(roots_of([](double t) { return (t - 0.3) * (t - 0.3) - 1e-9; }, 2, {0, 1}).size(), 2U);
}

// A bend without end, as hostile files have it: the work stays bounded.
TEST(SpanRoots, EndsWhateverTheBend) {
    int calls = 0;
    const auto f = [&](double t) {
        ++calls;
        return t - 0.25;
    };
    EXPECT_EQ(roots_of(f, 1e300, {0, 1}).size(), 1U);
    EXPECT_LT(calls, 10000);
}

}  // namespace
}  // namespace pfgeom
