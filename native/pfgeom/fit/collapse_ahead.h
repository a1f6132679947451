// Collapses that are looked at before it is their turn, many side by side. What is found holds until a face
// at one of the two vertices changes, so whoever takes it gets what would have been found then.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/fit/collapse_mesh.h"

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace pfgeom {

/// An edge in the order of collapses: the collapse of u into v.
struct CollapseEntry {
    double key = 0;
    std::int32_t u = -1, v = -1;
    std::uint32_t clock = 0;
    bool measured = false;  ///< the key is what it cost when it was measured, else an estimate
    bool harmless = false;
    Vec3 place;
    /// Comes later?
    bool operator<(const CollapseEntry& o) const {
        return key != o.key ? key > o.key : u != o.u ? u > o.u : v != o.v ? v > o.v : clock > o.clock;
    }
};

struct MeasuredCollapse {
    Patch patch;
    double cost = 0;           ///< infinite: it is over the limit
    std::optional<bool> near;  ///< does the patch stay near the original? if it was looked at
};

class CollapseAhead {
  public:
    /// Called from many threads.
    using Measure = std::function<MeasuredCollapse(const CollapseEntry&)>;

    CollapseAhead(std::size_t vertices, Measure measure)
        : measure_(std::move(measure)), touched_(vertices, 0) {}

    bool knows(const CollapseEntry& e) const;
    /// What was found, which is known no longer then.
    std::optional<MeasuredCollapse> take(const CollapseEntry& e);
    /// Looks at collapses; forgets what holds no longer.
    void look(const std::vector<CollapseEntry>& entries, const Task& task);
    /// A face at this vertex has changed.
    void touch(std::int32_t v) { touched_[static_cast<std::size_t>(v)] = ++clock_; }

  private:
    using Ends = std::array<std::int32_t, 2>;
    struct Known {
        MeasuredCollapse measured;
        std::uint64_t clock = 0;
    };
    bool holds(const Ends& ends, const Known& known) const;

    Measure measure_;
    std::vector<std::uint64_t> touched_;  // of each vertex: the clock then
    std::uint64_t clock_ = 0;
    std::map<Ends, Known> known_;
};

}  // namespace pfgeom
