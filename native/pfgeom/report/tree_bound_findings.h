// What the searches of a tree bound find: kept apart for each part of the work, merged in order.
#pragma once

#include "pfgeom/base/random.h"
#include "pfgeom/report/tree_bound.h"

#include <map>
#include <set>
#include <vector>

namespace pfgeom {

/// An even draw of so many points of a stream (Vitter, "Random sampling with a reservoir", 1985, algorithm
/// R).
class Reservoir {
  public:
    explicit Reservoir(std::size_t capacity, std::uint64_t seed = 0) : capacity_(capacity), random_(seed) {}

    void add(const LabelledPoint& point);
    void add(const Reservoir& other);
    const std::vector<LabelledPoint>& points() const { return points_; }

  private:
    std::size_t capacity_;
    std::uint64_t seen_ = 0;
    Random random_;
    std::vector<LabelledPoint> points_;
};

struct TreeBoundFindings {
    TreeBoundFindings(const TreeBoundOptions& options, std::size_t labels_kept, std::uint64_t seed)
        : per_leaf(options.per_leaf), labels(labels_kept, seed) {}

    /// `leaf`: the row of the tree's node that calls it what it is not; -1: outside the box.
    void add_counter_example(const LabelledPoint& point, std::int32_t leaf);
    void merge(const TreeBoundFindings& other);

    std::size_t per_leaf;
    std::map<std::int32_t, Reservoir> counter_examples;  // by wrong leaf
    std::set<std::int32_t> suspects, needed;             // leaves
    std::vector<LabelledPoint> missed;
    Reservoir labels;
    double excess = 0;  // beyond the tolerance
    bool sides_defined = true, complete = true;
    TreeBoundCounts counts;
};

}  // namespace pfgeom
