// The decision trees of materials, in either direction.
#pragma once

#include "pfgeom/base/box.h"
#include "pfgeom/codec/backoff_model.h"
#include "pfgeom/codec/codec_stream.h"
#include "pfgeom/function/material_map.h"

#include <cstdint>
#include <vector>

namespace pfgeom {

class MaterialTreeCoder {
  public:
    MaterialTreeCoder(CodecStream& stream, std::size_t materials);

    /// What was coded before is known to both sides.
    void code(MaterialTree& tree);

  private:
    void code_node(const Box& cell, int depth, std::uint32_t context);
    void code_plane(MaterialNode& plane);
    std::int32_t code_tilt(std::int32_t tilt, int bits);
    std::int32_t code_material(std::int32_t material);
    std::int32_t code_fresh(std::int32_t material);
    std::int32_t code_used(std::int32_t material);
    std::uint32_t choose_evenly(std::uint32_t choice, std::uint32_t count);
    int bit(int value, std::uint32_t kind, Probability prior, std::initializer_list<std::uint32_t> contexts) {
        return model_.code(stream_.coder, value, kind, prior, contexts);
    }

    CodecStream& stream_;
    BackoffModel model_;
    MaterialTree* tree_ = nullptr;
    std::int32_t next_ = 0;             // node
    std::vector<std::int32_t> unused_;  // materials that no leaf has had yet, rising
    std::vector<std::int32_t> used_;    // the others, the one last named first
};

}  // namespace pfgeom
