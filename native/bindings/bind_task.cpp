#include "bindings.h"
#include "job.h"
#include "pfgeom/base/task.h"

namespace py = pybind11;

namespace pfgeom::bindings {

void bind_task(py::module_& m) {
    py::class_<CancelToken>(m, "CancelToken", "Stops a running call, from any thread.")
        .def(py::init<>())
        .def("cancel", &CancelToken::cancel, "The running call raises pfgeom.Cancelled within 100 ms.")
        .def_property_readonly("cancelled", &CancelToken::cancelled, "True once cancel() was called.");
    py::module_::import("atexit").attr("register")(py::cpp_function(&Job::wait_for_stragglers));
}

}  // namespace pfgeom::bindings
