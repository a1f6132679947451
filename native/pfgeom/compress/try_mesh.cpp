#include "pfgeom/codec/mesh_part_codec.h"
#include "pfgeom/compress/candidate.h"
#include "pfgeom/fit/simplify.h"

namespace pfgeom {

Outcome try_mesh(const Goal& goal, const Task& task) {
    Outcome outcome;
    outcome.candidate = "mesh";
    for (const double share : {1.0, 0.95, 0.85, 0.6, 0.0}) {
        outcome.object = fit_mesh_part(goal.mesh, {goal.tolerance, goal.metric, share}, task);
        auto& part = std::get<MeshPart>(outcome.object.shape);
        part = canonical(part);
        prove(goal, outcome, task);
        if (outcome.holds) break;
    }
    return outcome;
}

}  // namespace pfgeom
