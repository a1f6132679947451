#include "pfgeom/mesh/ply_header.h"

#include <optional>
#include <string_view>

namespace pfgeom {
namespace {

struct TypeName {
    std::string_view name, sized_name;
    PlyType type;
    std::size_t bytes;
};

constexpr TypeName kTypes[] = {
    {"char", "int8", PlyType::int8, 1},        {"uchar", "uint8", PlyType::uint8, 1},
    {"short", "int16", PlyType::int16, 2},     {"ushort", "uint16", PlyType::uint16, 2},
    {"int", "int32", PlyType::int32, 4},       {"uint", "uint32", PlyType::uint32, 4},
    {"float", "float32", PlyType::float32, 4}, {"double", "float64", PlyType::float64, 8},
};

PlyType read_type(TextScanner& scanner) {
    const std::string_view word = scanner.word();
    for (const TypeName& known : kTypes)
        if (word == known.name || word == known.sized_name) return known.type;
    scanner.fail("unknown type of a property");
}

PlyFormat read_format(TextScanner& scanner) {
    const std::string_view word = scanner.word();
    if (word == "ascii") return PlyFormat::ascii;
    if (word == "binary_little_endian") return PlyFormat::little_endian;
    if (word == "binary_big_endian") return PlyFormat::big_endian;
    scanner.fail("unknown format");
}

PlyElement read_element(TextScanner& scanner) {
    PlyElement element;
    element.name = scanner.word();
    element.count = scanner.integer();
    if (element.count < 0) scanner.fail("a negative number of elements");
    return element;
}

PlyProperty read_property(TextScanner& scanner) {
    PlyProperty property;
    TextScanner ahead = scanner;
    if (ahead.word() == "list") {
        scanner = ahead;
        property.list = true;
        property.count_type = read_type(scanner);
    }
    property.type = read_type(scanner);
    property.name = scanner.word();
    return property;
}

}  // namespace

std::size_t byte_size(PlyType type) {
    return kTypes[static_cast<std::size_t>(type)].bytes;
}

PlyHeader read_ply_header(TextScanner& scanner) {
    if (scanner.word() != "ply") scanner.fail("a PLY file begins with 'ply'");
    PlyHeader header;
    std::optional<PlyFormat> format;
    while (scanner.next_line()) {
        const std::string_view keyword = scanner.word();
        if (keyword == "end_header") {
            if (!format) scanner.fail("the header names no format");
            header.format = *format;
            scanner.next_line();
            return header;
        }
        if (keyword == "format") format = read_format(scanner);
        if (keyword == "element") header.elements.push_back(read_element(scanner));
        if (keyword == "property") {
            if (header.elements.empty()) scanner.fail("a property before the first element");
            header.elements.back().properties.push_back(read_property(scanner));
        }
    }
    scanner.fail("the file ends within its header");
}

}  // namespace pfgeom
