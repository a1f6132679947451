// A long native call as Python wants it: without the interpreter's lock, with progress, and to be stopped by
// a token, by an exception out of the progress callback, or by Ctrl-C.
#pragma once

#include "pfgeom/base/task.h"

#include <pybind11/pybind11.h>

#include <functional>
#include <optional>
#include <utility>

namespace pfgeom::bindings {

class Job {
  public:
    /// `progress`: a callable (fraction, stage) or None. `cancel`: may be null. threads < 0: InvalidInput.
    Job(int threads, pybind11::object progress, const CancelToken* cancel);

    /// Runs work(task) on a thread of its own; the calling thread watches. To be called with the lock held.
    template <class Work>
    auto run(Work&& work) {
        std::optional<decltype(work(std::declval<const Task&>()))> result;
        watch([&](const Task& task) { result.emplace(work(task)); });
        return std::move(*result);
    }

  private:
    void watch(const std::function<void(const Task&)>& work);

    int threads_;
    pybind11::object progress_;
    const CancelToken* cancel_;
};

}  // namespace pfgeom::bindings
