// A hash table from grid cells to small integers: open addressing, filled once, read by many threads.
#pragma once

#include "pfgeom/base/vec.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace pfgeom {

/// Integer coordinates of a grid cell, |coordinate| < 2^20.
struct CellIndex {
    std::int32_t x = 0, y = 0, z = 0;

    /// The cell of size `size` that holds p.
    static CellIndex of(const Vec3& p, double inverse_size) {
        return {static_cast<std::int32_t>(std::floor(p.x * inverse_size)),
                static_cast<std::int32_t>(std::floor(p.y * inverse_size)),
                static_cast<std::int32_t>(std::floor(p.z * inverse_size))};
    }
    std::uint64_t key() const {
        const auto part = [](std::int32_t v) {
            return static_cast<std::uint64_t>(v + (1 << 20)) & 0x1FFFFFU;
        };
        return (part(x) << 42) | (part(y) << 21) | part(z);
    }
};

class CellTable {
  public:
    /// -1 if absent.
    std::int32_t find(std::uint64_t key) const {
        if (keys_.empty()) return -1;
        for (std::size_t i = slot(key);; i = (i + 1) & (keys_.size() - 1)) {
            if (keys_[i] == key) return values_[i];
            if (keys_[i] == kEmpty) return -1;
        }
    }
    /// The value's place; -1 there if the key is new. Valid until the next call.
    std::int32_t& operator[](std::uint64_t key) {
        if (2 * (size_ + 1) > keys_.size()) grow();
        std::size_t i = slot(key);
        while (keys_[i] != key && keys_[i] != kEmpty) i = (i + 1) & (keys_.size() - 1);
        size_ += keys_[i] == kEmpty ? 1 : 0;
        keys_[i] = key;
        return values_[i];
    }
    std::size_t size() const { return size_; }

  private:
    static constexpr std::uint64_t kEmpty = ~std::uint64_t{0};
    std::size_t slot(std::uint64_t key) const {
        const std::uint64_t h = key * 0x9E3779B97F4A7C15ULL;
        return (h ^ (h >> 29)) & (keys_.size() - 1);
    }
    void grow() {
        std::vector<std::uint64_t> keys(keys_.empty() ? 64 : 2 * keys_.size(), kEmpty);
        std::vector<std::int32_t> values(keys.size(), -1);
        keys.swap(keys_);
        values.swap(values_);
        for (std::size_t i = 0; i < keys.size(); ++i) {
            if (keys[i] == kEmpty) continue;
            std::size_t j = slot(keys[i]);
            while (keys_[j] != kEmpty) j = (j + 1) & (keys_.size() - 1);
            keys_[j] = keys[i];
            values_[j] = values[i];
        }
    }
    std::vector<std::uint64_t> keys_;
    std::vector<std::int32_t> values_;
    std::size_t size_ = 0;
};

}  // namespace pfgeom
