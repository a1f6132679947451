// PLY, ascii and binary of both byte orders. Taken are x, y, z of "vertex" and the list "vertex_indices" (or
// "vertex_index") of "face" (polygons) and "tristrips" (strips of triangles, -1 between two strips), and
// "material_index" of "face"; other elements and properties are passed over, in any order.
#include "pfgeom/base/error.h"
#include "pfgeom/base/limits.h"
#include "pfgeom/mesh/binary_scanner.h"
#include "pfgeom/mesh/formats.h"
#include "pfgeom/mesh/mesh_builder.h"
#include "pfgeom/mesh/ply_header.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace pfgeom {
namespace {

/// The values of an ascii body. A value takes a digit and a separator at least.
class AsciiSource {
  public:
    explicit AsciiSource(const TextScanner& scanner) : scanner_(scanner) {}
    std::size_t bytes_left() const { return scanner_.bytes_left() + 1; }
    static std::size_t least_bytes(PlyType) { return 2; }

    double number(PlyType) {
        seek();
        return scanner_.number();
    }
    std::int64_t integer(PlyType) {
        seek();
        return scanner_.integer();
    }

  private:
    void seek() {
        if (!scanner_.seek_word()) scanner_.fail("the file ends before its content does");
    }
    TextScanner scanner_;
};

class BinarySource {
  public:
    BinarySource(std::span<const std::uint8_t> bytes, bool big_endian) : reader_(bytes, big_endian) {}
    std::size_t bytes_left() const { return reader_.bytes_left(); }
    static std::size_t least_bytes(PlyType type) { return byte_size(type); }

    double number(PlyType type) {
        switch (type) {
            case PlyType::float32:
                return reader_.get<float>();
            case PlyType::float64:
                return reader_.get<double>();
            default:
                return static_cast<double>(integer(type));
        }
    }
    std::int64_t integer(PlyType type) {
        switch (type) {
            case PlyType::int8:
                return reader_.get<std::int8_t>();
            case PlyType::uint8:
                return reader_.get<std::uint8_t>();
            case PlyType::int16:
                return reader_.get<std::int16_t>();
            case PlyType::uint16:
                return reader_.get<std::uint16_t>();
            case PlyType::int32:
                return reader_.get<std::int32_t>();
            case PlyType::uint32:
                return reader_.get<std::uint32_t>();
            default:
                return whole(number(type));
        }
    }

  private:
    static std::int64_t whole(double value) {
        if (!(std::abs(value) < 1e15) || value != std::floor(value))
            throw InvalidInput("an index or a list's length is no whole number");
        return static_cast<std::int64_t>(value);
    }
    BinaryScanner reader_;
};

void check_count(const PlyElement& element, std::size_t least, std::size_t bytes_left) {
    if (least > 0 && static_cast<std::uint64_t>(element.count) > bytes_left / least)
        throw InvalidInput("the header announces " + std::to_string(element.count) + " elements '" +
                           element.name + "', the file has room for " + std::to_string(bytes_left / least));
}

/// A list's values to `values`; nothing is allocated for values that are not there.
template <class Source>
void read_list(Source& source, const PlyProperty& property, std::vector<std::int64_t>& values) {
    values.clear();
    const std::int64_t n = source.integer(property.count_type);
    if (n < 0 || static_cast<std::uint64_t>(n) > source.bytes_left() / source.least_bytes(property.type))
        throw InvalidInput("a list of " + std::to_string(n) + " values, more than the file has room for");
    for (std::int64_t i = 0; i < n; ++i) values.push_back(source.integer(property.type));
}

template <class Source>
void skip(Source& source, const PlyProperty& property) {
    const std::int64_t n = property.list ? source.integer(property.count_type) : 1;
    for (std::int64_t i = 0; i < n; ++i) source.number(property.type);
}

/// Strips turn the direction of every second triangle. Triangles with two equal corners only lead the strip
/// on to its next place; they are no faces.
void add_strips(MeshBuilder& builder, const std::vector<std::int64_t>& strip, std::int64_t element) {
    std::size_t start = 0;
    for (std::size_t i = 0; i < strip.size(); ++i) {
        if (strip[i] == -1) start = i + 1;
        if (i < start + 2 || strip[i] == -1) continue;
        const std::int64_t a = strip[i - 2], b = strip[i - 1], c = strip[i];
        if (a == b || b == c || c == a) continue;
        const bool turned = (i - start) % 2 == 1;
        const std::int64_t corners[] = {turned ? b : a, turned ? a : b, c};
        builder.add_polygon(corners, {"strip", element});
    }
}

bool has_property(const PlyElement& element, std::initializer_list<std::string_view> names) {
    return std::any_of(element.properties.begin(), element.properties.end(), [&](const PlyProperty& p) {
        return std::find(names.begin(), names.end(), p.name) != names.end();
    });
}

std::vector<std::string> lost_of(const PlyHeader& header) {
    const auto says = [&](std::initializer_list<std::string_view> names) {
        return std::any_of(header.elements.begin(), header.elements.end(),
                           [&](const PlyElement& element) { return has_property(element, names); });
    };
    std::vector<std::string> lost;
    if (says({"s", "t", "u", "v", "texture_u", "texture_v", "texcoord"}))
        lost.emplace_back("texture coordinates");
    if (says({"nx", "ny", "nz"})) lost.emplace_back("normals");
    if (says({"red", "green", "blue", "r", "g", "b", "alpha"})) lost.emplace_back("colours");
    return lost;
}

template <class Source>
class PlyReader {
  public:
    explicit PlyReader(Source source) : source_(std::move(source)) {}

    LoadedMesh read(const PlyHeader& header) {
        for (const PlyElement& element : header.elements) {
            std::size_t least = 0;
            for (const PlyProperty& p : element.properties)
                least += source_.least_bytes(p.list ? p.count_type : p.type);
            if (least == 0) continue;  // no properties: nothing of it is in the file
            check_count(element, least, source_.bytes_left());
            if (element.name == "face") has_materials_ = has_property(element, {"material_index"});
            for (std::int64_t i = 0; i < element.count; ++i) read_row(element, i);
        }
        FaceMaterials painted = materials();
        return {builder_.finish(), std::move(painted), lost_of(header)};
    }

  private:
    // Strips have none.
    FaceMaterials materials() {
        constexpr auto kMost = static_cast<std::int64_t>(Limits{}.materials);
        FaceMaterials result;
        std::int64_t highest = -1;
        for (const std::int64_t m : materials_) {
            if (m < 0 || m >= kMost) return {};
            highest = std::max(highest, m);
        }
        if (highest < 0) return {};
        materials_.resize(builder_.face_count(), 0);
        result.of_face.assign(materials_.begin(), materials_.end());
        result.names.resize(static_cast<std::size_t>(highest) + 1);
        return result;
    }

    void read_row(const PlyElement& element, std::int64_t row) {
        const bool is_vertex = element.name == "vertex";
        const bool is_face = element.name == "face", is_strips = element.name == "tristrips";
        constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
        Vec3 position{kMissing, kMissing, kMissing};
        std::int64_t material = -1;
        for (const PlyProperty& property : element.properties) {
            const bool is_axis =
                property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z';
            const bool is_corners = property.name == "vertex_indices" || property.name == "vertex_index";
            if (is_vertex && is_axis && !property.list) {
                position[property.name[0] - 'x'] = source_.number(property.type);
            } else if ((is_face || is_strips) && is_corners && property.list) {
                read_list(source_, property, list_);
                if (is_face) builder_.add_polygon(list_, {"face", row});
                if (is_strips) add_strips(builder_, list_, row);
            } else if (is_face && property.name == "material_index" && !property.list) {
                material = source_.integer(property.type);
            } else {
                skip(source_, property);
            }
        }
        if (is_vertex) builder_.add_vertex(position);
        if (is_face && has_materials_) materials_.resize(builder_.face_count(), material);
    }

    Source source_;
    MeshBuilder builder_;
    std::vector<std::int64_t> list_, materials_;
    bool has_materials_ = false;
};

}  // namespace

LoadedMesh read_ply_file(std::span<const std::uint8_t> bytes) {
    TextScanner scanner(bytes);
    const PlyHeader header = read_ply_header(scanner);
    if (header.format == PlyFormat::ascii) return PlyReader(AsciiSource(scanner)).read(header);
    const bool big_endian = header.format == PlyFormat::big_endian;
    return PlyReader(BinarySource(bytes.last(scanner.bytes_left()), big_endian)).read(header);
}

}  // namespace pfgeom
