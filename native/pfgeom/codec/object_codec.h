// The objects of a model: frame, shape (set expression, sheet, mesh part or set tree), nesting, instances.
#pragma once

#include "pfgeom/codec/backoff_model.h"
#include "pfgeom/codec/codec_stream.h"
#include "pfgeom/function/model.h"

namespace pfgeom {

class ObjectCoder {
  public:
    /// The functions and the diagonal of `model` are known to both sides.
    ObjectCoder(CodecStream& stream, const Model& model);

    /// Each object is predicted from the one before.
    void code(Object& object);
    /// Bits of the last object's shape and placements.
    double shape_bits() const { return shape_bits_; }

  private:
    void code_frame(Frame& frame);
    void code_shape(Object& object);
    void code_solid(Solid& solid);
    void code_node(SetNode& node, std::int32_t index);
    void code_child(std::int32_t& child, std::int32_t parent);
    void code_function_index(std::int32_t& function);
    void code_mirror(MeshPart& part);
    void code_mesh(MeshPart& part, bool curved);
    void code_nesting(std::int32_t& cavity_of);
    void code_vector(Vec3& v, std::uint32_t context);
    std::int32_t code_int(std::int32_t value, std::uint32_t kind);

    CodecStream& stream_;
    BackoffModel tree_model_;
    std::int32_t function_count_;
    std::int32_t next_function_ = 0;  // the first one that no object has used yet
    std::int32_t index_ = 0;          // of the object
    Frame before_;
    double shape_bits_ = 0;
    std::uint8_t mesh_code_ = 40;  // a chord tolerance of 1e-3
};

}  // namespace pfgeom
