#include "arrays.h"
#include "bindings.h"
#include "pfgeom/function/nine_points.h"

namespace py = pybind11;

namespace pfgeom::bindings {
namespace {

py::array_t<double> nine_points_array(const Points& points) {
    const Quadric quadric = nine_points(points_from(points));
    return py::array_t<double>(static_cast<py::ssize_t>(quadric.c.size()), quadric.c.data());
}

}  // namespace

void bind_function(py::module_& m) {
    m.def("nine_points", &nine_points_array, py::arg("points").noconvert());
}

}  // namespace pfgeom::bindings
