#include "pfgeom/codec/codec.h"
#include "pfgeom/codec/function_codec.h"
#include "pfgeom/codec/model_codec.h"

#include <cmath>
#include <vector>

namespace pfgeom {
namespace {

// Functions that an object names, in no particular order.
std::vector<std::int32_t> functions_of(const Object& object) {
    std::vector<std::int32_t> used;
    if (const auto* sheet = std::get_if<Sheet>(&object.shape)) {
        used.push_back(sheet->surface);
        if (sheet->trim >= 0) used.push_back(sheet->trim);
    }
    if (const auto* solid = std::get_if<Solid>(&object.shape)) {
        for (const SetNode& node : solid->nodes) {
            if (node.kind == SetNode::Kind::function) used.push_back(node.a);
            if (node.kind == SetNode::Kind::decide) used.push_back(node.f);
        }
    }
    return used;
}

// A function counts for the first object that uses it.
std::vector<double> bytes_of_objects(const Model& model, const StreamCost& cost) {
    std::vector<double> bytes;
    std::vector<bool> counted(model.functions.size(), false);
    for (std::size_t i = 0; i < model.objects.size(); ++i) {
        double bits = cost.shapes[i];
        for (const std::int32_t f : functions_of(model.objects[i])) {
            const auto row = static_cast<std::size_t>(f);
            if (!counted[row]) bits += cost.functions[row];
            counted[row] = true;
        }
        bytes.push_back(bits / 8);
    }
    return bytes;
}

double bits_alone(Function function, std::size_t levels) {
    function.levels.resize(levels);
    CodecStream stream;
    code_function(stream, function);
    return stream.coder.bits_so_far();
}

// What each level adds to a stream that holds the function alone.
void add_bytes_of_levels(const Function& function, std::vector<double>& bytes) {
    double before = 0;
    for (std::size_t i = 0; i < function.levels.size(); ++i) {
        const double bits = bits_alone(function, i + 1);
        const auto depth = static_cast<std::size_t>(function.levels[i].depth);
        if (bytes.size() <= depth) bytes.resize(depth + 1);
        bytes[depth] += (bits - before) / 8;
        before = bits;
    }
}

}  // namespace

SizeReport measure_size(const Model& model) {
    SizeReport report;
    report.total = encode(model).size();
    Model copy = canonical(model);
    CodecStream stream(version_of(copy));
    StreamCost cost;
    code_model(stream, copy, &cost);
    report.bytes_of_object = bytes_of_objects(copy, cost);
    double body = 0;
    for (const double bits : cost.functions) body += bits / 8;
    for (const double bits : cost.shapes) body += bits / 8;
    report.head = static_cast<std::size_t>(std::lround(static_cast<double>(report.total) - body));
    for (const Function& function : copy.functions) add_bytes_of_levels(function, report.bytes_of_level);
    return report;
}

}  // namespace pfgeom
