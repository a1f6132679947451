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

}  // namespace pfgeom
