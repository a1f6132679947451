// OFF (Geomview), ascii and binary: [ST][C][N]OFF [BINARY]. Only positions are taken: in ascii files the rest
// of a vertex's or face's line is passed over, in binary ones the prefix says how many values a vertex has.
#include "pfgeom/base/error.h"
#include "pfgeom/mesh/binary_scanner.h"
#include "pfgeom/mesh/formats.h"
#include "pfgeom/mesh/mesh_builder.h"
#include "pfgeom/mesh/text_scanner.h"

#include <string>

namespace pfgeom {
namespace {

struct OffHeader {
    bool binary = false;
    int extra_values = 0;  // of a vertex, behind its position
};

bool take_prefix(std::string& text, const std::string& prefix) {
    if (!text.starts_with(prefix)) return false;
    text.erase(0, prefix.size());
    return true;
}

/// Leaves the scanner before the counts. The keyword may be missing; then the file begins with them.
OffHeader read_header(TextScanner& scanner) {
    OffHeader header;
    if (!scanner.seek_word()) scanner.fail("the file is empty");
    TextScanner ahead = scanner;
    std::string keyword = upper_case(ahead.word());
    if (!keyword.ends_with("OFF")) return header;
    scanner = ahead;
    if (take_prefix(keyword, "ST")) header.extra_values += 2;
    if (take_prefix(keyword, "C")) header.extra_values += 4;
    if (take_prefix(keyword, "N")) header.extra_values += 3;
    if (keyword != "OFF") scanner.fail("of the OFF formats, only those with three coordinates are read");
    header.binary = upper_case(ahead.word()) == "BINARY";
    if (header.binary) {
        ahead.next_line();
        scanner = ahead;
    }
    return header;
}

/// `least`: bytes that one element needs at least.
std::int64_t checked_count(std::int64_t count, const char* what, std::size_t bytes_left, std::size_t least) {
    if (count < 0 || static_cast<std::uint64_t>(count) > bytes_left / least)
        throw InvalidInput("the header announces " + std::to_string(count) + " " + what +
                           ", the file has room for " + std::to_string(bytes_left / least));
    return count;
}

TriangleMesh read_ascii(TextScanner& scanner) {
    const auto count = [&](const char* what) {
        if (!scanner.seek_word()) scanner.fail("the file ends before its counts");
        return checked_count(scanner.integer(), what, scanner.bytes_left(), 2);
    };
    const std::int64_t vertices = count("vertices"), faces = count("faces");
    scanner.next_line();  // and the number of edges, which nobody needs

    MeshBuilder builder;
    builder.reserve_vertices(static_cast<std::size_t>(vertices));
    for (std::int64_t i = 0; i < vertices; ++i, scanner.next_line()) {
        if (!scanner.seek_word()) scanner.fail("the file ends before vertex " + std::to_string(i));
        const double x = scanner.number(), y = scanner.number(), z = scanner.number();
        builder.add_vertex({x, y, z});
    }
    std::vector<std::int64_t> corners;
    for (std::int64_t i = 0; i < faces; ++i, scanner.next_line()) {
        if (!scanner.seek_word()) scanner.fail("the file ends before face " + std::to_string(i));
        const auto n = checked_count(scanner.integer(), "corners of a face", scanner.bytes_left(), 2);
        corners.clear();
        for (std::int64_t k = 0; k < n; ++k) corners.push_back(scanner.integer());
        builder.add_polygon(corners, {"line", scanner.line()});
    }
    return builder.finish();
}

TriangleMesh read_binary(BinaryScanner reader, int extra_values) {
    const std::size_t vertex_bytes = 4 * (3 + static_cast<std::size_t>(extra_values));
    const auto vertex_count = reader.get<std::int32_t>(), face_count = reader.get<std::int32_t>();
    reader.skip(4);
    const std::int64_t vertices = checked_count(vertex_count, "vertices", reader.bytes_left(), vertex_bytes);
    const std::int64_t faces = checked_count(face_count, "faces", reader.bytes_left(), 8);

    MeshBuilder builder;
    builder.reserve_vertices(static_cast<std::size_t>(vertices));
    for (std::int64_t i = 0; i < vertices; ++i) {
        const auto x = reader.get<float>(), y = reader.get<float>(), z = reader.get<float>();
        builder.add_vertex({x, y, z});
        reader.skip(vertex_bytes - 12);
    }
    std::vector<std::int64_t> corners;
    for (std::int64_t i = 0; i < faces; ++i) {
        const auto n = checked_count(reader.get<std::int32_t>(), "corners of a face", reader.bytes_left(), 4);
        corners.clear();
        for (std::int64_t k = 0; k < n; ++k) corners.push_back(reader.get<std::int32_t>());
        builder.add_polygon(corners, {"face", i});
        const auto colours = reader.get<std::int32_t>();
        reader.skip(
            4 * static_cast<std::size_t>(checked_count(colours, "colour values", reader.bytes_left(), 4)));
    }
    return builder.finish();
}

}  // namespace

TriangleMesh read_off(std::span<const std::uint8_t> bytes) {
    TextScanner scanner(bytes);
    const OffHeader header = read_header(scanner);
    if (!header.binary) return read_ascii(scanner);
    return read_binary(BinaryScanner(bytes.last(scanner.bytes_left()), true), header.extra_values);
}

}  // namespace pfgeom
