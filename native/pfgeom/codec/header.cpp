#include "pfgeom/codec/header.h"

#include "pfgeom/codec/byte_reader.h"
#include "pfgeom/codec/byte_writer.h"
#include "pfgeom/codec/crc32c.h"

#include <algorithm>

namespace pfgeom {
namespace {

constexpr std::size_t kChecksumBytes = 4;

#ifdef PFGEOM_FUZZING
constexpr bool kVerifyChecksums = false;  // a fuzzer cannot guess them
#else
constexpr bool kVerifyChecksums = true;
#endif

// Line ends translated, the top bit stripped, or Latin-1 taken for text and written as UTF-8.
bool is_text_damage(std::span<const std::uint8_t> bytes) {
    constexpr std::array<std::array<std::uint8_t, 4>, 5> kDamaged{{{0xF5, 'p', '\n', 0},
                                                                   {0xF5, 'p', '\r', '\r'},
                                                                   {0x75, 'p', '\r', '\n'},
                                                                   {0xC3, 0xB5, 'p', 0},
                                                                   {0xEF, 0xBF, 0xBD, 'p'}}};
    return std::any_of(kDamaged.begin(), kDamaged.end(), [bytes](const auto& damaged) {
        const std::size_t n = damaged[3] == 0 ? 3 : 4;
        return bytes.size() >= n &&
               std::equal(damaged.begin(), damaged.begin() + static_cast<std::ptrdiff_t>(n), bytes.begin());
    });
}

FormatStatus check_magic(std::span<const std::uint8_t> bytes) {
    const std::size_t n = std::min(bytes.size(), kMagic.size());
    if (is_text_damage(bytes)) return FormatStatus::text_damage;
    if (n == 0 ||
        !std::equal(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(n), kMagic.begin())) {
        return FormatStatus::not_a_pfg;
    }
    return n < kMagic.size() ? FormatStatus::truncated : FormatStatus::ok;
}

FormatStatus read_sections(std::span<const std::uint8_t> bytes, Envelope& envelope) {
    ByteReader reader(bytes);
    std::uint64_t last = 0;
    while (reader.left() > 0) {
        const std::uint64_t key = reader.varint(), id = key / 2;
        const auto content = reader.take(static_cast<std::size_t>(reader.varint()));
        if (!reader.ok() || id <= last || content.empty()) return FormatStatus::bad_section;
        last = id;
        const bool required = key % 2 != 0;
        if (is_known(id)) {
            if (required != is_required(static_cast<SectionId>(id))) return FormatStatus::bad_section;
            envelope.sections.push_back({static_cast<SectionId>(id), content});
        } else if (required) {
            return FormatStatus::unknown_section;
        }
    }
    return FormatStatus::ok;
}

}  // namespace

std::vector<std::uint8_t> seal_envelope(std::span<const std::uint8_t> stream,
                                        std::span<const Section> sections, std::uint8_t version) {
    ByteWriter table;
    for (const Section& section : sections) {
        table.varint(2 * static_cast<std::uint64_t>(section.id) + (section.required ? 1 : 0));
        table.varint(section.content.size());
        table.append(section.content);
    }
    ByteWriter out;
    out.append(kMagic);
    out.byte(version);
    out.varint(2 * stream.size() + (sections.empty() ? 0 : 1));
    if (!sections.empty()) out.varint(table.bytes().size());
    out.append(stream);
    out.append(table.bytes());
    out.u32(crc32c(out.bytes()));
    return out.take();
}

Result<Envelope> open_envelope(std::span<const std::uint8_t> bytes, const Limits& limits) {
    if (bytes.size() > limits.file_bytes) return FormatStatus::limit_exceeded;
    if (const FormatStatus status = check_magic(bytes); status != FormatStatus::ok) return status;
    ByteReader reader(bytes);
    reader.take(kMagic.size());
    const std::uint8_t version = reader.byte();
    if (!reader.ok()) return FormatStatus::truncated;
    if (version < kFirstVersion || version > kVersion) return FormatStatus::unknown_version;

    const std::uint64_t lengths = reader.varint(), stream_bytes = lengths / 2;
    const std::uint64_t section_bytes = lengths % 2 != 0 ? reader.varint() : 0;
    if (!reader.ok()) return reader.left() == 0 ? FormatStatus::truncated : FormatStatus::bad_header;
    if (lengths % 2 != 0 && section_bytes == 0) return FormatStatus::bad_section;
    // Neither term exceeds 2^63, so the comparisons are written without sums.
    if (stream_bytes > reader.left() || section_bytes > reader.left() - stream_bytes ||
        kChecksumBytes > reader.left() - stream_bytes - section_bytes) {
        return FormatStatus::truncated;
    }
    if (reader.left() > stream_bytes + section_bytes + kChecksumBytes) return FormatStatus::trailing_bytes;

    Envelope envelope;
    envelope.version = version;
    envelope.stream = reader.take(static_cast<std::size_t>(stream_bytes));
    const auto sections = reader.take(static_cast<std::size_t>(section_bytes));
    const std::uint32_t computed = crc32c(bytes.first(bytes.size() - kChecksumBytes)), stored = reader.u32();
    if (kVerifyChecksums && stored != computed) return FormatStatus::checksum_mismatch;
    if (const FormatStatus status = read_sections(sections, envelope); status != FormatStatus::ok)
        return status;
    return envelope;
}

}  // namespace pfgeom
