// Fits one function, base + hierarchy of perturbations, to a closed island.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/fit/target.h"
#include "pfgeom/function/model.h"

namespace pfgeom {

struct HierarchyOptions {
    int step_code = 64;   ///< quantiser step of level 7, 2^(-step_code / 8) in the cube's units
    int ratio_code = 74;  ///< see HierarchyHead
    int first_sheet = 4;
    int last_level = 9;
    int last_thin = 6;         ///< finest level that may flag thin cells
    double lambda = 0.3;       ///< weight of bits against squared error, relative to the step's natural slope
    double dead_zone = 0;      ///< > 0: on the sheet levels only errors beyond this (cube's units) count
    double mend_zone = 0;      ///< the same once few samples are out: from then on levels only mend those
    double enough = 0;         ///< no further level once no sample's error exceeds this
    double most_bits = 1e300;  ///< give up (no levels) once the estimate exceeds this
};

struct HierarchyFit {
    Function function;
    double rms = 0, max = 0;  ///< |F| / |∇F| at the samples, in the cube's units: estimates
    double bits = 0;          ///< estimate
};

/// Deterministic for any number of threads. Cancellable.
HierarchyFit fit_hierarchy(const FitTarget& target, const HierarchyOptions& options, const Task& task = {});

}  // namespace pfgeom
