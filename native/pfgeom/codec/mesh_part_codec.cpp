#include "pfgeom/codec/mesh_part_codec.h"

#include "pfgeom/codec/mesh_part_walk.h"

#include <limits>

namespace pfgeom {
namespace {

enum Kind : std::uint32_t { kStep = 140, kFaces = 142 };
constexpr int kMaxStepCode = 8 * 100;  // of exp2_eighths

}  // namespace

MeshPart canonical(const MeshPart& part) {
    EntropyCoder coder;  // writes into nothing: only the order matters
    ContextMixer mixer;
    MeshPartWalk walk(coder, mixer, &part);
    walk.run(part.faces.size(), std::numeric_limits<std::uint32_t>::max());
    return {part.step_code, walk.positions(), std::move(walk.faces())};
}

FormatStatus code_mesh_part(EntropyCoder& coder, ContextMixer& mixer, MeshPart& part,
                            std::size_t budget_bytes) {
    part.step_code = mixer.code_int(coder, part.step_code, kStep);
    if (part.step_code < -kMaxStepCode || part.step_code > kMaxStepCode) return FormatStatus::bad_value;
    const std::size_t faces = mixer.code_uint(coder, static_cast<std::uint32_t>(part.faces.size()), kFaces);
    MeshPartWalk walk(coder, mixer, coder.decoding() ? nullptr : &part);
    const FormatStatus status = walk.run(faces, budget_bytes);
    if (status == FormatStatus::ok && coder.decoding()) {
        part.positions = walk.positions();
        part.faces = std::move(walk.faces());
    }
    return status;
}

}  // namespace pfgeom
