// The Python face of the library, pfgeom._core: one bind function a domain, no logic. The package
// python/pfgeom checks and documents what comes in; here arrays are checked once more, so that nothing from
// Python can crash.
#pragma once

#include <pybind11/pybind11.h>

namespace pfgeom::bindings {

void bind_errors(pybind11::module_& m);
void bind_task(pybind11::module_& m);
void bind_mesh(pybind11::module_& m);
void bind_function(pybind11::module_& m);
void bind_algebra(pybind11::module_& m);
void bind_model(pybind11::module_& m);
void bind_compress(pybind11::module_& m);
void bind_render(pybind11::module_& m);
void bind_report(pybind11::module_& m);
void bind_depth(pybind11::module_& m);
void bind_distance(pybind11::module_& m);

}  // namespace pfgeom::bindings
