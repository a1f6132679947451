#include "codec/counting_allocator.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

namespace {

std::atomic<std::ptrdiff_t> live_bytes{0}, peak_bytes{0};
std::atomic<int> until_failure{-1};

constexpr std::size_t kHeader = alignof(std::max_align_t);  // holds the size of the block behind it

void* counted_alloc(std::size_t size) {
    if (until_failure.load() >= 0 && until_failure.fetch_sub(1) == 0) throw std::bad_alloc();
    auto* block = size > SIZE_MAX - kHeader ? nullptr : static_cast<std::byte*>(std::malloc(size + kHeader));
    if (block == nullptr) throw std::bad_alloc();
    *reinterpret_cast<std::size_t*>(block) = size;
    const std::ptrdiff_t now = live_bytes += static_cast<std::ptrdiff_t>(size);
    std::ptrdiff_t peak = peak_bytes.load();
    while (now > peak && !peak_bytes.compare_exchange_weak(peak, now)) {
    }
    return block + kHeader;
}

void counted_free(void* pointer) {
    if (pointer == nullptr) return;
    auto* block = static_cast<std::byte*>(pointer) - kHeader;
    live_bytes -= static_cast<std::ptrdiff_t>(*reinterpret_cast<std::size_t*>(block));
    std::free(block);
}

}  // namespace

void* operator new(std::size_t size) {
    return counted_alloc(size);
}
void* operator new[](std::size_t size) {
    return counted_alloc(size);
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    try {
        return counted_alloc(size);
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}
void operator delete(void* pointer, const std::nothrow_t&) noexcept {
    counted_free(pointer);
}
void operator delete(void* pointer) noexcept {
    counted_free(pointer);
}
void operator delete[](void* pointer) noexcept {
    counted_free(pointer);
}
void operator delete(void* pointer, std::size_t) noexcept {
    counted_free(pointer);
}
void operator delete[](void* pointer, std::size_t) noexcept {
    counted_free(pointer);
}

namespace pfgeom::test {

PeakMemory::PeakMemory() : start_(live_bytes.load()) {
    peak_bytes.store(start_);
}
std::ptrdiff_t PeakMemory::live() const {
    return live_bytes.load() - start_;
}
std::size_t PeakMemory::peak() const {
    return static_cast<std::size_t>(peak_bytes.load() - start_);
}

FailingAllocation::FailingAllocation(int n) {
    until_failure.store(n);
}
FailingAllocation::~FailingAllocation() {
    until_failure.store(-1);
}

TEST(CountingAllocator, SeesPeakAndLive) {
    const PeakMemory memory;
    auto kept = std::make_unique<std::vector<char>>(1000);
    std::vector<char>(100000).at(5) = 1;
    EXPECT_GE(memory.peak(), 101000U);
    EXPECT_LT(memory.peak(), 102000U);
    EXPECT_GE(memory.live(), 1000);
    EXPECT_LT(memory.live(), 2000);
}

TEST(CountingAllocator, FailsAsToldTo) {
    const FailingAllocation failing(1);
    EXPECT_NO_THROW(std::vector<char>(10).at(0) = 1);
    EXPECT_THROW(std::vector<char>(10).at(0) = 1, std::bad_alloc);
    EXPECT_NO_THROW(std::vector<char>(10).at(0) = 1);
}

}  // namespace pfgeom::test
