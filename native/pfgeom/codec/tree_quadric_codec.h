// The quadrics of a set tree: family, shifts, integers. An integer is coded by how many bits it has more or
// less than those before it let expect, the constant of a round quadric as a difference from the value that
// gives its surface a slope of 1, so that a small cylinder or sphere does not pay twice for its place. Where
// an earlier quadric of the tree shares many integers but for their signs (parallel planes, equal radii,
// mirrored parts), it is named and only what differs is written: a quarter of the bytes of plates with holes.
#pragma once

#include "pfgeom/codec/backoff_model.h"
#include "pfgeom/codec/codec_stream.h"
#include "pfgeom/function/quadric_family.h"
#include "pfgeom/function/set_tree.h"

#include <span>

namespace pfgeom {

class TreeQuadricCoder {
  public:
    TreeQuadricCoder(CodecStream& stream, BackoffModel& model) : stream_(stream), model_(model) {}

    static constexpr std::uint32_t kKinds = 16;  ///< of the model: those below are this coder's

    /// Codes quadrics[index] or reads into it, given those before it; what it means is derived on both sides.
    /// Values out of range fail the stream.
    void code(std::span<TreeQuadric> quadrics, std::size_t index, int resolution);

  private:
    const TreeQuadric* code_like(std::span<const TreeQuadric> earlier, const TreeQuadric& quadric);
    void code_form(TreeQuadric& quadric);
    void code_family(TreeQuadric& quadric);
    std::uint8_t code_shift(std::uint8_t shift, std::uint32_t kind, FamilyKind family);
    bool code_same(std::int32_t& n, std::int32_t like, std::uint32_t role);
    void code_integer(TreeQuadric& quadric, int index, int resolution);
    std::int32_t code_value(std::int32_t value, int expected_width, std::uint32_t role, std::uint32_t place);
    int code_width(int width, int expected, std::uint32_t role, std::uint32_t place);
    int bit(int value, std::uint32_t kind, Probability prior, std::initializer_list<std::uint32_t> contexts) {
        return model_.code(stream_.coder, value, kind, prior, contexts);
    }

    CodecStream& stream_;
    BackoffModel& model_;
};

}  // namespace pfgeom
