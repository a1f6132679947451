#include "pfgeom/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace pfgeom {

int thread_count(const Task& task) {
    if (task.threads > 0) return std::min(task.threads, 256);
    return static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 256U));
}

void parallel_chunks(std::size_t n, std::size_t chunk, const Task& task,
                     const std::function<void(std::size_t, std::size_t)>& body) {
    const std::size_t chunks = (n + chunk - 1) / chunk;
    std::atomic<std::size_t> next{0};
    std::exception_ptr failure;
    std::mutex failure_mutex;
    const auto work = [&] {
        try {
            for (std::size_t c; (c = next.fetch_add(1)) < chunks;) {
                task.check();
                body(c * chunk, std::min(n, (c + 1) * chunk));
            }
        } catch (...) {
            next.store(chunks);
            const std::lock_guard lock(failure_mutex);
            if (!failure) failure = std::current_exception();
        }
    };
    const std::size_t wanted = std::min<std::size_t>(static_cast<std::size_t>(thread_count(task)), chunks);
    std::vector<std::thread> helpers;
    for (std::size_t i = 1; i < wanted; ++i) helpers.emplace_back(work);
    work();
    for (auto& helper : helpers) helper.join();
    if (failure) std::rethrow_exception(failure);
}

}  // namespace pfgeom
