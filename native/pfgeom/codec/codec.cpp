#include "pfgeom/codec/codec.h"

#include "pfgeom/base/error.h"
#include "pfgeom/codec/header.h"
#include "pfgeom/codec/model_codec.h"
#include "pfgeom/codec/sections.h"
#include "pfgeom/function/check.h"

#include <algorithm>
#include <new>
#include <stdexcept>

namespace pfgeom {
namespace {

// What decoding may allocate for a file of so many bytes, and of it the share of a section's values.
std::size_t memory_for_sections(std::size_t file_bytes, const Limits& limits) {
    const std::size_t most = std::size_t{1} << 30;
    const std::size_t per_byte = limits.decode_bytes_per_byte / 4;
    return file_bytes > most / std::max<std::size_t>(per_byte, 1)
               ? most
               : limits.decode_base_bytes / 4 + file_bytes * per_byte;
}

Result<Model> decode_stream(const Envelope& envelope) {
    CodecStream stream(envelope.stream, envelope.version);
    Model model;
    code_model(stream, model);
    if (stream.status != FormatStatus::ok) return stream.status;
    if (!stream.coder.ended_cleanly()) return FormatStatus::bad_stream;
    if (version_of(model) != envelope.version) return FormatStatus::bad_header;
    return model;
}

Result<Model> decode_file(std::span<const std::uint8_t> bytes, const Limits& limits) {
    const Result<Envelope> envelope = open_envelope(bytes, limits);
    if (!envelope) return envelope.status();
    Result<Model> model = decode_stream(*envelope);
    if (!model) return model;
    const FormatStatus status = read_sections(*envelope, memory_for_sections(bytes.size(), limits), *model);
    if (status != FormatStatus::ok) return status;
    if (!find_flaw(*model, limits).empty()) return FormatStatus::bad_value;
    return model;
}

}  // namespace

std::vector<std::uint8_t> encode(const Model& model) {
    if (const std::string flaw = find_flaw(model); !flaw.empty()) throw InvalidInput(flaw);
    Model copy = canonical(model);
    CodecStream stream(version_of(copy));
    code_model(stream, copy);
    if (stream.status != FormatStatus::ok) throw InvalidInput(std::string(describe(stream.status)));
    return seal_envelope(stream.coder.finish(), write_sections(copy),
                         static_cast<std::uint8_t>(stream.version));
}

Result<Model> decode(std::span<const std::uint8_t> bytes, const Limits& limits) {
    try {
        return decode_file(bytes, limits);
    } catch (const std::bad_alloc&) {
        return FormatStatus::limit_exceeded;
    } catch (const std::length_error&) {
        return FormatStatus::limit_exceeded;
    }
}

}  // namespace pfgeom
