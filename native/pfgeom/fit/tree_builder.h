// From points with a side and quadrics to a decision tree that tells every point its side.
// Source: greedy top-down induction (Breiman, Friedman, Olshen, Stone, "Classification and regression trees",
// 1984) over the questions that the format has. Departures: what is left to do in a cell is not its entropy
// but the number of surface patches that still have both sides in it, to a power: on a pair of parallel faces
// no question gains any information, yet one between them leaves two easy cells. The best few questions of a
// cell are tried to the end, greedily.
#pragma once

#include "pfgeom/base/task.h"
#include "pfgeom/fit/tree_quadric.h"
#include "pfgeom/fit/tree_samples.h"
#include "pfgeom/function/set_tree.h"

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace pfgeom {

/// Samples and, of each, the sides of all quadrics on which it is: the only place where quadrics are
/// evaluated.
class SampleTable {
  public:
    SampleTable() = default;
    /// Patches of the samples are indices into `quadrics`.
    SampleTable(std::vector<TreeSample> samples, std::span<const QuantisedQuadric> quadrics,
                const Task& task);
    /// `quadrics`: the same as before.
    void add(std::span<const TreeSample> samples, std::span<const QuantisedQuadric> quadrics,
             const Task& task);

    std::size_t size() const { return samples_.size(); }
    std::size_t words() const { return words_; }
    std::size_t quadrics() const { return quadrics_; }
    const TreeSample& operator[](std::size_t i) const { return samples_[i]; }
    const std::uint64_t* signs(std::size_t i) const { return &signs_[i * words_]; }
    bool positive(std::size_t i, std::size_t q) const { return (signs(i)[q / 64] >> (q % 64) & 1U) != 0; }

  private:
    void look_at_sides(std::size_t first, std::span<const QuantisedQuadric> quadrics, const Task& task);

    std::vector<TreeSample> samples_;
    std::size_t quadrics_ = 0, words_ = 0;
    std::vector<std::uint64_t> signs_;  // bit q of sample i: quadrics[q] >= 0
};

struct BuildOptions {
    int power = 4;                ///< a cell with n mixed patches costs n^(1 + power/8)
    double single_weight = 0.4;   ///< of a patch that has one side only in the cell
    int cap = 48;                 ///< samples looked at of each patch and label in a cell
    int tried = 1;                ///< so many questions of a cell are tried to the end
    std::size_t most_tried = 64;  ///< unless it has more patches than this
    bool peel = false;            ///< questions with one answer (fit/tree_peel.h) come before all others
    std::size_t most_samples = std::numeric_limits<std::size_t>::max();  ///< the first ones
    double most_bits = std::numeric_limits<double>::infinity();          ///< a tree of so many is given up
};

/// A tree whose questions count quadrics as the builder was given them. One that was given up has no nodes
/// and infinitely many bits.
struct RawTree {
    std::vector<TreeNode> nodes;  ///< as in SetTree, cuts derived
    double bits = 0;              ///< estimate, with the quadrics that are used
    int forced = 0;               ///< leaves that nothing could split
};

RawTree build_tree(const SampleTable& samples, std::span<const QuantisedQuadric> quadrics, const Box& box,
                   const BuildOptions& options, const Task& task);

/// Keeps all questions; grows new ones only in leaves that a sample contradicts.
RawTree repair_tree(const RawTree& old, const SampleTable& samples,
                    std::span<const QuantisedQuadric> quadrics, const Box& box, const BuildOptions& options,
                    const Task& task);

/// How many samples the tree gets wrong.
std::size_t wrong_samples(const RawTree& tree, const SampleTable& samples);

}  // namespace pfgeom
