// Long arrays, made longer bit by bit: their pages come when they are first written, which for hundreds of
// megabytes takes longer than a cancel may.
#pragma once

#include "pfgeom/base/task.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pfgeom {

/// values.resize(size, value), and polls the task on the way.
template <class T>
void grow(std::vector<T>& values, std::size_t size, const Task& task, const T& value = {}) {
    constexpr std::size_t kStep = 1 << 16;
    values.reserve(size);
    while (values.size() < size) {
        task.check();
        values.resize(std::min(size, values.size() + kStep), value);
    }
}

}  // namespace pfgeom
