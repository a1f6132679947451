#include "pfgeom/fit/collapse_ahead.h"

#include "pfgeom/base/parallel.h"

#include <algorithm>

namespace pfgeom {

bool CollapseAhead::holds(const Ends& ends, const Known& known) const {
    return std::ranges::all_of(
        ends, [&](std::int32_t v) { return touched_[static_cast<std::size_t>(v)] <= known.clock; });
}

bool CollapseAhead::knows(const CollapseEntry& e) const {
    const auto known = known_.find({e.u, e.v});
    return known != known_.end() && holds(known->first, known->second);
}

std::optional<MeasuredCollapse> CollapseAhead::take(const CollapseEntry& e) {
    auto known = known_.extract({e.u, e.v});
    if (known.empty() || !holds(known.key(), known.mapped())) return {};
    return std::move(known.mapped().measured);
}

void CollapseAhead::look(const std::vector<CollapseEntry>& entries, const Task& task) {
    std::erase_if(known_, [&](const auto& known) { return !holds(known.first, known.second); });
    std::vector<MeasuredCollapse> found(entries.size());
    parallel_chunks(entries.size(), 1, task, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) found[i] = measure_(entries[i]);
    });
    for (std::size_t i = 0; i < entries.size(); ++i)
        known_.insert_or_assign({entries[i].u, entries[i].v}, Known{std::move(found[i]), clock_});
}

}  // namespace pfgeom
