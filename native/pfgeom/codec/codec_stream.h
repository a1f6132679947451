// What the parts of a model's stream share while it is written or read: one coder, one mixer, one account of
// memory and work, and one status. Every function here and in the *_codec files runs in both directions: it
// takes the value to write and returns (or assigns) the value that a reader gets.
#pragma once

#include "pfgeom/base/status.h"
#include "pfgeom/codec/entropy.h"
#include "pfgeom/codec/mixer.h"
#include "pfgeom/eval/derive.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

/// Kinds of the mixer, two for each integer (ContextMixer::code_uint). 0..127: hierarchy, 128..191: mesh
/// part.
enum StreamKind : std::uint32_t {
    kCountKind = 192,
    kToleranceKind = 194,
    kFrameScaleKind = 196,
    kWideKind = 198,
    kExponentKind = 200,
    kShapeKind = 202,
    kNodeKind = 204,
    kNodeChildKind = 206,
    kFunctionIndexKind = 208,
    kParentKind = 210,
    kMeshCodeKind = 212,
    kHasLevelsFlag = 214,  // flags need one
    kScaledFlag = 215,
    kCavityFlag = 216,
    kMirrorFlag = 217,
    kBoxCentreKind = 218,
    kStepsKind = 220,
    kStepCodeKind = 222,
    kPlaceKind = 224,
    kKnownTurnKind = 226,
    kLargestKind = 228,
    kTurnKind = 230,
    kUnscaledFlag = 232,
    kMirrorAxisKind = 234,
};

struct CodecStream {
    CodecStream() = default;                                                            ///< writes
    explicit CodecStream(int format_version) : version(format_version) {}               ///< writes
    explicit CodecStream(std::span<const std::uint8_t> bytes, int format_version = 1);  ///< reads

    /// Bytes of memory for what is decoded, beside mixer and hierarchies, by byte of the stream.
    static constexpr std::size_t kMemoryPerByte = std::size_t{8} << 10;

    int version = 1;  ///< of the format (codec/header.h)
    EntropyCoder coder;
    ContextMixer mixer;
    DeriveBudget derive;            ///< of the hierarchies
    std::size_t memory = SIZE_MAX;  ///< that may still be allocated
    FormatStatus status = FormatStatus::ok;

    bool decoding() const { return coder.decoding(); }
    bool ok() const { return status == FormatStatus::ok && !coder.exhausted(); }
    /// The first failure stays.
    void fail(FormatStatus why) {
        if (status == FormatStatus::ok) status = why;
    }
    void expect(bool condition) {
        if (!condition) fail(FormatStatus::bad_value);
    }
    /// Takes `count` · `each` bytes from the account; false, and limit_exceeded, if there are not so many.
    bool charge(std::size_t count, std::size_t each);
};

/// One adaptive bit.
bool code_flag(CodecStream& stream, bool value, std::uint32_t kind, std::uint32_t context = 0);

/// Any 64-bit integer: number of bits (adaptive), sign, the bits below the highest.
std::int64_t code_wide(CodecStream& stream, std::int64_t value, std::uint32_t context);

/// Finite doubles, exactly: as integers with a common exponent where 62 bits are enough, else as they are.
void code_numbers(CodecStream& stream, std::span<double> values, std::uint32_t context);

/// The number of elements, charged before they are made.
template <class T>
void code_size(CodecStream& stream, std::vector<T>& list, std::uint32_t context) {
    const std::size_t n =
        stream.mixer.code_uint(stream.coder, static_cast<std::uint32_t>(list.size()), kCountKind, context);
    if (!stream.decoding()) return;
    list.clear();
    if (stream.ok() && stream.charge(n, sizeof(T))) list.resize(n);
}

}  // namespace pfgeom
