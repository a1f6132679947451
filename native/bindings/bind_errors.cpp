#include "bindings.h"
#include "errors.h"
#include "pfgeom/base/error.h"

namespace py = pybind11;

namespace pfgeom::bindings {
namespace {

/// Sets one of the package's own exceptions, which are written in Python (pfgeom/errors.py).
void raise(const char* type, const py::tuple& arguments) {
    const py::object exception = py::module_::import("pfgeom.errors").attr(type);
    PyErr_SetObject(exception.ptr(), arguments.ptr());
}

void translate(std::exception_ptr failure) {
    try {
        if (failure) std::rethrow_exception(failure);
    } catch (const FormatFailure& e) {
        raise("FormatError", py::make_tuple(std::string(name(e.status)), std::string(e.what())));
    } catch (const Cancelled& e) {
        raise("Cancelled", py::make_tuple(std::string(e.what())));
    } catch (const LimitExceeded& e) {
        raise("LimitError", py::make_tuple(std::string(e.what())));
    } catch (const IoError& e) {
        PyErr_SetString(PyExc_OSError, e.what());
    }  // InvalidInput is a std::invalid_argument: pybind11 makes it a ValueError
}

}  // namespace

void bind_errors(py::module_&) {
    py::register_exception_translator(translate);
}

}  // namespace pfgeom::bindings
