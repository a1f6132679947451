#include "pfgeom/base/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace pfgeom {
namespace {

class Parallel : public testing::TestWithParam<int> {
  protected:
    Task task() const {
        Task result;
        result.threads = GetParam();
        return result;
    }
};

TEST_P(Parallel, EachRowIsVisitedOnceInFixedChunks) {
    for (const std::size_t n : {0, 1, 99, 100, 101, 1000}) {
        std::vector<int> visits(n, 0);
        parallel_chunks(n, 100, task(), [&](std::size_t begin, std::size_t end) {
            EXPECT_EQ(begin % 100, 0U);
            EXPECT_EQ(end, std::min(n, begin + 100));
            for (std::size_t i = begin; i < end; ++i) ++visits[i];
        });
        EXPECT_EQ(visits, std::vector<int>(n, 1));
    }
}

TEST_P(Parallel, SumsMergedInOrderDoNotDependOnThreads) {
    std::vector<double> partial(100);
    parallel_chunks(10'000, 100, task(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) partial[begin / 100] += 1.0 / static_cast<double>(i + 1);
    });
    double expected = 0;
    for (std::size_t chunk = 0; chunk < 100; ++chunk) {
        double sum = 0;
        for (std::size_t i = chunk * 100; i < (chunk + 1) * 100; ++i) sum += 1.0 / static_cast<double>(i + 1);
        expected += sum;
    }
    EXPECT_EQ(std::accumulate(partial.begin(), partial.end(), 0.0), expected);
}

TEST_P(Parallel, AnExceptionOfABodyReachesTheCaller) {
    const auto body = [](std::size_t begin, std::size_t) {
        if (begin == 500) throw std::runtime_error("row 500");
    };
    EXPECT_THROW(parallel_chunks(1000, 100, task(), body), std::runtime_error);
}

TEST_P(Parallel, ACancelStopsBeforeTheNextChunk) {
    CancelToken cancel;
    Task cancelled = task();
    cancelled.cancel = &cancel;
    std::atomic<int> chunks{0};
    const auto body = [&](std::size_t, std::size_t) {
        ++chunks;
        cancel.cancel();
    };
    EXPECT_THROW(parallel_chunks(100'000, 1, cancelled, body), Cancelled);
    EXPECT_LE(chunks.load(), GetParam());
}

INSTANTIATE_TEST_SUITE_P(Threads, Parallel, testing::Values(1, 2, 4));

TEST(ThreadCount, FollowsTheTaskOrTheMachine) {
    Task task;
    EXPECT_GE(thread_count(task), 1);
    task.threads = 3;
    EXPECT_EQ(thread_count(task), 3);
}

}  // namespace
}  // namespace pfgeom
