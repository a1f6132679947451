// Random functions for property tests.
#pragma once

#include "pfgeom/base/random.h"
#include "pfgeom/function/model.h"

#include <cmath>

namespace pfgeom::test {

inline double between(Random& random, double lo, double hi) {
    return lo + (hi - lo) * random.uniform();
}

inline Vec3 random_point(Random& random, double reach = 1) {
    const double x = between(random, -reach, reach), y = between(random, -reach, reach);
    return {x, y, between(random, -reach, reach)};
}

inline Quadric random_quadric(Random& random) {
    Quadric q;
    for (double& c : q.c) c = between(random, -1, 1);
    return q;
}

/// A level of `count` balls anywhere in the cube, a third of them with factor zero.
inline Level random_level(Random& random, int depth, std::size_t count) {
    Level level;
    level.depth = depth;
    level.radius = 1.7 * std::ldexp(2.0, -depth);
    level.step = 0.02 * std::ldexp(1.0, -depth);
    for (std::size_t i = 0; i < count; ++i) {
        level.centres.push_back(random_point(random));
        level.scale.push_back(between(random, 0.1, 3));
        level.lattice.push_back(0);
        level.z.push_back(static_cast<std::int32_t>(random.below(3)) * (random.below(2) == 0 ? 1 : -1));
    }
    return level;
}

inline Function random_function(Random& random) {
    Function f;
    f.base = {{-1, -1.2, -0.9, 0.1, 0, 0.05, 0, 0.1, 0, 0.4}};
    f.perturbations.push_back({0.3, {{-4, -5, -6, 0, 0, 0, 1, 0, 2, 0.2}}});
    for (int depth = 2; depth <= 5; ++depth)
        f.levels.push_back(random_level(random, depth, 60U << (depth - 2)));
    return f;
}

}  // namespace pfgeom::test
