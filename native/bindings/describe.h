// Reports and summaries of the library as Python dicts and lists.
#pragma once

#include "pfgeom/compress/compress.h"
#include "pfgeom/render/depth_buffers.h"
#include "pfgeom/report/function_list.h"

#include <pybind11/pybind11.h>

#include <vector>

namespace pfgeom::bindings {

pybind11::tuple describe_functions(
    const Model& model);  ///< surface, separators, perturbations, mesh_part_faces, patches
pybind11::list describe_function_list(const std::vector<ListedFunction>& functions);
pybind11::list describe_objects(const Model& model);
pybind11::dict describe_promise(const Model& model);
pybind11::dict describe_sizes(const Model& model);
pybind11::dict describe_deviation(const Deviation& deviation);
pybind11::dict describe_depths(const DepthComparison& depths);
pybind11::dict describe_report(const CompressReport& report);

}  // namespace pfgeom::bindings
