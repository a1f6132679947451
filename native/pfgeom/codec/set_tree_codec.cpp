#include "pfgeom/codec/set_tree_codec.h"

#include "pfgeom/codec/recent_quadrics.h"
#include "pfgeom/codec/tree_quadric_codec.h"
#include "pfgeom/eval/cell_quadric.h"
#include "pfgeom/function/quadric_family.h"

#include <algorithm>
#include <cstdlib>
#include <initializer_list>
#include <vector>

namespace pfgeom {
namespace {

using NodeKind = TreeNode::Kind;

// Kinds of the model.
enum Kind : std::uint32_t {
    kIsLeaf = TreeQuadricCoder::kKinds,
    kIsInside,
    kIsCut,
    kAxis,
    kIsFine,
    kIsNew,
    kIsThisOne,
    kIsListed,
};

// A reference is looked for among so many quadrics, the most recent ones; what is further back is written as
// an index. This bounds the work that a byte can ask for. (More than a path can ask: while there are others
// that a question can ask, the list is not empty.)
constexpr std::size_t kMostListed = 256;
static_assert(kMostListed > kMaxTreeDepth);
// Nodes and quadrics beyond these come with raw zero bits, so that a tree stays in proportion to its bytes.
constexpr std::size_t kFreeNodes = 1024, kNodesPerByte = 8, kFreeQuadrics = 64, kQuadricsPerByte = 1;
constexpr int kDue = 8;

// Where a node stands: what it is a child of, and what its elder sibling turned out to be.
struct Place {
    enum Parent : std::uint32_t { root, high_of_cut, low_of_cut, high_of_ask, low_of_ask };
    enum Sibling : std::uint32_t { none, outside, inside, question };
    Parent parent = root;
    Sibling sibling = none;
    int depth = 0;
    Box cell;

    std::uint32_t context() const { return 4 * parent + sibling; }
};

class TreeCoder {
  public:
    TreeCoder(CodecStream& stream, BackoffModel& model, SetTree& tree)
        : stream_(stream),
          model_(model),
          tree_(tree),
          quadrics_(stream, model),
          asked_(tree.quadrics.size(), false),
          start_(stream.coder.bytes_so_far()) {}

    void run() {
        code_box();
        if (!stream_.ok()) return;
        Place root;
        root.cell = tree_.box();
        code_node(root);
    }

  private:
    int bit(int value, std::uint32_t kind, Probability prior, std::initializer_list<std::uint32_t> contexts) {
        return model_.code(stream_.coder, value, kind, prior, contexts);
    }
    std::size_t bytes() const { return stream_.coder.bytes_so_far() - start_; }
    TreeNode& node(std::int32_t index) { return tree_.nodes[static_cast<std::size_t>(index)]; }

    void code_box();
    void code_node(const Place& place);
    bool add_node();
    void code_kind(TreeNode& node, const Place& place);
    void code_cut(TreeNode& node, const Place& place);
    void code_question(TreeNode& node, const Place& place);
    void code_new_quadric(std::size_t index);
    std::int32_t code_reference(std::int32_t wanted);
    std::int32_t code_unlisted(std::int32_t wanted);
    void list_candidates(const Box& cell);
    void set_asked(const TreeNode& question, bool asked) {
        if (question.kind == NodeKind::ask) asked_[static_cast<std::size_t>(question.quadric)] = asked;
    }
    static Place child_of(const TreeNode& node, const Place& place, bool high);

    CodecStream& stream_;
    BackoffModel& model_;
    SetTree& tree_;
    TreeQuadricCoder quadrics_;
    RecentQuadrics recent_;
    std::vector<bool> asked_;  // on the path to the present node
    std::vector<std::int32_t> listed_, certain_;
    std::size_t looked_at_ = 0;  // for listed_
    std::int32_t next_ = 0;      // node
    std::size_t start_;
};

// The frame puts the centre of the box within 1/64 of the cube's half edge, so the sum of two sides is short.
void TreeCoder::code_box() {
    const int resolution = static_cast<int>(stream_.coder.code_raw(tree_.resolution, 5));
    if (resolution > kMostResolution) return stream_.fail(FormatStatus::bad_value);
    tree_.resolution = static_cast<std::uint8_t>(resolution);
    tree_.complement = stream_.coder.code_raw(tree_.complement ? 1 : 0, 1) != 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::int32_t& low = tree_.low[axis];
        std::int32_t& high = tree_.high[axis];
        const std::int32_t extent = static_cast<std::int32_t>(
            stream_.coder.code_raw(static_cast<std::uint32_t>(high - low), resolution + 3));
        const std::int32_t sum = stream_.mixer.code_int(stream_.coder, low + high, kBoxCentreKind,
                                                        static_cast<std::uint32_t>(axis));
        const std::int32_t most = (2 << resolution) + 1;
        if (extent < 1 || std::abs(std::int64_t{sum}) + extent > 2 * std::int64_t{most} ||
            (sum + extent) % 2 != 0) {
            return stream_.fail(FormatStatus::bad_value);
        }
        low = (sum - extent) / 2;
        high = (sum + extent) / 2;
    }
}

// Recursion as deep as the tree, at most kMaxTreeDepth.
void TreeCoder::code_node(const Place& place) {
    if (!add_node()) return;
    const std::int32_t index = next_++;
    TreeNode& here = node(index);
    code_kind(here, place);
    if (!stream_.ok() || here.leaf()) return;
    if (here.kind == NodeKind::cut) {
        code_cut(here, place);
    } else {
        code_question(here, place);
    }
    if (!stream_.ok()) return;

    const TreeNode question = here;  // reading makes the list of nodes grow
    set_asked(question, true);
    node(index).high = next_;
    code_node(child_of(question, place, true));
    if (!stream_.ok()) return;
    Place low = child_of(question, place, false);
    const NodeKind sibling = node(index + 1).kind;
    low.sibling = sibling == NodeKind::outside  ? Place::outside
                  : sibling == NodeKind::inside ? Place::inside
                                                : Place::question;
    node(index).low = next_;
    code_node(low);
    set_asked(question, false);
}

bool TreeCoder::add_node() {
    if (static_cast<std::size_t>(next_) >= kFreeNodes + kNodesPerByte * bytes()) {
        stream_.expect(stream_.coder.code_raw(0, kDue) == 0);
    }
    if (!stream_.decoding()) return stream_.ok();
    if (!stream_.ok() || !stream_.charge(2, sizeof(TreeNode))) return false;
    tree_.nodes.emplace_back();
    return true;
}

Place TreeCoder::child_of(const TreeNode& node, const Place& place, bool high) {
    Place child;
    const bool cut = node.kind == NodeKind::cut;
    child.parent = high ? (cut ? Place::high_of_cut : Place::high_of_ask)
                        : (cut ? Place::low_of_cut : Place::low_of_ask);
    child.depth = place.depth + 1;
    child.cell = high ? high_cell(node, place.cell) : low_cell(node, place.cell);
    return child;
}

void TreeCoder::code_kind(TreeNode& node, const Place& place) {
    const bool leaf =
        place.depth >= kMaxTreeDepth || bit(node.leaf(), kIsLeaf, 36000, {place.context()}) != 0;
    if (leaf) {
        // Two leaves of one kind under one question are possible, but an encoder makes one leaf of them.
        const Probability prior = place.sibling == Place::outside  ? 65000
                                  : place.sibling == Place::inside ? 500
                                                                   : 32768;
        const bool inside = bit(node.kind == NodeKind::inside, kIsInside, prior, {place.context()}) != 0;
        node.kind = inside ? NodeKind::inside : NodeKind::outside;
    } else {
        const bool cut = bit(node.kind == NodeKind::cut, kIsCut, 16000, {place.parent}) != 0;
        node.kind = cut ? NodeKind::cut : NodeKind::ask;
    }
}

void TreeCoder::code_cut(TreeNode& node, const Place& place) {
    const bool not_x = bit(node.axis != 0, kAxis, 43690, {0}) != 0;
    node.axis =
        not_x ? static_cast<std::uint8_t>(1 + bit(node.axis == 2, kAxis, 32768, {1})) : std::uint8_t{0};
    node.fine = bit(node.fine ? 1 : 0, kIsFine, 6000, {0}) != 0;
    const int bits = node.fine ? 10 : 5;
    static_assert(kFineCuts == 1 << 10 && kCoarseCuts == 1 << 5);
    node.position = static_cast<std::uint16_t>(stream_.coder.code_raw(node.position, bits));
    stream_.expect(node.position != 0);
    node.cut = cut_position(node, place.cell);
}

void TreeCoder::code_question(TreeNode& node, const Place& place) {
    list_candidates(place.cell);
    const auto known = static_cast<std::int32_t>(recent_.size());
    const auto some = static_cast<std::uint32_t>(std::min<std::size_t>(listed_.size(), 2));
    const bool fresh =
        listed_.empty() || bit(node.quadric == known, kIsNew, 32768, {some, place.parent}) != 0;
    if (fresh) {
        code_new_quadric(static_cast<std::size_t>(known));
        node.quadric = known;
        return;
    }
    node.quadric = code_reference(node.quadric);
    if (stream_.ok()) recent_.move_to_front(node.quadric);
}

void TreeCoder::code_new_quadric(std::size_t index) {
    if (index >= kFreeQuadrics + kQuadricsPerByte * bytes()) {
        stream_.expect(stream_.coder.code_raw(0, kDue) == 0);
    }
    if (stream_.decoding()) {
        if (!stream_.ok() || !stream_.charge(2, sizeof(TreeQuadric))) return;
        tree_.quadrics.emplace_back();
        asked_.push_back(false);
    }
    quadrics_.code(tree_.quadrics, index, tree_.resolution);
    recent_.add();
}

// What may be asked here, most recent first: those that may have both signs in the cell, then the others.
void TreeCoder::list_candidates(const Box& cell) {
    listed_.clear();
    certain_.clear();
    looked_at_ = 0;
    for (std::int32_t q = recent_.first(); q != RecentQuadrics::kEnd && looked_at_ < kMostListed;
         q = recent_.after(q), ++looked_at_) {
        const auto row = static_cast<std::size_t>(q);
        if (asked_[row]) continue;
        const Interval range = cell_range(in_frame_of(tree_.quadrics[row].quadric, cell));
        (range.lo <= 0 && range.hi >= 0 ? listed_ : certain_).push_back(q);
    }
    listed_.insert(listed_.end(), certain_.begin(), certain_.end());
}

std::int32_t TreeCoder::code_reference(std::int32_t wanted) {
    const bool all_listed = looked_at_ == recent_.size();
    const auto at =
        static_cast<std::size_t>(std::find(listed_.begin(), listed_.end(), wanted) - listed_.begin());
    if (!all_listed && bit(at < listed_.size(), kIsListed, 60000, {0}) == 0) return code_unlisted(wanted);
    return listed_[model_.choose(stream_.coder, at, listed_.size(), kIsThisOne)];
}

std::int32_t TreeCoder::code_unlisted(std::int32_t wanted) {
    const auto quadric =
        static_cast<std::int32_t>(stream_.coder.code_raw(static_cast<std::uint32_t>(wanted), 31));
    const bool exists = static_cast<std::size_t>(quadric) < recent_.size();
    stream_.expect(exists && !asked_[static_cast<std::size_t>(quadric)] &&
                   std::find(listed_.begin(), listed_.end(), quadric) == listed_.end());
    return quadric;
}

}  // namespace

void code_set_tree(CodecStream& stream, BackoffModel& model, SetTree& tree) {
    TreeCoder(stream, model, tree).run();
}

}  // namespace pfgeom
