#include "pfgeom/codec/material_tree_codec.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>

namespace pfgeom {
namespace {

enum Kind : std::uint32_t {
    kIsLeaf,
    kAxis,
    kMoreBits,
    kTilted,
    kTiltSign,
    kIsFresh,
    kIsLowest,
    kIsRecent,
    kWhich,
};

// Materials named before that are looked at one by one; what was named longer ago is written as a number.
constexpr std::size_t kRecent = 16;

}  // namespace

MaterialTreeCoder::MaterialTreeCoder(CodecStream& stream, std::size_t materials)
    : stream_(stream), unused_(materials) {
    std::iota(unused_.begin(), unused_.end(), 0);
}

void MaterialTreeCoder::code(MaterialTree& tree) {
    tree_ = &tree;
    next_ = 0;
    code_node(root_cell(), 0, 0);
}

// Recursion as deep as the tree, at most kMaxMaterialDepth. `context`: 0 for the root, 1 for a high child,
// for a low one 2 if its sibling is a leaf, else 3.
void MaterialTreeCoder::code_node(const Box& cell, int depth, std::uint32_t context) {
    if (stream_.decoding()) {
        if (!stream_.ok() || !stream_.charge(2, sizeof(MaterialNode))) return;
        tree_->nodes.emplace_back();
    }
    const std::int32_t index = next_++;
    MaterialNode node = tree_->nodes[static_cast<std::size_t>(index)];
    const bool leaf = depth >= kMaxMaterialDepth || bit(node.leaf(), kIsLeaf, 40000, {context}) != 0;
    if (leaf) {
        node.material = code_material(node.material);
    } else {
        code_plane(node);
        derive(node, cell);
        node.high = next_;
        code_node(high_cell(node, cell), depth + 1, 1);
        if (!stream_.ok()) return;
        const bool leaf_beside = tree_->nodes[static_cast<std::size_t>(node.high)].leaf();
        node.low = next_;
        code_node(low_cell(node, cell), depth + 1, leaf_beside ? 2 : 3);
    }
    if (stream_.ok()) tree_->nodes[static_cast<std::size_t>(index)] = node;
}

void MaterialTreeCoder::code_plane(MaterialNode& plane) {
    const bool not_x = bit(plane.axis != 0, kAxis, 43690, {0}) != 0;
    plane.axis =
        not_x ? static_cast<std::uint8_t>(1 + bit(plane.axis == 2, kAxis, 32768, {1})) : std::uint8_t{0};
    std::uint32_t bits = 0;
    while (bits < kMostPlaneBits && bit(plane.bits > bits, kMoreBits, 52000, {0, 1 + bits}) != 0) ++bits;
    plane.bits = static_cast<std::uint8_t>(bits);
    for (std::int32_t& tilt : plane.tilt) tilt = code_tilt(tilt, plane.bits);
    const std::int32_t most = ((plane.is_cut() ? 1 : 3) << plane.bits) - 1;
    plane.offset = static_cast<std::int32_t>(choose_evenly(static_cast<std::uint32_t>(plane.offset + most),
                                                           2 * static_cast<std::uint32_t>(most) + 1)) -
                   most;
}

std::int32_t MaterialTreeCoder::code_tilt(std::int32_t tilt, int bits) {
    if (bit(tilt != 0, kTilted, 24000, {0}) == 0) return 0;
    const bool negative = bit(tilt < 0, kTiltSign, 32768, {0}) != 0;
    const auto in = static_cast<std::uint32_t>(std::abs(tilt) - 1);
    const auto size = static_cast<std::int32_t>(1 + stream_.coder.code_raw(in, bits));
    return negative ? -size : size;
}

// New ones mostly come in their order.
std::int32_t MaterialTreeCoder::code_material(std::int32_t material) {
    const bool known = std::find(used_.begin(), used_.end(), material) != used_.end();
    const bool fresh = used_.empty() || (!unused_.empty() && bit(!known, kIsFresh, 24000, {0}) != 0);
    return fresh ? code_fresh(material) : code_used(material);
}

std::int32_t MaterialTreeCoder::code_fresh(std::int32_t material) {
    auto at = unused_.begin();
    if (unused_.size() > 1 && bit(material == *at, kIsLowest, 49152, {0}) == 0) {
        const auto given = std::lower_bound(at + 1, unused_.end(), material) - (at + 1);
        const auto others = static_cast<std::uint32_t>(unused_.size() - 1);
        at += 1 + static_cast<std::ptrdiff_t>(choose_evenly(static_cast<std::uint32_t>(given), others));
    }
    const std::int32_t result = *at;
    unused_.erase(at);
    used_.insert(used_.begin(), result);
    return result;
}

std::int32_t MaterialTreeCoder::code_used(std::int32_t material) {
    const auto given =
        static_cast<std::size_t>(std::find(used_.begin(), used_.end(), material) - used_.begin());
    const std::size_t recent = std::min(kRecent, used_.size());
    std::size_t place = 0;
    if (used_.size() <= kRecent || bit(given < recent, kIsRecent, 49152, {0}) != 0) {
        place = model_.choose(stream_.coder, given, recent, kWhich);
    } else {
        const auto left = static_cast<std::uint32_t>(used_.size() - recent);
        place = recent + choose_evenly(static_cast<std::uint32_t>(given - recent), left);
    }
    std::rotate(used_.begin(), used_.begin() + static_cast<std::ptrdiff_t>(place),
                used_.begin() + static_cast<std::ptrdiff_t>(place) + 1);
    return used_.front();
}

// By halves.
std::uint32_t MaterialTreeCoder::choose_evenly(std::uint32_t choice, std::uint32_t count) {
    std::uint32_t first = 0;
    while (count > 1) {
        const std::uint32_t low = count / 2, high = count - low;
        const auto p = static_cast<Probability>(std::uint64_t{65536} * high / count);
        const bool upper = stream_.coder.code(choice >= first + low ? 1 : 0, p) != 0;
        if (upper) first += low;
        count = upper ? high : low;
    }
    return first;
}

}  // namespace pfgeom
