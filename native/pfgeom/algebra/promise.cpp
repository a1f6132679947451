#include "pfgeom/algebra/promise.h"

#include <algorithm>

namespace pfgeom {
namespace {

Promise grown(Promise promise, double stretch) {
    promise.tolerance *= stretch;
    promise.bound_mesh *= stretch;
    promise.rms *= stretch;
    promise.bound_functions *= stretch;
    return promise;
}

// A bound that is not known makes the whole unknown.
Promise of_both(const Promise& a, const Promise& b) {
    Promise both;
    both.metric = a.metric == Metric::rms || b.metric == Metric::rms ? Metric::rms : Metric::max;
    const bool named = a.tolerance > 0 && b.tolerance > 0;
    const bool known = a.bound_functions > 0 && b.bound_functions > 0;
    both.tolerance = named ? std::max(a.tolerance, b.tolerance) : 0;
    both.bound_functions = known ? std::max(a.bound_functions, b.bound_functions) : 0;
    both.functions_certified = known && a.functions_certified && b.functions_certified;
    return both;
}

}  // namespace

Promise promise_of(const Combination& combination, const std::vector<CombinationNode>& tree) {
    std::vector<Promise> promises;
    std::size_t operand = 0;
    for (const CombinationNode& node : tree) {
        if (!node.is_operand()) {
            promises.push_back(of_both(promises[static_cast<std::size_t>(node.a)],
                                       promises[static_cast<std::size_t>(node.b)]));
            continue;
        }
        const CombinationStep* step = nullptr;
        while (!step) {
            const CombinationStep& next = combination.steps[operand++];
            if (next.kind == CombinationStep::Kind::operand) step = &next;
        }
        const Promise& own = combination.operands[static_cast<std::size_t>(step->row)].promise;
        promises.push_back(grown(own, node.moved ? most_stretch(node.place) : 1));
    }
    return promises.back();
}

}  // namespace pfgeom
