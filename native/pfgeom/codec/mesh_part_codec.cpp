#include "pfgeom/codec/mesh_part_codec.h"

#include "pfgeom/codec/mesh_part_bulges.h"
#include "pfgeom/codec/mesh_part_walk.h"
#include "pfgeom/function/edges_of_faces.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace pfgeom {
namespace {

enum Kind : std::uint32_t { kStep = 140, kFaces = 142 };
constexpr int kMaxStepCode = 8 * 100;  // of exp2_eighths

// A byte pays for at most this many curved faces: each takes a decoder up to 1,500 bytes.
constexpr std::size_t kCurvedFacesPerByte = 8, kCurvedFacesFree = 1024;

std::pair<std::int32_t, std::int32_t> rising(std::int32_t a, std::int32_t b) {
    return {std::min(a, b), std::max(a, b)};
}

int mirror_axis(const MeshPart& part) {
    return part.mirror ? part.mirror->axis : kNoMirror;
}

// The bulges of `part` in the order of the edges of `faces`, whose vertices are the given rows of it.
std::vector<Bulge> reordered_bulges(const MeshPart& part, const std::vector<Triangle>& faces,
                                    const std::vector<std::int32_t>& rows) {
    const EdgesOfFaces before = EdgesOfFaces::of(part.faces), after = EdgesOfFaces::of(faces);
    std::map<std::pair<std::int32_t, std::int32_t>, Bulge> known;
    for (std::size_t i = 0; i < before.ends.size(); ++i)
        known[rising(before.ends[i][0], before.ends[i][1])] = part.bulges[i];
    std::vector<Bulge> bulges;
    for (const auto& [a, b] : after.ends) {
        bulges.push_back(
            known.at(rising(rows[static_cast<std::size_t>(a)], rows[static_cast<std::size_t>(b)])));
    }
    return bulges;
}

}  // namespace

MeshPart canonical(const MeshPart& part) {
    EntropyCoder coder;  // writes into nothing: only the order matters
    ContextMixer mixer;
    MeshPartWalk walk(coder, mixer, mirror_axis(part), &part);
    walk.run(part.faces.size(), std::numeric_limits<std::uint32_t>::max());
    MeshPart result{part.step_code, walk.positions(), std::move(walk.faces()), 0, {}, part.mirror};
    if (!part.curved()) return result;
    result.bulge_code = part.bulge_code;
    result.bulges = reordered_bulges(part, result.faces, walk.written_rows());
    return result;
}

FormatStatus code_mesh_part(EntropyCoder& coder, ContextMixer& mixer, MeshPart& part, bool curved,
                            std::size_t budget_bytes) {
    part.step_code = mixer.code_int(coder, part.step_code, kStep);
    if (part.step_code < -kMaxStepCode || part.step_code > kMaxStepCode) return FormatStatus::bad_value;
    const std::size_t faces = mixer.code_uint(coder, static_cast<std::uint32_t>(part.faces.size()), kFaces);
    const std::size_t bytes_before = coder.bytes_so_far();
    MeshPartWalk walk(coder, mixer, mirror_axis(part), coder.decoding() ? nullptr : &part);
    const FormatStatus status = walk.run(faces, budget_bytes);
    if (status == FormatStatus::ok && coder.decoding()) {
        part.positions = walk.positions();
        part.faces = std::move(walk.faces());
    }
    if (status != FormatStatus::ok || !curved) return status;
    if (faces == 0) return FormatStatus::bad_value;  // would be written as flat
    while (faces > kCurvedFacesFree + (coder.bytes_so_far() - bytes_before) * kCurvedFacesPerByte) {
        if (coder.exhausted()) return FormatStatus::truncated;
        coder.code_raw(0, 8);
    }
    return code_bulges(coder, mixer, part);
}

}  // namespace pfgeom
