// The outside of a .pfg file: magic, version, lengths, optional sections, checksum (docs/FORMAT.md, section
// 2).
//
//     magic 4 | version 1 | varint: 2 · length of the stream + (1 if sections follow) | [varint: length of
//     the sections] | stream | sections | CRC-32C of all before, 4
//
// A section is: varint 2 · id + required | varint length | content. Ids rise strictly.
#pragma once

#include "pfgeom/base/limits.h"
#include "pfgeom/base/status.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

/// 0xF5 never occurs in UTF-8 and loses its top bit on a 7-bit line; CR LF changes in a text-mode transfer.
constexpr std::array<std::uint8_t, 4> kMagic{0xF5, 'p', '\r', '\n'};
/// Version 3 is that of files in which a mesh part is mirrored or a sheet is cut by a decision tree, 2 that
/// of others in which an object has placements; all others are of version 1.
constexpr std::uint8_t kFirstVersion = 1, kVersion = 3;

enum class SectionId : std::uint32_t {
    names = 1,
    world_transform = 2,
    face_groups = 3,
    materials = 4,
    combination = 5,
};

/// Known to this reader, and then with this bit: a combination changes what the objects mean, so that a
/// reader that does not know it must refuse the file.
constexpr bool is_known(std::uint64_t id) {
    return id >= 1 && id <= 5;
}
constexpr bool is_required(SectionId id) {
    return id == SectionId::combination;
}

struct Section {
    SectionId id{};
    bool required = false;
    std::vector<std::uint8_t> content;
};

/// Views into the bytes of a file.
struct Envelope {
    struct View {
        SectionId id{};
        std::span<const std::uint8_t> content;
    };
    std::uint8_t version = kFirstVersion;
    std::span<const std::uint8_t> stream;
    std::vector<View> sections;  ///< known ones; unknown optional ones are left out
};

std::vector<std::uint8_t> seal_envelope(std::span<const std::uint8_t> stream,
                                        std::span<const Section> sections,
                                        std::uint8_t version = kFirstVersion);

/// Checks in this order: magic, version, lengths, checksum, sections.
Result<Envelope> open_envelope(std::span<const std::uint8_t> bytes, const Limits& limits);

}  // namespace pfgeom
