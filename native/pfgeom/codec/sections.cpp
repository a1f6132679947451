#include "pfgeom/codec/sections.h"

#include "pfgeom/base/utf8.h"
#include "pfgeom/codec/byte_reader.h"
#include "pfgeom/codec/byte_writer.h"
#include "pfgeom/codec/combination_codec.h"
#include "pfgeom/codec/material_codec.h"
#include "pfgeom/function/check.h"

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

constexpr std::size_t kStoredMatrix = 12;  // the last row is 0 0 0 1

// One byte of length, then UTF-8, for each name.
std::vector<std::uint8_t> write_names(const std::vector<std::string>& names) {
    ByteWriter out;
    for (const std::string& name : names) {
        out.byte(static_cast<std::uint8_t>(name.size()));
        for (const char c : name) out.byte(static_cast<std::uint8_t>(c));
    }
    return out.take();
}

FormatStatus read_names(std::span<const std::uint8_t> content, std::vector<std::string>& names) {
    ByteReader reader(content);
    while (reader.left() > 0) {
        const auto text = reader.take(reader.byte());
        if (!reader.ok()) return FormatStatus::bad_section;
        names.emplace_back(text.begin(), text.end());
        if (!is_utf8(names.back())) return FormatStatus::bad_value;
    }
    return FormatStatus::ok;
}

std::vector<std::uint8_t> write_transform(const std::vector<double>& matrix) {
    ByteWriter out;
    for (std::size_t i = 0; i < kStoredMatrix; ++i) out.f64(matrix[i] + 0.0);  // no negative zero
    return out.take();
}

FormatStatus read_transform(std::span<const std::uint8_t> content, std::vector<double>& matrix) {
    if (content.size() != kStoredMatrix * sizeof(double)) return FormatStatus::bad_section;
    ByteReader reader(content);
    for (std::size_t i = 0; i < kStoredMatrix; ++i) {
        const double v = reader.f64();
        if (!std::isfinite(v) || (v == 0 && std::signbit(v))) return FormatStatus::bad_value;
        matrix.push_back(v);
    }
    matrix.insert(matrix.end(), {0, 0, 0, 1});
    return FormatStatus::ok;
}

// Runs: varint label, varint (length of the run - 1); neighbouring runs differ in their label.
std::vector<std::uint8_t> write_face_groups(const std::vector<std::int32_t>& labels) {
    ByteWriter out;
    for (auto run = labels.begin(); run != labels.end();) {
        const auto end = std::find_if(run, labels.end(), [run](std::int32_t label) { return label != *run; });
        out.varint(static_cast<std::uint64_t>(*run));
        out.varint(static_cast<std::uint64_t>(end - run - 1));
        run = end;
    }
    return out.take();
}

FormatStatus read_face_groups(std::span<const std::uint8_t> content, std::size_t memory,
                              std::vector<std::int32_t>& labels) {
    std::size_t count =
        0;  // a first pass counts, so that nothing is made before all of it is known to be allowed
    std::uint64_t before = ~std::uint64_t{0};
    for (ByteReader reader(content); reader.left() > 0;) {
        const std::uint64_t label = reader.varint(), more = reader.varint();
        if (!reader.ok()) return FormatStatus::bad_section;
        if (label > INT32_MAX || label == before) return FormatStatus::bad_value;
        if (more >= memory / sizeof(std::int32_t) - count) return FormatStatus::limit_exceeded;
        count += static_cast<std::size_t>(more) + 1;
        before = label;
    }
    labels.reserve(count);
    for (ByteReader reader(content); reader.left() > 0;) {
        const auto label = static_cast<std::int32_t>(reader.varint());
        labels.insert(labels.end(), static_cast<std::size_t>(reader.varint()) + 1, label);
    }
    return FormatStatus::ok;
}

}  // namespace

std::vector<Section> write_sections(const Model& model) {
    std::vector<Section> sections;
    if (!model.names.empty()) sections.push_back({SectionId::names, false, write_names(model.names)});
    if (!model.world_transform.empty()) {
        sections.push_back({SectionId::world_transform, false, write_transform(model.world_transform)});
    }
    if (!model.face_groups.empty()) {
        sections.push_back({SectionId::face_groups, false, write_face_groups(model.face_groups)});
    }
    if (!model.materials.empty()) sections.push_back({SectionId::materials, false, write_materials(model)});
    if (!model.combination.empty())
        sections.push_back({SectionId::combination, true, write_combination(model.combination)});
    return sections;
}

FormatStatus read_sections(const Envelope& envelope, std::size_t memory, Model& model) {
    for (const Envelope::View& section : envelope.sections) {
        FormatStatus status = FormatStatus::ok;
        switch (section.id) {
            case SectionId::names:
                status = read_names(section.content, model.names);
                break;
            case SectionId::world_transform:
                status = read_transform(section.content, model.world_transform);
                break;
            case SectionId::face_groups:
                status = read_face_groups(section.content, memory, model.face_groups);
                break;
            case SectionId::materials:
                status = read_materials(section.content, memory, model);
                break;
            case SectionId::combination:
                status = read_combination(section.content, model.combination);
                break;
        }
        if (status != FormatStatus::ok) return status;
    }
    return FormatStatus::ok;
}

}  // namespace pfgeom
