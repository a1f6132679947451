#include "pfgeom/codec/model_codec.h"

#include "pfgeom/codec/function_codec.h"
#include "pfgeom/codec/mesh_part_codec.h"
#include "pfgeom/codec/object_codec.h"
#include "pfgeom/codec/promise_codec.h"

#include <algorithm>

namespace pfgeom {
namespace {

// Contexts of code_size.
constexpr std::uint32_t kFunctionCount = 0, kObjectCount = 1;

}  // namespace

void code_model(CodecStream& stream, Model& model, StreamCost* cost) {
    code_promise(stream, model.diagonal, model.promise);
    code_size(stream, model.functions, kFunctionCount);
    code_size(stream, model.objects, kObjectCount);
    for (Function& function : model.functions) {
        if (!stream.ok()) return;
        const double before = stream.coder.bits_so_far();
        code_function(stream, function);
        if (cost) cost->functions.push_back(stream.coder.bits_so_far() - before);
    }
    ObjectCoder objects(stream, model);
    for (Object& object : model.objects) {
        if (!stream.ok()) return;
        objects.code(object);
        if (cost) cost->shapes.push_back(objects.shape_bits());
    }
}

int version_of(const Model& model) {
    const auto placed = [](const Object& object) { return !object.placements.empty(); };
    const auto mirrored_or_cut = [](const Object& object) {
        const auto* part = std::get_if<MeshPart>(&object.shape);
        const auto* sheet = std::get_if<Sheet>(&object.shape);
        return (part != nullptr && part->mirror) || (sheet != nullptr && !sheet->cut.nodes.empty());
    };
    if (std::any_of(model.objects.begin(), model.objects.end(), mirrored_or_cut)) return 3;
    return std::any_of(model.objects.begin(), model.objects.end(), placed) ? 2 : 1;
}

Model canonical(const Model& model) {
    Model copy = model;
    for (Object& object : copy.objects) {
        if (auto* part = std::get_if<MeshPart>(&object.shape)) *part = canonical(*part);
    }
    return copy;
}

}  // namespace pfgeom
