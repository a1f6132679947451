#include "pfgeom/codec/combination_codec.h"

#include "pfgeom/base/error.h"
#include "pfgeom/codec/promise_codec.h"

#include <array>
#include <string>

namespace pfgeom {
namespace {

// Contexts of code_size and of code_numbers.
constexpr std::uint32_t kOperandCount = 0, kTransformCount = 1, kStepCount = 2;
constexpr std::uint32_t kRow = 0, kTranslation = 1;
// Contexts of integers that are counts.
constexpr std::uint32_t kObjects = 3;

using Kind = CombinationStep::Kind;

class CombinationCoder {
  public:
    CombinationCoder(CodecStream& stream, Combination& combination) : stream_(stream), c_(combination) {}

    void run() {
        code_size(stream_, c_.operands, kOperandCount);
        for (Operand& operand : c_.operands) {
            if (!stream_.ok()) return;
            code_operand(operand);
        }
        code_size(stream_, c_.transforms, kTransformCount);
        for (Affine& map : c_.transforms) {
            if (!stream_.ok()) return;
            for (Vec3& row : map.rows) code_vector(row, kRow);
            code_vector(map.translation, kTranslation);
        }
        code_size(stream_, c_.steps, kStepCount);
        for (CombinationStep& step : c_.steps) {
            if (!stream_.ok()) return;
            code_step(step);
        }
    }

  private:
    void code_operand(Operand& operand) {
        const std::uint32_t objects = stream_.mixer.code_uint(
            stream_.coder, static_cast<std::uint32_t>(operand.objects), kCountKind, kObjects);
        stream_.expect(objects >= 1 && objects <= INT32_MAX);
        operand.objects = static_cast<std::int32_t>(objects & INT32_MAX);
        if (stream_.ok()) code_promise(stream_, operand.diagonal, operand.promise);
    }

    // A transform's row is that of the next one; an operand's is how far it stands before the next new one.
    void code_step(CombinationStep& step) {
        const std::uint32_t kind =
            stream_.mixer.code_uint(stream_.coder, static_cast<std::uint32_t>(step.kind), kNodeKind);
        if (kind > static_cast<std::uint32_t>(Kind::transform)) return stream_.fail(FormatStatus::bad_value);
        step.kind = static_cast<Kind>(kind);
        if (step.kind == Kind::transform) step.row = next_transform_++;
        if (step.kind != Kind::operand) return;
        const auto in = static_cast<std::uint32_t>(next_operand_ - step.row);
        const std::uint32_t back = stream_.mixer.code_uint(stream_.coder, in, kFunctionIndexKind);
        if (back > static_cast<std::uint32_t>(next_operand_)) return stream_.fail(FormatStatus::bad_value);
        step.row = next_operand_ - static_cast<std::int32_t>(back);
        next_operand_ += back == 0 ? 1 : 0;
    }

    void code_vector(Vec3& v, std::uint32_t context) {
        std::array<double, 3> values{v.x, v.y, v.z};
        code_numbers(stream_, values, context);
        v = {values[0], values[1], values[2]};
    }

    CodecStream& stream_;
    Combination& c_;
    std::int32_t next_operand_ = 0, next_transform_ = 0;
};

}  // namespace

std::vector<std::uint8_t> write_combination(const Combination& combination) {
    CodecStream stream;
    Combination copy = combination;
    CombinationCoder(stream, copy).run();
    if (stream.status != FormatStatus::ok) throw InvalidInput(std::string(describe(stream.status)));
    return stream.coder.finish();
}

FormatStatus read_combination(std::span<const std::uint8_t> content, Combination& combination) {
    CodecStream stream(content);
    CombinationCoder(stream, combination).run();
    if (stream.status != FormatStatus::ok) return stream.status;
    if (!stream.coder.ended_cleanly()) return FormatStatus::bad_stream;
    // An empty one is not written.
    return combination.empty() ? FormatStatus::bad_section : FormatStatus::ok;
}

}  // namespace pfgeom
