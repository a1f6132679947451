#include "describe.h"
#include "pfgeom/mesh/angle.h"
#include "pfgeom/report/function_list.h"

#include <string>
#include <utility>

namespace py = pybind11;
using namespace py::literals;

namespace pfgeom::bindings {
namespace {

using Kind = QuadricKind;

constexpr double kDegrees = 57.295779513082321;

template <class... Values>
py::list list_of(Values&&... values) {
    py::list list;
    (list.append(std::forward<Values>(values)), ...);
    return list;
}

py::list numbers_of(const Vec3& v) {
    return list_of(v.x, v.y, v.z);
}

double degrees(double tangent) {
    return kDegrees * reproducible_atan2(tangent, 1);
}

// The place: what QuadricShape::centre is.
const char* place_of(Kind kind) {
    switch (kind) {
        case Kind::sphere:
        case Kind::spheroid:
        case Kind::ellipsoid:
        case Kind::hyperbolic_paraboloid:
        case Kind::circular_one_sheet:
        case Kind::one_sheet:
        case Kind::circular_two_sheets:
        case Kind::two_sheets:
            return "centre";
        case Kind::circular_cone:
        case Kind::elliptic_cone:
            return "apex";
        case Kind::circular_paraboloid:
        case Kind::elliptic_paraboloid:
            return "vertex";
        default:
            return "point";
    }
}

// One direction, or three where the surface is not round.
void describe_directions(py::dict& entry, const QuadricShape& shape) {
    switch (shape.kind) {
        case Kind::sphere:
        case Kind::point:
            return;
        case Kind::plane:
        case Kind::parallel_planes:
            entry["normal"] = numbers_of(shape.axes[0]);
            return;
        case Kind::line:
        case Kind::spheroid:
        case Kind::circular_cylinder:
        case Kind::circular_cone:
        case Kind::circular_paraboloid:
        case Kind::circular_one_sheet:
        case Kind::circular_two_sheets:
            entry["axis"] = numbers_of(shape.axes[0]);
            return;
        default:
            entry["axes"] =
                list_of(numbers_of(shape.axes[0]), numbers_of(shape.axes[1]), numbers_of(shape.axes[2]));
    }
}

void describe_sizes_of(py::dict& entry, const QuadricShape& shape) {
    const auto& [a, b, c] = shape.sizes;
    switch (shape.kind) {
        case Kind::plane:
        case Kind::line:
        case Kind::point:
        case Kind::nothing:
            return;
        case Kind::parallel_planes:
            entry["distance"] = 2 * a;
            return;
        case Kind::crossing_planes:
            entry["angle"] = 2 * degrees(a);
            return;
        case Kind::sphere:
        case Kind::circular_cylinder:
            entry["radius"] = a;
            return;
        case Kind::circular_cone:
            entry["half_angle"] = degrees(a);
            return;
        case Kind::elliptic_cone:
            entry["half_angles"] = list_of(degrees(a), degrees(b));
            return;
        case Kind::parabolic_cylinder:
        case Kind::circular_paraboloid:
            entry["focal_length"] = a;
            return;
        case Kind::elliptic_paraboloid:
        case Kind::hyperbolic_paraboloid:
            entry["focal_lengths"] = list_of(a, b);
            return;
        case Kind::elliptic_cylinder:
        case Kind::hyperbolic_cylinder:
            entry["semi_axes"] = list_of(a, b);
            return;
        default:
            entry["semi_axes"] = list_of(a, b, c);
    }
}

py::dict describe(const ListedFunction& function) {
    const QuadricShape& shape = function.shape;
    py::dict entry("kind"_a = std::string(name_of(shape.kind)), "object"_a = function.object,
                   "surface"_a = function.surface, "perturbations"_a = function.perturbations);
    if (function.copies > 1) entry["copies"] = function.copies;
    if (function.area > 0) entry["area"] = function.area;
    if (shape.kind == Kind::nothing) return entry;
    entry[place_of(shape.kind)] = numbers_of(shape.centre);
    describe_directions(entry, shape);
    describe_sizes_of(entry, shape);
    const bool round = shape.kind == Kind::sphere || shape.kind == Kind::circular_cylinder ||
                       shape.kind == Kind::circular_cone;
    if (round && function.area > 0) entry["hollow"] = function.hollow;
    return entry;
}

}  // namespace

py::list describe_function_list(const std::vector<ListedFunction>& functions) {
    py::list list;
    for (const ListedFunction& function : functions) list.append(describe(function));
    return list;
}

}  // namespace pfgeom::bindings
