// A call that is cancelled from another thread: it throws, and returns soon.
#pragma once

#include "pfgeom/base/error.h"
#include "pfgeom/base/task.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace pfgeom::test {

/// `call` takes a Task and would run much longer than that.
template <class Call>
void expect_cancels_soon(int milliseconds, const Call& call) {
    using Clock = std::chrono::steady_clock;
    CancelToken token;
    Task task;
    task.cancel = &token;
    Clock::time_point cancelled;
    std::thread other([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
        cancelled = Clock::now();
        token.cancel();
    });
    EXPECT_THROW(call(task), Cancelled);
    const Clock::time_point returned = Clock::now();
    other.join();
    EXPECT_LT(returned - cancelled,
              std::chrono::milliseconds(500));  // 100 on a machine that is not shared
}

}  // namespace pfgeom::test
