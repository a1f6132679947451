#include "pfgeom/report/tree_bound_findings.h"

#include <algorithm>

namespace pfgeom {

TreeBoundCounts& TreeBoundCounts::operator+=(const TreeBoundCounts& other) {
    cells += other.cells;
    queries += other.queries;
    slabs += other.slabs;
    wrong += other.wrong;
    unresolved += other.unresolved;
    pieces += other.pieces;
    missed += other.missed;
    lost += other.lost;
    return *this;
}

void Reservoir::add(const LabelledPoint& point) {
    ++seen_;
    if (points_.size() < capacity_) {
        points_.push_back(point);
    } else if (const std::uint64_t place = random_.below(seen_); place < capacity_) {
        points_[place] = point;
    }
}

void Reservoir::add(const Reservoir& other) {
    for (const LabelledPoint& point : other.points_) add(point);
}

void TreeBoundFindings::add_counter_example(const LabelledPoint& point, std::int32_t leaf) {
    ++counts.wrong;
    const auto seed = static_cast<std::uint64_t>(leaf) + 1;
    counter_examples.try_emplace(leaf, per_leaf, seed).first->second.add(point);
}

void TreeBoundFindings::merge(const TreeBoundFindings& other) {
    for (const auto& [leaf, points] : other.counter_examples) {
        const auto seed = static_cast<std::uint64_t>(leaf) + 1;
        counter_examples.try_emplace(leaf, per_leaf, seed).first->second.add(points);
    }
    suspects.insert(other.suspects.begin(), other.suspects.end());
    needed.insert(other.needed.begin(), other.needed.end());
    missed.insert(missed.end(), other.missed.begin(), other.missed.end());
    labels.add(other.labels);
    excess = std::max(excess, other.excess);
    sides_defined = sides_defined && other.sides_defined;
    complete = complete && other.complete;
    counts += other.counts;
}

}  // namespace pfgeom
