#include "bindings.h"

PYBIND11_MODULE(_core, m) {
    using namespace pfgeom::bindings;
    m.doc() = "Native core of pfgeom; private, use the package's own names.";
    m.attr("__version__") = PFGEOM_VERSION;
    bind_errors(m);
    bind_task(m);
    bind_mesh(m);
    bind_function(m);
    bind_model(m);
    bind_algebra(m);
    bind_compress(m);
    bind_render(m);
    bind_report(m);
    bind_depth(m);
    bind_distance(m);
}
