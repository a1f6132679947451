#include "bindings.h"
#include "errors.h"
#include "job.h"
#include "model_handle.h"
#include "pfgeom/algebra/algebra.h"
#include "pfgeom/base/error.h"
#include "pfgeom/codec/codec.h"
#include "pfgeom/compress/compress.h"

#include <pybind11/stl.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace py = pybind11;
using namespace py::literals;

namespace pfgeom::bindings {
namespace {

using Kind = CombinationStep::Kind;

/// What everyone else will see: decoded from its bytes.
ModelPointer handle_of(const Model& model) {
    std::vector<std::uint8_t> bytes = encode(model);
    Result<Model> decoded = decode(bytes);
    if (!decoded) throw FormatFailure(decoded.status());
    return std::make_shared<ModelHandle>(std::move(*decoded), std::move(bytes));
}

ModelPointer combined(const ModelPointer& a, const ModelPointer& b, const std::string& operation) {
    return Job().run([=](const Task&) {
        if (operation == "union") return handle_of(a->model() | b->model());
        if (operation == "intersection") return handle_of(a->model() & b->model());
        if (operation == "difference") return handle_of(a->model() - b->model());
        throw InvalidInput("an operation is union, intersection or difference");
    });
}

/// Twelve numbers: the matrix without its last row, by rows.
ModelPointer transformed_by(const ModelPointer& handle, const std::array<double, 12>& m) {
    return Job().run([=](const Task&) {
        Affine map;
        for (std::size_t i = 0; i < 3; ++i) {
            map.rows[i] = {m[4 * i], m[4 * i + 1], m[4 * i + 2]};
            map.translation[static_cast<int>(i)] = m[4 * i + 3];
        }
        return handle_of(transformed(handle->model(), map));
    });
}

ModelPointer offset_by(const ModelPointer& handle, double distance, double tolerance, bool relative, bool rms,
                       std::uint8_t effort, int threads, py::object progress, const CancelToken* cancel) {
    const CompressOptions options{tolerance, relative, rms ? Metric::rms : Metric::max,
                                  static_cast<Effort>(effort)};
    Job job(threads, std::move(progress), cancel);
    Compressed result =
        job.run([=](const Task& task) { return offset(handle->model(), distance, options, task); });
    return std::make_shared<ModelHandle>(std::move(result.model), std::move(result.bytes));
}

/// In words: operands by number, operations as Python writes them.
std::string expression_of(const Combination& c) {
    std::vector<std::string> stack;
    for (const CombinationStep& step : c.steps) {
        if (step.kind == Kind::operand) {
            stack.push_back(std::to_string(step.row));
        } else if (step.kind == Kind::transform) {
            stack.back() = "T" + std::to_string(step.row) + "(" + stack.back() + ")";
        } else {
            const std::string sign = step.kind == Kind::unite       ? "|"
                                     : step.kind == Kind::intersect ? "&"
                                                                    : "-";
            const std::string b = std::move(stack.back());
            stack.pop_back();
            stack.back() = "(" + stack.back() + " " + sign + " " + b + ")";
        }
    }
    return stack.back();
}

py::list matrix_of(const Affine& map) {
    py::list rows;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3& row = map.rows[i];
        rows.append(std::vector<double>{row.x, row.y, row.z, map.translation[static_cast<int>(i)]});
    }
    rows.append(std::vector<double>{0, 0, 0, 1});
    return rows;
}

py::object describe_combination(const ModelHandle& handle) {
    const Combination& c = handle.model().combination;
    if (c.empty()) return py::none();
    py::list operands, transforms;
    int first = 0;
    for (const Operand& operand : c.operands) {
        const Promise& p = operand.promise;
        operands.append(py::dict("objects"_a = std::vector<int>{first, first + operand.objects},
                                 "diagonal"_a = operand.diagonal,
                                 "metric"_a = p.metric == Metric::max ? "max" : "rms",
                                 "tolerance"_a = p.tolerance, "bound_functions"_a = p.bound_functions));
        first += operand.objects;
    }
    for (const Affine& map : c.transforms) transforms.append(matrix_of(map));
    return py::dict("expression"_a = expression_of(c), "operands"_a = operands, "transforms"_a = transforms);
}

}  // namespace

void bind_algebra(py::module_& m) {
    m.def("combined", &combined, py::arg("a"), py::arg("b"), py::arg("operation"));
    m.def("transformed", &transformed_by, py::arg("model"), py::arg("matrix"));
    m.def("offset", &offset_by, py::arg("model"), py::arg("distance"), py::arg("tolerance"),
          py::arg("relative"), py::arg("rms"), py::arg("effort"), py::arg("threads"), py::arg("progress"),
          py::arg("cancel"));
    m.def("combination", &describe_combination, py::arg("model"));
}

}  // namespace pfgeom::bindings
