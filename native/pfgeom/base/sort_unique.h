// What is named by several lists is worked on once, in an order that does not depend on theirs.
#pragma once

#include <algorithm>
#include <vector>

namespace pfgeom {

/// In rising order, each value once.
template <class T>
void sort_unique(std::vector<T>& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace pfgeom
