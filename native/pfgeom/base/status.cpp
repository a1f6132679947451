#include "pfgeom/base/status.h"

#include <array>

namespace pfgeom {
namespace {

struct Entry {
    std::string_view name, sentence;
};

constexpr std::array<Entry, 14> kEntries{{
    {"ok", "no error"},
    {"not_a_pfg", "this is not a .pfg file"},
    {"text_damage", "the file was damaged by a transfer in text mode"},
    {"unknown_version", "the file needs a newer version of pfgeom"},
    {"truncated", "the file ends too early"},
    {"trailing_bytes", "there are bytes after the end of the content"},
    {"checksum_mismatch", "the file is damaged: its checksum does not fit"},
    {"unknown_section", "the file holds a required section that this version of pfgeom does not know"},
    {"bad_section", "the file's table of sections is not valid"},
    {"bad_header", "the file's header is not valid"},
    {"limit_exceeded", "the file asks for more memory or work than its size allows"},
    {"bad_value", "the file holds a value outside its range"},
    {"bad_stream", "the file's coded data is damaged"},
    {"derivation_mismatch", "the geometry derived from the file differs from the encoder's"},
}};

const Entry& entry(FormatStatus status) {
    return kEntries[static_cast<std::size_t>(status)];
}

}  // namespace

std::string_view describe(FormatStatus status) {
    return entry(status).sentence;
}
std::string_view name(FormatStatus status) {
    return entry(status).name;
}

}  // namespace pfgeom
