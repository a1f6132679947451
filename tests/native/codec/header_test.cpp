#include "pfgeom/codec/header.h"

#include "pfgeom/codec/byte_reader.h"
#include "pfgeom/codec/byte_writer.h"
#include "pfgeom/codec/crc32c.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace pfgeom {
namespace {

using Bytes = std::vector<std::uint8_t>;

const Bytes kStream{1, 2, 3, 4, 5};

FormatStatus status_of(const Bytes& bytes) {
    return open_envelope(bytes, {}).status();
}

// Makes the checksum right again.
Bytes resealed(Bytes bytes) {
    bytes.erase(bytes.end() - 4, bytes.end());
    ByteWriter out;
    out.append(bytes);
    out.u32(crc32c(bytes));
    return out.take();
}

Section section(std::uint32_t id, bool required) {
    return {static_cast<SectionId>(id), required, {7, 7, 7}};
}

TEST(Header, StreamAndSectionsComeBack) {
    const std::vector<Section> sections{section(1, false), section(3, false)};
    const Bytes bytes = seal_envelope(kStream, sections);
    const auto envelope = open_envelope(bytes, {});
    ASSERT_TRUE(envelope);
    EXPECT_TRUE(std::ranges::equal(envelope->stream, kStream));
    ASSERT_EQ(envelope->sections.size(), 2U);
    EXPECT_EQ(envelope->sections[1].id, SectionId::face_groups);
    EXPECT_TRUE(std::ranges::equal(envelope->sections[1].content, sections[1].content));
}

TEST(Header, CostsTenBytesWithoutSections) {
    EXPECT_EQ(seal_envelope(kStream, {}).size(), kStream.size() + 10);
    const Bytes longer(8000, 1);
    EXPECT_EQ(seal_envelope(longer, {}).size(), longer.size() + 11);
}

TEST(Header, EveryPrefixIsTruncated) {
    for (const bool with_section : {false, true}) {
        const Bytes bytes =
            seal_envelope(kStream, with_section ? std::vector{section(1, false)} : std::vector<Section>{});
        for (std::size_t n = 1; n < bytes.size(); ++n) {
            EXPECT_EQ(status_of({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(n)}),
                      FormatStatus::truncated);
        }
        EXPECT_EQ(status_of({}), FormatStatus::not_a_pfg);
    }
}

TEST(Header, BytesBehindTheEndAreRefused) {
    Bytes bytes = seal_envelope(kStream, {});
    bytes.push_back(0);
    EXPECT_EQ(status_of(bytes), FormatStatus::trailing_bytes);
}

TEST(Header, EveryFlippedBitIsRefused) {
    const Bytes bytes = seal_envelope(kStream, std::vector{section(2, false)});
    for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
        Bytes flipped = bytes;
        flipped[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
        EXPECT_NE(status_of(flipped), FormatStatus::ok) << "bit " << bit;
    }
}

TEST(Header, TextModeTransfersAreNamed) {
    const Bytes bytes = seal_envelope(kStream, {});
    Bytes dos, unix, utf8, seven;
    for (const std::uint8_t b : bytes) {
        if (b == '\n') dos.push_back('\r');
        dos.push_back(b);
        if (b != '\r') unix.push_back(b);
        if (b >= 0x80) utf8.push_back(static_cast<std::uint8_t>(0xC0 | b >> 6));
        utf8.push_back(b < 0x80 ? b : static_cast<std::uint8_t>(0x80 | (b & 0x3F)));
        seven.push_back(b & 0x7F);
    }
    for (const Bytes& damaged : {dos, unix, utf8, seven})
        EXPECT_EQ(status_of(damaged), FormatStatus::text_damage);
}

TEST(Header, OtherFilesAreNotOurs) {
    EXPECT_EQ(status_of({'p', 'l', 'y', '\n'}), FormatStatus::not_a_pfg);
    EXPECT_EQ(status_of(Bytes(1000, 0)), FormatStatus::not_a_pfg);
}

TEST(Header, AnotherVersionIsRefusedByName) {
    for (const int version : {0, 4, 255}) {
        Bytes bytes = seal_envelope(kStream, {});
        bytes[4] = static_cast<std::uint8_t>(version);
        EXPECT_EQ(status_of(resealed(bytes)), FormatStatus::unknown_version);
    }
}

TEST(Header, UnknownSectionsAreSkippedUnlessRequired) {
    const auto skipped =
        open_envelope(seal_envelope(kStream, std::vector{section(2, false), section(77, false)}), {});
    ASSERT_TRUE(skipped);
    EXPECT_EQ(skipped->sections.size(), 1U);
    EXPECT_EQ(status_of(seal_envelope(kStream, std::vector{section(77, true)})),
              FormatStatus::unknown_section);
    EXPECT_EQ(status_of(seal_envelope(kStream, std::vector{section(0xFFFFFFFFU, true)})),
              FormatStatus::unknown_section);
}

TEST(Header, BadSectionTablesAreRefused) {
    const auto bad = [](std::vector<Section> sections) {
        return status_of(seal_envelope(kStream, sections));
    };
    EXPECT_EQ(bad({section(2, false), section(1, false)}), FormatStatus::bad_section);  // order
    EXPECT_EQ(bad({section(1, false), section(1, false)}), FormatStatus::bad_section);  // twice
    EXPECT_EQ(bad({section(0, false)}), FormatStatus::bad_section);
    EXPECT_EQ(bad({section(1, true)}), FormatStatus::bad_section);  // known ones are optional
    EXPECT_EQ(bad({{SectionId::names, false, {}}}), FormatStatus::bad_section);

    Bytes beyond = seal_envelope(kStream, std::vector{section(1, false)});
    beyond[beyond.size() - 4 - 4] = 200;  // the section's length
    EXPECT_EQ(status_of(resealed(beyond)), FormatStatus::bad_section);
}

TEST(Header, HugeLengthsAreTruncations) {
    ByteWriter out;
    out.append(kMagic);
    out.byte(kVersion);
    for (const std::uint64_t length :
         {std::uint64_t{1} << 20, std::uint64_t{1} << 40, (std::uint64_t{1} << 63) - 1}) {
        ByteWriter one = out;
        one.varint(length);
        one.varint((std::uint64_t{1} << 63) - 1);
        one.append(kStream);
        EXPECT_EQ(status_of(one.bytes()), FormatStatus::truncated);
    }
    out.append(Bytes(12, 0x80));
    EXPECT_EQ(status_of(out.bytes()), FormatStatus::bad_header);
}

TEST(Header, FilesBeyondTheLimitAreRefused) {
    const Bytes bytes = seal_envelope(kStream, {});
    Limits limits;
    limits.file_bytes = bytes.size() - 1;
    EXPECT_EQ(open_envelope(bytes, limits).status(), FormatStatus::limit_exceeded);
}

TEST(ByteReader, ReadsWhatByteWriterWrites) {
    ByteWriter out;
    const std::vector<std::uint64_t> values{0, 1, 127, 128, 16383, 16384, 1ULL << 62, (1ULL << 63) - 1};
    for (const auto v : values) out.varint(v);
    out.u32(0xDEADBEEFU);
    out.f64(-0.1);
    ByteReader in(out.bytes());
    for (const auto v : values) EXPECT_EQ(in.varint(), v);
    EXPECT_EQ(in.u32(), 0xDEADBEEFU);
    EXPECT_EQ(in.f64(), -0.1);
    EXPECT_TRUE(in.ok());
    EXPECT_EQ(in.left(), 0U);
    EXPECT_EQ(in.byte(), 0);
    EXPECT_FALSE(in.ok());
}

TEST(ByteReader, LongFormsOfVarintsAreRefused) {
    for (const Bytes& bytes : {Bytes{0x80, 0}, Bytes{0xFF, 0x80, 0}, Bytes(10, 0xFF)}) {
        ByteReader in(bytes);
        in.varint();
        EXPECT_FALSE(in.ok());
    }
}

}  // namespace
}  // namespace pfgeom
