#include "pfgeom/codec/function_codec.h"

#include "pfgeom/codec/hierarchy_codec.h"

namespace pfgeom {
namespace {

// Contexts of code_numbers.
constexpr std::uint32_t kBase = 0, kPerturbing = 1, kFactor = 2;

}  // namespace

void code_function(CodecStream& stream, Function& function) {
    const bool has_levels = code_flag(stream, !function.levels.empty(), kHasLevelsFlag);
    if (has_levels) {
        const FormatStatus status = code_hierarchy(stream.coder, stream.mixer, function, stream.derive);
        if (status != FormatStatus::ok) stream.fail(status);
        stream.expect(!function.levels.empty());
    } else {
        code_numbers(stream, function.base.c, kBase);
    }
    code_size(stream, function.perturbations, 2);
    for (Perturbation& p : function.perturbations) {
        if (!stream.ok()) return;
        code_numbers(stream, {&p.factor, 1}, kFactor);
        code_numbers(stream, p.quadric.c, kPerturbing);
    }
}

}  // namespace pfgeom
