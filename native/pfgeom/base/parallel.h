// Deterministic data parallelism: fixed chunks, so that a result merged in chunk order does not depend on
// the number of threads.
#pragma once

#include "pfgeom/base/task.h"

#include <cstddef>
#include <functional>

namespace pfgeom {

int thread_count(const Task& task);

/// Calls body(begin, end) for [0,chunk), [chunk,2*chunk) ... of [0,n), each once, on up to task.threads
/// threads. Polls task.check() before each chunk; the first exception of a body is rethrown.
void parallel_chunks(std::size_t n, std::size_t chunk, const Task& task,
                     const std::function<void(std::size_t begin, std::size_t end)>& body);

}  // namespace pfgeom
