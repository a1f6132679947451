#include "pfgeom/codec/material_codec.h"

#include "pfgeom/base/limits.h"
#include "pfgeom/base/utf8.h"
#include "pfgeom/codec/material_tree_codec.h"

#include <algorithm>
#include <array>
#include <string>

namespace pfgeom {
namespace {

// Kinds of the mixer, of this section's own stream; code_uint takes two.
enum Kind : std::uint32_t {
    kMaterialCount = 0,
    kHasNames = 2,
    kSharedBegin = 4,
    kNameLength = 6,
    kNameByte = 8,
    kOneForEachCopy = 10,
    kByQuadric = 11,
};

std::size_t shared_begin(const std::string& a, const std::string& b) {
    std::size_t n = 0;
    while (n < a.size() && n < b.size() && a[n] == b[n]) ++n;
    return n;
}

char code_byte(CodecStream& stream, char value, std::uint32_t before, std::uint32_t second) {
    const auto in = static_cast<std::uint8_t>(value);
    std::uint32_t node = 1;
    for (int i = 7; i >= 0; --i) {
        const std::array contexts{node, 256 * (before + 1) + node,
                                  (256 * second + before) % 65536 * 256 + node};
        node = 2 * node + static_cast<std::uint32_t>(
                              stream.mixer.code(stream.coder, in >> i & 1, {kNameByte, 0, 0}, contexts));
    }
    return static_cast<char>(static_cast<std::uint8_t>(node & 255U));
}

// What it begins with like the name before it, then the rest.
void code_name(CodecStream& stream, std::string& name, const std::string& before) {
    const auto shared = stream.mixer.code_uint(
        stream.coder, static_cast<std::uint32_t>(shared_begin(name, before)), kSharedBegin);
    if (shared > before.size()) return stream.fail(FormatStatus::bad_value);
    const auto length =
        shared + std::size_t{stream.mixer.code_uint(
                     stream.coder, static_cast<std::uint32_t>(name.size()) - shared, kNameLength)};
    if (length > Limits{}.string_bytes) return stream.fail(FormatStatus::bad_value);
    if (stream.decoding()) {
        if (!stream.charge(length, 1)) return;
        name = before.substr(0, shared);
        name.resize(length);
    }
    const auto byte_at = [&name](std::size_t i) { return std::uint32_t{static_cast<std::uint8_t>(name[i])}; };
    for (std::size_t i = shared; i < length && stream.ok(); ++i)
        name[i] = code_byte(stream, name[i], i > 0 ? byte_at(i - 1) : 0, i > 1 ? byte_at(i - 2) : 0);
    // One form only: what is shared is all that is shared.
    if (stream.decoding() && stream.ok())
        stream.expect(shared_begin(name, before) == shared && is_utf8(name));
}

bool any_named(const std::vector<std::string>& names) {
    return std::any_of(names.begin(), names.end(), [](const std::string& name) { return !name.empty(); });
}

void code_names(CodecStream& stream, std::vector<std::string>& names) {
    const std::size_t n =
        1 + std::size_t{stream.mixer.code_uint(stream.coder, static_cast<std::uint32_t>(names.size() - 1),
                                               kMaterialCount)};
    if (stream.decoding()) {
        if (n > Limits{}.materials) return stream.fail(FormatStatus::bad_value);
        if (!stream.ok() || !stream.charge(n, sizeof(std::string) + sizeof(std::int32_t))) return;
        names.resize(n);
    }
    if (!code_flag(stream, any_named(names), kHasNames)) return;
    std::string before;
    for (std::string& name : names) {
        if (!stream.ok()) return;
        code_name(stream, name, before);
        before = name;
    }
    if (stream.decoding()) stream.expect(any_named(names));
}

void code_paint(CodecStream& stream, MaterialTreeCoder& coder, const Object& object, Paint& paint) {
    const auto* tree = std::get_if<SetTree>(&object.shape);
    const bool choice = tree != nullptr && !tree->quadrics.empty();
    paint.by_quadric = choice && code_flag(stream, paint.by_quadric, kByQuadric);
    if (stream.decoding()) {
        const std::size_t n = paint.by_quadric ? tree->quadrics.size() : 1;
        if (!stream.ok() || !stream.charge(n, sizeof(MaterialTree))) return;
        paint.trees.resize(n);
    }
    for (MaterialTree& t : paint.trees) {
        if (stream.ok()) coder.code(t);
    }
}

void code_materials(CodecStream& stream, const std::vector<Object>& objects, MaterialMap& map) {
    code_names(stream, map.names);
    MaterialTreeCoder coder(stream, map.names.size());
    if (stream.decoding() && stream.ok() && stream.charge(objects.size(), sizeof(std::vector<Paint>)))
        map.objects.resize(objects.size());
    for (std::size_t i = 0; i < map.objects.size() && stream.ok(); ++i) {
        const Object& object = objects[i];
        std::vector<Paint>& paints = map.objects[i];
        const std::size_t copies = copy_count(object);
        const bool each = copies > 1 && code_flag(stream, paints.size() > 1, kOneForEachCopy);
        if (stream.decoding()) {
            const std::size_t n = each ? copies : 1;
            if (!stream.ok() || !stream.charge(n, sizeof(Paint))) return;
            paints.resize(n);
        }
        for (Paint& paint : paints) {
            if (stream.ok()) code_paint(stream, coder, object, paint);
        }
    }
}

}  // namespace

std::vector<std::uint8_t> write_materials(const Model& model) {
    MaterialMap map = model.materials;
    CodecStream stream;
    code_materials(stream, model.objects, map);
    std::vector<std::uint8_t> bytes = stream.coder.finish();
    if (bytes.empty()) bytes.push_back(0);  // a section is never empty
    return bytes;
}

FormatStatus read_materials(std::span<const std::uint8_t> content, std::size_t memory, Model& model) {
    if (content.size() == 1 && content[0] == 0) content = {};
    CodecStream stream(content);
    stream.memory = memory;
    code_materials(stream, model.objects, model.materials);
    if (stream.status != FormatStatus::ok) return stream.status;
    return stream.coder.ended_cleanly() ? FormatStatus::ok : FormatStatus::bad_stream;
}

}  // namespace pfgeom
