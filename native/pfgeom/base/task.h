// What every long call takes: how many threads, whom to tell, and whether to stop.
#pragma once

#include "pfgeom/base/error.h"

#include <atomic>
#include <functional>
#include <string_view>

namespace pfgeom {

/// Set from any thread; the running call then throws Cancelled within 100 ms.
class CancelToken {
  public:
    void cancel() { flag_.store(true, std::memory_order_relaxed); }
    bool cancelled() const { return flag_.load(std::memory_order_relaxed); }

  private:
    std::atomic<bool> flag_{false};
};

struct Task {
    int threads = 0;  ///< 0: all of the machine's; the result does not depend on it
    const CancelToken* cancel = nullptr;
    /// Called from the calling thread with a fraction in [0,1] that never falls, and the stage's name.
    std::function<void(double fraction, std::string_view stage)> progress;

    /// To be polled from inner loops (some 10 µs to 10 ms apart), from any thread.
    void check() const {
        if (cancel && cancel->cancelled()) throw Cancelled();
    }
    /// From the calling thread only.
    void report(double fraction, std::string_view stage) const {
        check();
        if (progress) progress(fraction, stage);
    }
};

/// A share of a task: its progress from 0 to 1 is the whole's from `from` to `to`. `whole` must outlive it.
inline Task part_of(const Task& whole, double from, double to) {
    Task part{whole.threads, whole.cancel, {}};
    if (whole.progress) {
        part.progress = [&whole, from, to](double fraction, std::string_view stage) {
            whole.progress(from + (to - from) * fraction, stage);
        };
    }
    return part;
}

/// The same task without progress, on so many threads: for work inside a parallel loop.
inline Task quiet(const Task& whole, int threads) {
    return {threads, whole.cancel, {}};
}

}  // namespace pfgeom
