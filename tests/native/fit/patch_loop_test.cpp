// Loops over patches that share faces, and collapses that are looked at ahead.
#include "pfgeom/fit/patch_loop.h"

#include "pfgeom/base/random.h"
#include "pfgeom/fit/collapse_ahead.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <numeric>

namespace pfgeom {
namespace {

Task on_threads(int threads) {
    Task task;
    task.threads = threads;
    return task;
}

struct Fitted {
    explicit Fitted(Metric metric)
        : original(shapes::sphere(2)), mesh(original), error(original, metric, 0.1, 0.1, {}) {}
    TriangleMesh original;
    CollapseMesh mesh;
    CollapseError error;
};

// Some neighbours, some far apart.
std::vector<std::vector<std::int32_t>> some_patches(std::size_t faces) {
    Random random(11);
    std::vector<std::vector<std::int32_t>> patches(600);
    for (auto& patch : patches) {
        for (int i = 0; i < 4; ++i)
            patch.push_back(static_cast<std::int32_t>(random.uniform() * static_cast<double>(faces)));
    }
    return patches;
}

TEST(PatchLoop, PatchesWithACommonFaceComeInTheirOrder) {
    const Fitted fitted(Metric::max);
    const auto patches = some_patches(fitted.mesh.face_ids());
    std::vector<std::vector<std::size_t>> expected(fitted.mesh.face_ids());
    PatchLoop loop(fitted.mesh, fitted.error);
    for (std::size_t i = 0; i < patches.size(); ++i) {
        loop.add(patches[i]);
        for (const std::int32_t f : patches[i]) expected[static_cast<std::size_t>(f)].push_back(i);
    }
    for (const int threads : {1, 2, 5}) {
        std::vector<std::vector<std::size_t>> seen(fitted.mesh.face_ids());  // no lock: none is needed
        loop.run(on_threads(threads), [&](std::size_t i) {
            for (const std::int32_t f : patches[i]) seen[static_cast<std::size_t>(f)].push_back(i);
        });
        EXPECT_EQ(seen, expected);
    }
}

// Each waits for the other; in turn they would not meet.
TEST(PatchLoop, PatchesWithoutACommonFaceMeet) {
    const Fitted fitted(Metric::max);
    PatchLoop loop(fitted.mesh, fitted.error);
    loop.add({0, 1});
    loop.add({2, 3});
    std::mutex mutex;
    std::condition_variable changed;
    int here = 0, met = 0;
    loop.run(on_threads(2), [&](std::size_t) {
        std::unique_lock lock(mutex);
        ++here;
        changed.notify_all();
        met += changed.wait_for(lock, std::chrono::seconds(60), [&] { return here == 2; }) ? 1 : 0;
    });
    EXPECT_EQ(met, 2);
}

TEST(PatchLoop, OfTheRmsAllComeInTheirOrder) {
    const Fitted fitted(Metric::rms);
    const auto patches = some_patches(fitted.mesh.face_ids());
    PatchLoop loop(fitted.mesh, fitted.error);
    for (const auto& patch : patches) loop.add(patch);
    std::vector<std::size_t> seen, expected(patches.size());
    std::iota(expected.begin(), expected.end(), std::size_t{0});
    loop.run(on_threads(4), [&](std::size_t i) { seen.push_back(i); });
    EXPECT_EQ(seen, expected);
}

CollapseEntry edge(std::int32_t u, std::int32_t v) {
    CollapseEntry e;
    e.u = u, e.v = v;
    return e;
}

TEST(CollapseAhead, KnowsWhatItLookedAtUntilAVertexIsTouched) {
    std::atomic<int> looks{0};
    CollapseAhead ahead(10, [&](const CollapseEntry& e) {
        ++looks;
        MeasuredCollapse found;
        found.cost = 10 * e.u + e.v;
        return found;
    });
    EXPECT_FALSE(ahead.take(edge(1, 2)));
    ahead.look({edge(1, 2), edge(2, 3), edge(4, 5), edge(5, 6)}, on_threads(3));
    EXPECT_EQ(looks, 4);
    EXPECT_EQ(ahead.take(edge(1, 2)).value().cost, 12);
    EXPECT_FALSE(ahead.knows(edge(1, 2)));
    ahead.touch(5);
    EXPECT_FALSE(ahead.knows(edge(4, 5)));
    EXPECT_FALSE(ahead.take(edge(5, 6)));
    EXPECT_TRUE(ahead.knows(edge(2, 3)));
    ahead.look({edge(4, 5)}, on_threads(3));
    EXPECT_EQ(ahead.take(edge(4, 5)).value().cost, 45);
    EXPECT_EQ(ahead.take(edge(2, 3)).value().cost, 23);
}

}  // namespace
}  // namespace pfgeom
