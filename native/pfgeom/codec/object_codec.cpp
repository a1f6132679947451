#include "pfgeom/codec/object_codec.h"

#include "pfgeom/codec/material_tree_codec.h"
#include "pfgeom/codec/mesh_part_codec.h"
#include "pfgeom/codec/placement_codec.h"
#include "pfgeom/codec/set_tree_codec.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pfgeom {
namespace {

constexpr std::uint32_t kSolid = 0, kSheet = 1, kMeshPart = 2, kSetTree = 3;  // order of Object::shape
// Mesh parts with bulges, with a mirror (from version 3 on), and with both.
constexpr std::uint32_t kCurvedPart = 4, kMirroredPart = 5, kMirroredCurvedPart = 6;
constexpr std::uint32_t kCutSheet = 7;  // by a decision tree; from version 3 on

// Contexts of code_wide and code_numbers.
constexpr std::uint32_t kFirstOffset = 256, kLaterOffset = 257;
constexpr std::uint32_t kScale = 3, kRow = 4, kTranslation = 5, kMirrorPlace = 6;
// Contexts of code_size.
constexpr std::uint32_t kNodeCount = 3, kInstanceCount = 4;

// The offset that puts a frame of scale `code` nearest to the centre of `before`.
std::int64_t nearest_offset(const Frame& before, int code, int axis) {
    const double unit = exp2_eighths(code) / 32;
    const double offset = std::floor(before.centre()[axis] / unit + 0.5);
    constexpr auto kMost = static_cast<double>(Frame::kMaxOffset);
    return static_cast<std::int64_t>(std::clamp(offset, -kMost, kMost));
}

std::uint32_t code_of(const Object& object) {
    const auto* sheet = std::get_if<Sheet>(&object.shape);
    if (sheet != nullptr && !sheet->cut.nodes.empty()) return kCutSheet;
    const auto* part = std::get_if<MeshPart>(&object.shape);
    if (part == nullptr) return static_cast<std::uint32_t>(object.shape.index());
    if (part->mirror) return part->curved() ? kMirroredCurvedPart : kMirroredPart;
    return part->curved() ? kCurvedPart : kMeshPart;
}

}  // namespace

ObjectCoder::ObjectCoder(CodecStream& stream, const Model& model)
    : stream_(stream), function_count_(static_cast<std::int32_t>(model.functions.size())) {
    // A cube's half edge is 0.27 to 0.54 of the diagonal.
    before_.scale_code = 8 * std::ilogb(model.diagonal) - 6;
}

void ObjectCoder::code(Object& object) {
    code_frame(object.frame);
    const double before_shape = stream_.coder.bits_so_far();
    code_shape(object);
    shape_bits_ = stream_.coder.bits_so_far() - before_shape;
    code_nesting(object.cavity_of);
    code_size(stream_, object.instances, kInstanceCount);
    for (Similarity& s : object.instances) {
        if (!stream_.ok()) return;
        code_numbers(stream_, {&s.scale, 1}, kScale);
        for (Vec3& row : s.rows) code_vector(row, kRow);
        code_vector(s.translation, kTranslation);
    }
    const double before_placements = stream_.coder.bits_so_far();
    if (stream_.version >= 2 && stream_.ok())
        code_placements(stream_, object.placements, object.frame.scale_code);
    shape_bits_ += stream_.coder.bits_so_far() - before_placements;
    if (!stream_.ok()) return;
    const std::int64_t code =
        std::int64_t{mesh_code_} + code_int(object.mesh_code - mesh_code_, kMeshCodeKind);
    stream_.expect(code >= 0 && code <= 255);
    object.mesh_code = mesh_code_ = static_cast<std::uint8_t>(code & 255);
    ++index_;
}

// The scale against the frame before, the offset against that frame's centre.
void ObjectCoder::code_frame(Frame& frame) {
    const std::int64_t scale =
        std::int64_t{before_.scale_code} + code_int(frame.scale_code - before_.scale_code, kFrameScaleKind);
    if (scale < Frame::kMinScale || scale > Frame::kMaxScale) return stream_.fail(FormatStatus::bad_value);
    frame.scale_code = static_cast<int>(scale);
    for (int axis = 0; axis < 3; ++axis) {
        std::int64_t& offset = frame.offset[static_cast<std::size_t>(axis)];
        const std::int64_t expected = nearest_offset(before_, frame.scale_code, axis);
        const std::int64_t step =
            code_wide(stream_, offset - expected, index_ == 0 ? kFirstOffset : kLaterOffset);
        if (std::abs(step) > 2 * Frame::kMaxOffset) return stream_.fail(FormatStatus::bad_value);
        offset = expected + step;
    }
    before_ = frame;
}

void ObjectCoder::code_shape(Object& object) {
    const std::uint32_t shape = stream_.mixer.code_uint(stream_.coder, code_of(object), kShapeKind);
    const bool mirrored = shape == kMirroredPart || shape == kMirroredCurvedPart;
    if (mirrored || shape == kCutSheet) stream_.expect(stream_.version >= 3);
    if (stream_.decoding()) {
        if (shape == kSheet || shape == kCutSheet)
            object.shape = Sheet{};
        else if (shape == kMeshPart || shape == kCurvedPart || mirrored)
            object.shape = MeshPart{};
        else if (shape == kSetTree)
            object.shape = SetTree{};
        else
            stream_.expect(shape == kSolid);
    }
    if (!stream_.ok()) return;
    if (auto* solid = std::get_if<Solid>(&object.shape)) code_solid(*solid);
    if (auto* part = std::get_if<MeshPart>(&object.shape)) {
        if (mirrored) code_mirror(*part);
        code_mesh(*part, shape == kCurvedPart || shape == kMirroredCurvedPart);
    }
    if (auto* tree = std::get_if<SetTree>(&object.shape)) code_set_tree(stream_, tree_model_, *tree);
    if (auto* sheet = std::get_if<Sheet>(&object.shape)) {
        code_function_index(sheet->surface);
        if (shape == kSheet)
            code_function_index(sheet->trim);
        else if (stream_.ok())
            MaterialTreeCoder(stream_, 2).code(sheet->cut);
    }
}

void ObjectCoder::code_solid(Solid& solid) {
    code_size(stream_, solid.nodes, kNodeCount);
    for (std::size_t i = 0; i < solid.nodes.size() && stream_.ok(); ++i) {
        code_node(solid.nodes[i], static_cast<std::int32_t>(i));
    }
}

// Members that a kind does not use are not stored.
void ObjectCoder::code_node(SetNode& node, std::int32_t index) {
    using Kind = SetNode::Kind;
    const std::uint32_t kind =
        stream_.mixer.code_uint(stream_.coder, static_cast<std::uint32_t>(node.kind), kNodeKind);
    if (kind > static_cast<std::uint32_t>(Kind::outside)) return stream_.fail(FormatStatus::bad_value);
    node.kind = static_cast<Kind>(kind);
    if (node.operands() > 0) code_child(node.a, index);
    if (node.operands() > 1) code_child(node.b, index);
    if (node.kind == Kind::function) code_function_index(node.a);
    if (node.kind == Kind::decide) code_function_index(node.f);
}

// A child by how many nodes it stands before its parent, less one.
void ObjectCoder::code_child(std::int32_t& child, std::int32_t parent) {
    const auto in = static_cast<std::uint32_t>(parent - 1 - child);
    const std::uint32_t back = stream_.mixer.code_uint(stream_.coder, in, kNodeChildKind);
    if (back >= static_cast<std::uint32_t>(parent)) return stream_.fail(FormatStatus::bad_value);
    child = parent - 1 - static_cast<std::int32_t>(back);
}

// Against the first function that no object has used yet: in most models each is used once, in order.
void ObjectCoder::code_function_index(std::int32_t& function) {
    const std::int64_t index =
        std::int64_t{next_function_} + code_int(function - next_function_, kFunctionIndexKind);
    if (index < 0 || index >= function_count_) return stream_.fail(FormatStatus::bad_value);
    function = static_cast<std::int32_t>(index);
    next_function_ = std::max(next_function_, function + 1);
}

void ObjectCoder::code_mirror(MeshPart& part) {
    MirrorPlane plane = part.mirror.value_or(MirrorPlane{});
    const auto in = static_cast<std::uint32_t>(plane.axis);
    const std::uint32_t axis = stream_.mixer.code_uint(stream_.coder, in, kMirrorAxisKind);
    if (axis > 2) return stream_.fail(FormatStatus::bad_value);
    plane.axis = static_cast<std::int32_t>(axis);
    code_numbers(stream_, {&plane.at, 1}, kMirrorPlace);
    if (stream_.ok()) part.mirror = plane;
}

void ObjectCoder::code_mesh(MeshPart& part, bool curved) {
    const std::size_t budget = stream_.memory / CodecStream::kMemoryPerByte;
    const FormatStatus status = code_mesh_part(stream_.coder, stream_.mixer, part, curved, budget);
    if (status != FormatStatus::ok) return stream_.fail(status);
    stream_.charge(part.positions.size() + part.faces.size(), sizeof(Triangle));
    stream_.charge(part.bulges.size(), sizeof(Bulge));
}

void ObjectCoder::code_nesting(std::int32_t& cavity_of) {
    if (!code_flag(stream_, cavity_of >= 0, kCavityFlag)) return;
    const std::int64_t outer = std::int64_t{index_} - code_int(index_ - cavity_of, kParentKind);
    if (outer < 0 || outer > INT32_MAX) return stream_.fail(FormatStatus::bad_value);
    cavity_of = static_cast<std::int32_t>(outer);
}

void ObjectCoder::code_vector(Vec3& v, std::uint32_t context) {
    std::array<double, 3> values{v.x, v.y, v.z};
    code_numbers(stream_, values, context);
    v = {values[0], values[1], values[2]};
}

std::int32_t ObjectCoder::code_int(std::int32_t value, std::uint32_t kind) {
    return stream_.mixer.code_int(stream_.coder, value, kind);
}

}  // namespace pfgeom
