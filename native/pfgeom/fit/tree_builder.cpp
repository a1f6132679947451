#include "pfgeom/fit/tree_builder.h"

#include "pfgeom/base/parallel.h"
#include "pfgeom/fit/tree_cell.h"
#include "pfgeom/fit/tree_peel.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace pfgeom {
namespace {

// Bits of a node, about as the coder has them.
constexpr double kLeafBits = 1.5, kCutBits = 8, kFineCutBits = 14;
constexpr double kNewBits = 1.5;  // to ask a quadric for the first time, without its coefficients
constexpr double kKnownBits = 4, kStrangeBits = 6.5;  // again, where it has a patch, and elsewhere
constexpr double kForcedBits = 100;
constexpr std::size_t kMostRegrown =
    64;  // nodes of a mended subtree that is tried afresh: a tenth fewer bytes
constexpr double kNoLimit = std::numeric_limits<double>::infinity();
constexpr int kMostDepth = 100, kMostPeeled = 90;

using Members = std::vector<std::int32_t>;
using Nodes = std::vector<TreeNode>;

TreeNode leaf_node(bool inside) {
    TreeNode node;
    node.kind = inside ? TreeNode::Kind::inside : TreeNode::Kind::outside;
    return node;
}

class Builder {
  public:
    Builder(const SampleTable& samples, std::span<const QuantisedQuadric> quadrics,
            const BuildOptions& options, const Task& task)
        : samples_(samples),
          quadrics_(quadrics),
          options_(options),
          task_(task),
          known_(quadrics.size(), 0),
          asked_(quadrics.size(), 0) {}

    RawTree build(const Box& box) {
        const double bits = grow(all(), box, 0, &nodes_, options_.tried, options_.most_bits);
        if (bits >= options_.most_bits) return {{}, kNoLimit, 0};
        return finish();
    }

    RawTree repair(const RawTree& old, const Box& box) {
        for (const TreeNode& node : old.nodes) {
            if (node.kind == TreeNode::Kind::ask) known_[static_cast<std::size_t>(node.quadric)] = 1;
        }
        copy(old.nodes, 0, all(), box, 0);
        return finish();
    }

  private:
    Members all() const {
        Members members(std::min(samples_.size(), options_.most_samples));
        for (std::size_t i = 0; i < members.size(); ++i) members[i] = static_cast<std::int32_t>(i);
        return members;
    }

    // Grows the tree of a cell, into `nodes` unless that is null. Returns its bits with the quadrics that it
    // is the first to ask; `most` or more, and no tree to speak of, as soon as they are sure to be so many.
    double grow(Members members, const Box& box, int depth, Nodes* nodes, int tried, double most);
    double grow_sides(const Question& question, Members members, const Box& box, int depth, Nodes* nodes,
                      int tried, double most);
    Question ask(std::int32_t quadric, bool here) const;
    std::int32_t peeled(const Members& members, int depth) const;
    bool separates(std::size_t q, const std::vector<char>& here) const;
    std::vector<Question> best_questions(const TreeCell& cell, const Box& box, std::size_t most) const;
    const Question& cheapest(const std::vector<Question>& questions, const TreeCell& cell, const Box& box,
                             int depth);
    bool copy(const Nodes& old, std::int32_t index, Members members, const Box& box, int depth);
    void regrow(std::size_t from, Members members, const Box& box, int depth);
    std::pair<Members, Members> split(const Question& question, const Members& members) const;
    RawTree finish();

    const SampleTable& samples_;
    std::span<const QuantisedQuadric> quadrics_;
    const BuildOptions& options_;
    const Task& task_;
    std::vector<char> known_;  // asked anywhere before, in the order of coding
    std::vector<char> asked_;  // asked on the way to this cell
    Nodes nodes_;
    int forced_ = 0;
};

// Keeps the best few of what it is offered, the best first.
class Shortlist {
  public:
    Shortlist(const TreeCell& cell, std::size_t most) : cell_(cell), most_(most) {}

    void offer(Question question) {
        if (cell_.judge(question)) keep(question);
    }

    // Neighbouring cuts, rising. Of those that tell the samples apart alike, the middle one has the best
    // chance with the points between them.
    void offer_run(const std::vector<Question>& cuts) {
        std::vector<Question> alike;
        const auto keep_middle = [&] {
            if (!alike.empty()) keep(alike[alike.size() / 2]);
            alike.clear();
        };
        for (Question cut : cuts) {
            if (!cell_.judge(cut)) continue;
            if (!alike.empty() && alike.back().score != cut.score) keep_middle();
            alike.push_back(cut);
        }
        keep_middle();
    }

    std::vector<Question> take() { return std::move(best_); }

  private:
    void keep(const Question& question) {
        if (best_.size() == most_ && question.score >= best_.back().score) return;
        best_.insert(std::ranges::upper_bound(best_, question.score, {}, &Question::score), question);
        if (best_.size() > most_) best_.pop_back();
    }

    const TreeCell& cell_;
    std::size_t most_;
    std::vector<Question> best_;
};

Question cut_question(int axis, int position, bool fine, const Box& box) {
    Question question;
    question.node.kind = TreeNode::Kind::cut;
    question.node.axis = static_cast<std::uint8_t>(axis);
    question.node.fine = fine;
    question.node.position = static_cast<std::uint16_t>(position);
    question.node.cut = cut_position(question.node, box);
    question.bits = fine ? kFineCutBits : kCutBits;
    return question;
}

// Coarse cuts through the samples, and fine ones where these are small in the cell.
void offer_cuts(const Box& bounds, const Box& box, Shortlist& list) {
    constexpr double kSmall = 1.0 / 6;
    constexpr int kFineTried = 16;
    std::vector<Question> cuts;
    for (int axis = 0; axis < 3; ++axis) {
        const double lo = bounds.lo[axis], hi = bounds.hi[axis], side = box.hi[axis] - box.lo[axis];
        cuts.clear();
        for (int position = 1; position < kCoarseCuts; ++position) {
            const Question question = cut_question(axis, position, false, box);
            if (question.node.cut > lo && question.node.cut <= hi) cuts.push_back(question);
        }
        list.offer_run(cuts);
        if (!(hi - lo < kSmall * side)) continue;
        cuts.clear();
        int last = 0;
        for (int k = 1; k < kFineTried; ++k) {
            const double share = (lo + (hi - lo) * k / kFineTried - box.lo[axis]) / side;
            const int position = static_cast<int>(share * kFineCuts + 0.5);
            if (position == last || position <= 0 || position >= kFineCuts) continue;
            last = position;
            cuts.push_back(cut_question(axis, position, true, box));
        }
        list.offer_run(cuts);
    }
}

// Is q a separator of quadrics with patches here?
bool Builder::separates(std::size_t q, const std::vector<char>& here) const {
    return std::ranges::any_of(quadrics_[q].between, [&](const auto& pair) {
        return here[static_cast<std::size_t>(pair.first)] != 0 &&
               here[static_cast<std::size_t>(pair.second)] != 0;
    });
}

std::vector<Question> Builder::best_questions(const TreeCell& cell, const Box& box, std::size_t most) const {
    std::vector<char> here(quadrics_.size(), 0);
    for (std::size_t k = 0; k < cell.patches(); ++k) here[static_cast<std::size_t>(cell.patch(k))] = 1;
    Shortlist list(cell, most);
    for (std::size_t q = 0; q < quadrics_.size(); ++q) {
        here[q] |= separates(q, here);
        if (asked_[q] != 0 || (here[q] == 0 && known_[q] == 0)) continue;
        list.offer(ask(static_cast<std::int32_t>(q), here[q] != 0));
    }
    offer_cuts(cell.bounds(), box, list);
    return list.take();
}

std::pair<Members, Members> Builder::split(const Question& question, const Members& members) const {
    std::pair<Members, Members> sides;
    for (const std::int32_t i : members)
        (question.high(samples_, static_cast<std::size_t>(i)) ? sides.first : sides.second).push_back(i);
    return sides;
}

double Builder::grow_sides(const Question& question, Members members, const Box& box, int depth, Nodes* nodes,
                           int tried, double most) {
    auto [high, low] = split(question, members);
    members = {};  // or each level of the tree would hold all samples
    const bool asks = question.node.kind == TreeNode::Kind::ask;
    const auto q = static_cast<std::size_t>(question.node.quadric);
    const bool fresh = asks && known_[q] == 0;
    if (asks) asked_[q] = known_[q] = 1;
    const std::size_t me = nodes ? nodes->size() - 1 : 0;
    const auto next = [&] { return nodes ? static_cast<std::int32_t>(nodes->size()) : 0; };
    const std::int32_t high_index = next();
    double bits = question.bits + (fresh ? quadrics_[q].bits : 0);
    if (bits < most)
        bits += grow(std::move(high), high_cell(question.node, box), depth + 1, nodes, tried, most - bits);
    const std::int32_t low_index = next();
    if (bits < most)
        bits += grow(std::move(low), low_cell(question.node, box), depth + 1, nodes, tried, most - bits);
    if (asks) asked_[q] = 0;
    if (nodes) {
        (*nodes)[me] = question.node;
        (*nodes)[me].high = high_index;
        (*nodes)[me].low = low_index;
    }
    return bits;
}

// Grows the tree of each question on the samples looked at, and takes the cheapest.
const Question& Builder::cheapest(const std::vector<Question>& questions, const TreeCell& cell,
                                  const Box& box, int depth) {
    const std::vector<char> known = known_;
    const Question* best = nullptr;
    double least = kNoLimit;
    for (const Question& question : questions) {
        const double bits = grow_sides(question, cell.seen(), box, depth, nullptr, 1, least);
        known_ = known;
        if (bits >= least) continue;
        best = &question;
        least = bits;
    }
    return *best;
}

std::int32_t Builder::peeled(const Members& members, int depth) const {
    return options_.peel && depth < kMostPeeled ? peeled_quadric(samples_, members, asked_) : -1;
}

Question Builder::ask(std::int32_t quadric, bool here) const {
    Question question;
    question.node.kind = TreeNode::Kind::ask;
    question.node.quadric = quadric;
    question.bits = known_[static_cast<std::size_t>(quadric)] == 0 ? kNewBits
                    : here                                         ? kKnownBits
                                                                   : kStrangeBits;
    return question;
}

double Builder::grow(Members members, const Box& box, int depth, Nodes* nodes, int tried, double most) {
    task_.check();
    if (nodes) nodes->emplace_back();
    const auto inside = static_cast<std::size_t>(std::ranges::count_if(
        members, [&](std::int32_t i) { return samples_[static_cast<std::size_t>(i)].inside; }));
    const auto leaf = [&](double bits) {
        if (nodes) nodes->back() = leaf_node(2 * inside > members.size());
        return bits;
    };
    if (inside == 0 || inside == members.size()) return leaf(kLeafBits);
    Question question;
    if (const std::int32_t q = peeled(members, depth); q >= 0) {
        question = ask(q, true);
    } else {
        const TreeCell cell(samples_, members, options_);
        const bool look_ahead = cell.patches() <= options_.most_tried;
        const std::vector<Question> best =
            best_questions(cell, box, look_ahead ? static_cast<std::size_t>(tried) : 1);
        if (best.empty() || depth >= kMostDepth) {
            if (nodes) ++forced_;
            return leaf(kForcedBits);
        }
        question = best.size() > 1 ? cheapest(best, cell, box, depth) : best[0];
    }
    return grow_sides(question, std::move(members), box, depth, nodes, tried, most);
}

// Copies a subtree, growing the leaves that a sample contradicts. True if there was one.
bool Builder::copy(const Nodes& old, std::int32_t index, Members members, const Box& box, int depth) {
    const TreeNode& node = old[static_cast<std::size_t>(index)];
    if (node.leaf()) {
        const bool inside = node.kind == TreeNode::Kind::inside;
        const bool right = std::ranges::all_of(
            members, [&](std::int32_t i) { return samples_[static_cast<std::size_t>(i)].inside == inside; });
        if (right) {
            nodes_.push_back(node);
        } else {
            grow(std::move(members), box, depth, &nodes_, options_.tried, kNoLimit);
        }
        return !right;
    }
    const std::size_t me = nodes_.size();
    nodes_.push_back(node);
    auto [high, low] = split({node}, members);
    const auto q = static_cast<std::size_t>(node.quadric);
    if (node.kind == TreeNode::Kind::ask) asked_[q] = 1;
    nodes_[me].high = static_cast<std::int32_t>(nodes_.size());
    bool changed = copy(old, node.high, std::move(high), high_cell(node, box), depth + 1);
    nodes_[me].low = static_cast<std::int32_t>(nodes_.size());
    changed |= copy(old, node.low, std::move(low), low_cell(node, box), depth + 1);
    if (node.kind == TreeNode::Kind::ask) asked_[q] = 0;
    if (changed && nodes_.size() - me <= kMostRegrown) regrow(me, std::move(members), box, depth);
    return changed;
}

// Grows the last subtree, from node `from` on, afresh, and keeps that if it is smaller.
void Builder::regrow(std::size_t from, Members members, const Box& box, int depth) {
    const auto begin = nodes_.begin() + static_cast<std::ptrdiff_t>(from);
    const Nodes mended(begin, nodes_.end());
    nodes_.erase(begin, nodes_.end());
    const std::vector<char> known = known_;
    const int forced = forced_;
    grow(std::move(members), box, depth, &nodes_, options_.tried, kNoLimit);
    if (forced_ == forced && nodes_.size() - from < mended.size()) return;
    nodes_.resize(from);
    nodes_.insert(nodes_.end(), mended.begin(), mended.end());
    known_ = known;
    forced_ = forced;
}

RawTree Builder::finish() {
    RawTree tree{std::move(nodes_), 0, forced_};
    std::vector<char> used(quadrics_.size(), 0);
    for (const TreeNode& node : tree.nodes) {
        if (node.leaf()) {
            tree.bits += kLeafBits;
        } else if (node.kind == TreeNode::Kind::cut) {
            tree.bits += node.fine ? kFineCutBits : kCutBits;
        } else {
            char& seen = used[static_cast<std::size_t>(node.quadric)];
            tree.bits +=
                seen != 0 ? kKnownBits : kNewBits + quadrics_[static_cast<std::size_t>(node.quadric)].bits;
            seen = 1;
        }
    }
    return tree;
}

}  // namespace

SampleTable::SampleTable(std::vector<TreeSample> samples, std::span<const QuantisedQuadric> quadrics,
                         const Task& task)
    : samples_(std::move(samples)), quadrics_(quadrics.size()), words_((quadrics.size() + 63) / 64) {
    look_at_sides(0, quadrics, task);
}

void SampleTable::add(std::span<const TreeSample> samples, std::span<const QuantisedQuadric> quadrics,
                      const Task& task) {
    const std::size_t first = samples_.size();
    samples_.insert(samples_.end(), samples.begin(), samples.end());
    look_at_sides(first, quadrics, task);
}

void SampleTable::look_at_sides(std::size_t first, std::span<const QuantisedQuadric> quadrics,
                                const Task& task) {
    signs_.resize(samples_.size() * words_, 0);
    parallel_chunks(samples_.size() - first, 1024, task, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = first + begin; i < first + end; ++i) {
            for (std::size_t q = 0; q < quadrics.size(); ++q) {
                const bool positive = quadrics[q].quadric.quadric.value(samples_[i].point) >= 0;
                signs_[i * words_ + q / 64] |= std::uint64_t{positive} << (q % 64);
            }
        }
    });
}

RawTree build_tree(const SampleTable& samples, std::span<const QuantisedQuadric> quadrics, const Box& box,
                   const BuildOptions& options, const Task& task) {
    return Builder(samples, quadrics, options, task).build(box);
}

RawTree repair_tree(const RawTree& old, const SampleTable& samples,
                    std::span<const QuantisedQuadric> quadrics, const Box& box, const BuildOptions& options,
                    const Task& task) {
    return Builder(samples, quadrics, options, task).repair(old, box);
}

std::size_t wrong_samples(const RawTree& tree, const SampleTable& samples) {
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const TreeNode* node = tree.nodes.data();
        while (!node->leaf())
            node = &tree.nodes[static_cast<std::size_t>(Question{*node}.high(samples, i) ? node->high
                                                                                         : node->low)];
        wrong += (node->kind == TreeNode::Kind::inside) != samples[i].inside;
    }
    return wrong;
}

}  // namespace pfgeom
