// A long native call as Python wants it: without the interpreter's lock, with progress, and to be stopped by
// a token, by an exception out of the progress callback, or by Ctrl-C, within 100 ms.
#pragma once

#include "pfgeom/base/task.h"

#include <pybind11/pybind11.h>

#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace pfgeom::bindings {

class Job {
  public:
    Job() = default;  ///< all threads, no progress, no token
    /// `progress`: a callable (fraction, stage) or None. `cancel`: may be null. threads < 0: InvalidInput.
    Job(int threads, pybind11::object progress, const CancelToken* cancel);

    /// Runs work(task) on a thread of its own; the calling thread watches. To be called with the lock held.
    /// The work must own what it uses: when it is stopped between two polls that lie far apart, the call
    /// returns and the work is left to reach its next poll.
    template <class Work>
    auto run(Work work) {
        using Result = decltype(work(std::declval<const Task&>()));
        const auto result = std::make_shared<std::optional<Result>>();
        watch([result, work = std::move(work)](const Task& task) { result->emplace(work(task)); });
        return std::move(**result);
    }

    /// Waits for all work that was left. To be called before the interpreter ends.
    static void wait_for_stragglers();

  private:
    void watch(std::function<void(const Task&)> work);

    int threads_ = 0;
    pybind11::object progress_ = pybind11::none();
    const CancelToken* cancel_ = nullptr;
};

}  // namespace pfgeom::bindings
