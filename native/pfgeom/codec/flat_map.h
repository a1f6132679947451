// A growing hash table from 64-bit keys to small values, by open addressing with linear probing. Nothing
// depends on the order of its entries: it is only asked for keys.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pfgeom {

template <class Value>
class FlatMap {
  public:
    std::size_t size() const { return size_; }

    /// Room for `extra` new keys: pointers stay valid while no more than those are inserted.
    void reserve_extra(std::size_t extra) {
        std::size_t capacity = entries_.empty() ? 1024 : entries_.size();
        while ((size_ + extra) * 4 > capacity * 3) capacity *= 2;
        if (capacity != entries_.size()) rehash(capacity);
    }
    /// Null if absent. Only after a reserve_extra.
    Value* find(std::uint64_t key) {
        Entry& entry = entries_[place(key)];
        return entry.key == key ? &entry.value : nullptr;
    }
    /// The key's value, made new if absent. Only for keys that reserve_extra made room for; key != ~0.
    Value& operator[](std::uint64_t key) {
        Entry& entry = entries_[place(key)];
        if (entry.key != key) {
            entry.key = key;
            ++size_;
        }
        return entry.value;
    }

  private:
    static constexpr std::uint64_t kEmpty = ~std::uint64_t{0};
    struct Entry {
        std::uint64_t key = kEmpty;
        Value value;
    };

    std::size_t place(std::uint64_t key) const {
        const std::uint64_t mixed = key * 0x9E3779B97F4A7C15ULL;
        std::size_t i = static_cast<std::size_t>(mixed ^ (mixed >> 32)) & (entries_.size() - 1);
        while (entries_[i].key != key && entries_[i].key != kEmpty) i = (i + 1) & (entries_.size() - 1);
        return i;
    }
    void rehash(std::size_t capacity) {
        std::vector<Entry> old(capacity);
        old.swap(entries_);
        for (const Entry& entry : old) {
            if (entry.key != kEmpty) entries_[place(entry.key)] = entry;
        }
    }

    std::vector<Entry> entries_;
    std::size_t size_ = 0;
};

}  // namespace pfgeom
