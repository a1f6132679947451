#include "pfgeom/fit/tree_cell.h"

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

// Bits that a mixed patch takes to tell apart, and the least that a mixed cell takes in patches.
constexpr double kBitsOfPatch = 6, kLeastPatches = 0.6;
// Every patch in a cell makes it a little dearer, since it may have to be told from the others.
constexpr double kCrowding = 0.3;

// n^(1 + eighths/8) by square roots, which are the same on every machine.
double to_the_power(double n, int eighths) {
    double result = n, root = n;
    for (int bit = 4; bit > 0; bit /= 2) {
        root = std::sqrt(root);
        if ((eighths & bit) != 0) result *= root;
    }
    return (eighths & 8) != 0 ? result * n : result;
}

}  // namespace

TreeCell::TreeCell(const SampleTable& samples, std::span<const std::int32_t> members,
                   const BuildOptions& options)
    : samples_(samples), options_(options) {
    std::vector<std::int32_t> slots(samples.quadrics(), -1);
    for (const std::int32_t i : members) {
        const TreeSample& s = samples[static_cast<std::size_t>(i)];
        std::int32_t& slot = slots[static_cast<std::size_t>(s.patch)];
        if (slot < 0) {
            slot = static_cast<std::int32_t>(patch_.size());
            patch_.push_back(s.patch);
            count_.push_back({0, 0});
            box_.emplace_back();
            any_high_.resize(any_high_.size() + 2 * samples.words(), 0);
            any_low_.resize(any_low_.size() + 2 * samples.words(), 0);
        }
        look_at(static_cast<std::size_t>(i), static_cast<std::size_t>(slot));
    }
}

void TreeCell::look_at(std::size_t sample, std::size_t slot) {
    const TreeSample& s = samples_[sample];
    const std::size_t label = s.inside ? 1 : 0, words = samples_.words();
    if (count_[slot][label] >= options_.cap) return;
    ++count_[slot][label];
    box_[slot][label].grow(s.point);
    bounds_.grow(s.point);
    const std::uint64_t* signs = samples_.signs(sample);
    for (std::size_t w = 0; w < words; ++w) {
        any_high_[(2 * slot + label) * words + w] |= signs[w];
        any_low_[(2 * slot + label) * words + w] |= ~signs[w];
    }
    seen_.push_back(static_cast<std::int32_t>(sample));
}

double TreeCell::left_to_do(const Rest& rest) const {
    if (rest.outside == 0 || rest.inside == 0) return 0;
    const int pure_outside = rest.outside - rest.mixed, pure_inside = rest.inside - rest.mixed;
    const double patches =
        std::max(rest.mixed, 1) + options_.single_weight * (std::min(pure_outside, pure_inside) +
                                                            kCrowding * (pure_outside + pure_inside));
    return kBitsOfPatch * to_the_power(std::max(patches, kLeastPatches), options_.power);
}

bool TreeCell::judge(Question& question) const {
    const TreeNode& node = question.node;
    const bool cut = node.kind == TreeNode::Kind::cut;
    const std::size_t words = samples_.words();
    const std::size_t word = cut ? 0 : static_cast<std::size_t>(node.quadric) / 64;
    const std::uint64_t bit = std::uint64_t{1} << (cut ? 0 : node.quadric % 64);
    Rest high, low;
    for (std::size_t k = 0; k < patch_.size(); ++k) {
        std::array<bool, 2> on_high{}, on_low{};
        for (std::size_t label = 0; label < 2; ++label) {
            if (cut) {
                on_high[label] = box_[k][label].hi[node.axis] >= node.cut;
                on_low[label] = box_[k][label].lo[node.axis] < node.cut;
            } else {
                on_high[label] = (any_high_[(2 * k + label) * words + word] & bit) != 0;
                on_low[label] = (any_low_[(2 * k + label) * words + word] & bit) != 0;
            }
        }
        high.add(on_high[0], on_high[1]);
        low.add(on_low[0], on_low[1]);
    }
    const int n_high = high.outside + high.inside, n_low = low.outside + low.inside;
    if (n_high == 0 || n_low == 0) return false;
    constexpr double kBalance = 1e-6;  // decides between equals only
    question.score = question.bits + left_to_do(high) + left_to_do(low) + kBalance * std::abs(n_high - n_low);
    return true;
}

}  // namespace pfgeom
