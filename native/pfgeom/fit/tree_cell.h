// What a cell of a growing tree holds, patch by patch: enough to judge any question without its samples.
#pragma once

#include "pfgeom/base/box.h"
#include "pfgeom/fit/tree_builder.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace pfgeom {

/// A node's question, or that there is none.
struct Question {
    TreeNode node;
    double bits = 0;
    double score = Box::kInf;  ///< bits + what is left to do on both sides

    bool high(const SampleTable& samples, std::size_t i) const {
        if (node.kind == TreeNode::Kind::cut) return samples[i].point[node.axis] >= node.cut;
        return samples.positive(i, static_cast<std::size_t>(node.quadric));
    }
};

class TreeCell {
  public:
    TreeCell(const SampleTable& samples, std::span<const std::int32_t> members, const BuildOptions& options);

    std::size_t patches() const { return patch_.size(); }
    std::int32_t patch(std::size_t k) const { return patch_[k]; }
    const Box& bounds() const { return bounds_; }  ///< of the samples looked at
    /// Sets the score; false if all samples are on one side.
    bool judge(Question& question) const;
    /// The samples looked at.
    const std::vector<std::int32_t>& seen() const { return seen_; }

  private:
    /// Patches with samples of each side of the surface, on one side of a question.
    struct Rest {
        int outside = 0, inside = 0, mixed = 0;

        void add(bool out, bool in) {
            outside += out;
            inside += in;
            mixed += out && in;
        }
    };
    double left_to_do(const Rest& rest) const;
    void look_at(std::size_t sample, std::size_t slot);

    const SampleTable& samples_;
    const BuildOptions& options_;
    std::vector<std::int32_t> patch_;
    std::vector<std::array<std::int32_t, 2>> count_;  // of each patch, by label
    std::vector<std::array<Box, 2>> box_;
    std::vector<std::uint64_t> any_high_,
        any_low_;  // quadrics with a sample on that side; patch, label, word
    Box bounds_;
    std::vector<std::int32_t> seen_;
};

}  // namespace pfgeom
