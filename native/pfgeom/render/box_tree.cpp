#include "pfgeom/render/box_tree.h"

#include <numeric>

namespace pfgeom {
namespace {

int longest_axis(const Vec3& e) {
    return e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
}

}  // namespace

BoxTree::BoxTree(std::span<const Box> boxes) {
    if (boxes.empty()) return;
    std::vector<std::int32_t> items(boxes.size());
    std::iota(items.begin(), items.end(), 0);
    nodes_.reserve(2 * boxes.size());
    nodes_.emplace_back();
    split(0, items, boxes);
}

// Halves of equal count across the longest axis of the centres.
void BoxTree::split(std::int32_t node, std::span<std::int32_t> items, std::span<const Box> boxes) {
    Box box, centres;
    for (const std::int32_t i : items) {
        box.grow(boxes[static_cast<std::size_t>(i)]);
        centres.grow(boxes[static_cast<std::size_t>(i)].centre());
    }
    nodes_[static_cast<std::size_t>(node)].box = box;
    if (items.size() == 1) {
        nodes_[static_cast<std::size_t>(node)].item = items[0];
        return;
    }
    const int axis = longest_axis(centres.extent());
    std::stable_sort(items.begin(), items.end(), [&](std::int32_t i, std::int32_t j) {
        return boxes[static_cast<std::size_t>(i)].centre()[axis] <
               boxes[static_cast<std::size_t>(j)].centre()[axis];
    });
    const auto first = static_cast<std::int32_t>(nodes_.size());
    nodes_[static_cast<std::size_t>(node)].first = first;
    nodes_.resize(nodes_.size() + 2);
    split(first, items.first(items.size() / 2), boxes);
    split(first + 1, items.subspan(items.size() / 2), boxes);
}

}  // namespace pfgeom
