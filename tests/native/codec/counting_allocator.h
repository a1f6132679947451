// What the program allocates: counting_allocator.cpp replaces the global operator new.
#pragma once

#include <cstddef>

namespace pfgeom::test {

/// Bytes allocated since construction, by all threads: live now, and at most at any time.
class PeakMemory {
  public:
    PeakMemory();
    std::ptrdiff_t live() const;
    std::size_t peak() const;

  private:
    std::ptrdiff_t start_;
};

/// While it lives, the n-th allocation (from 0) throws std::bad_alloc.
class FailingAllocation {
  public:
    explicit FailingAllocation(int n);
    ~FailingAllocation();
    FailingAllocation(const FailingAllocation&) = delete;
    FailingAllocation& operator=(const FailingAllocation&) = delete;
};

}  // namespace pfgeom::test
