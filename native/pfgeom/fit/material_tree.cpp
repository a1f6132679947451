#include "pfgeom/fit/material_tree.h"

#include "pfgeom/fit/material_question.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace pfgeom {
namespace {

// Borders along a plane that has been asked are settled: nearer than the least length, and less than about 6°
// askew.
constexpr double kAlong = 0.995;

class Grower {
  public:
    Grower(std::span<const MaterialSample> samples, std::span<const BorderPiece> borders,
           const MaterialFit& options, const Task& task)
        : samples_(samples), borders_(borders), options_(options), task_(task) {}

    MaterialTree run() {
        MaterialCell all;
        all.box = options_.cell;
        for (std::uint32_t i = 0; i < samples_.size(); ++i) all.samples.push_back(i);
        for (std::uint32_t i = 0; i < borders_.size(); ++i) all.borders.push_back(i);
        grow(std::move(all), 0);
        return without_idle_questions(tree_);
    }

  private:
    // Recursion as deep as the tree, at most kMaxMaterialDepth.
    std::int32_t grow(MaterialCell cell, int depth) {
        task_.check();
        const auto row = static_cast<std::int32_t>(tree_.nodes.size());
        tree_.nodes.emplace_back();
        const auto [material, all] = best_material(cell);
        std::optional<MaterialNode> question;
        if (!all && depth < kMaxMaterialDepth) question = ask(cell);
        if (!question) {
            tree_.nodes[static_cast<std::size_t>(row)].material = material;
            return row;
        }
        MaterialNode node = *question;
        derive(node, cell.box);
        auto [high, low] = divided(cell, node);
        cell = {};
        node.high = grow(std::move(high), depth + 1);
        node.low = grow(std::move(low), depth + 1);
        tree_.nodes[static_cast<std::size_t>(row)] = node;
        return row;
    }

    // The material that most samples have of those that most allow, and whether all do.
    std::pair<std::int32_t, bool> best_material(const MaterialCell& cell) const {
        std::map<std::int32_t, std::pair<std::size_t, std::size_t>> counts;  // allowed, own
        for (const std::uint32_t i : cell.samples) {
            const MaterialSample& s = samples_[i];
            ++counts[s.material].first;
            ++counts[s.material].second;
            for (const std::int32_t m : s.others) {
                if (m >= 0) ++counts[m].first;
            }
        }
        std::int32_t best = 0;
        std::pair<std::size_t, std::size_t> most{0, 0};
        for (const auto& [material, count] : counts) {
            if (count > most) most = count, best = material;
        }
        return {best, most.first == cell.samples.size()};
    }

    // Where nothing takes the forced samples apart, the middle of their box helps; nothing if that is too
    // small to matter.
    std::optional<MaterialNode> ask(const MaterialCell& cell) const {
        if (auto question = find_material_question(cell, samples_, borders_, options_)) return question;
        Box box;
        for (const std::uint32_t i : cell.samples) box.grow(samples_[i].p);
        const Vec3 size = box.extent(), side = cell.box.extent();
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        if (!(size[axis] > options_.least)) return {};
        const double half = std::max({side.x, side.y, side.z}) / 2;
        MaterialNode cut;
        cut.axis = static_cast<std::uint8_t>(axis);
        for (cut.bits = 1; cut.bits <= kMostPlaneBits; ++cut.bits) {
            const double unit = std::ldexp(half, -cut.bits);
            cut.offset = static_cast<std::int32_t>(
                std::floor((box.centre()[axis] - cell.box.centre()[axis]) / unit + 0.5));
            const double at = cell.box.centre()[axis] + cut.offset * unit;
            const bool valid = std::abs(cut.offset) < 1 << cut.bits;
            if (valid && at > box.lo[axis] && at <= box.hi[axis]) return cut;
        }
        return {};
    }

    std::pair<MaterialCell, MaterialCell> divided(const MaterialCell& cell, const MaterialNode& node) const {
        MaterialCell high, low;
        high.box = high_cell(node, cell.box);
        low.box = low_cell(node, cell.box);
        const double length = norm(node.normal);
        const auto at = [&node](const Vec3& p) { return dot(node.normal, p) - node.level; };
        for (const std::uint32_t i : cell.samples) (at(samples_[i].p) >= 0 ? high : low).samples.push_back(i);
        for (const std::uint32_t i : cell.borders) {
            const BorderPiece& border = borders_[i];
            const double distance = at(border.p) / length;
            const bool settled = std::abs(distance) < options_.least &&
                                 std::abs(dot(node.normal, border.across)) > kAlong * length;
            if (!settled) (distance >= 0 ? high : low).borders.push_back(i);
        }
        return {std::move(high), std::move(low)};
    }

    std::span<const MaterialSample> samples_;
    std::span<const BorderPiece> borders_;
    const MaterialFit& options_;
    const Task& task_;
    MaterialTree tree_;
};

// Copies what is below the row, depth first, and joins leaves. Recursion as deep as the tree.
std::int32_t copy_joined(const MaterialTree& from, std::int32_t row, MaterialTree& to) {
    MaterialNode node = from.nodes[static_cast<std::size_t>(row)];
    const std::size_t at = to.nodes.size();
    to.nodes.emplace_back();
    if (!node.leaf()) {
        node.high = copy_joined(from, node.high, to);
        node.low = copy_joined(from, node.low, to);
        const MaterialNode &high = to.nodes[static_cast<std::size_t>(node.high)],
                           &low = to.nodes[static_cast<std::size_t>(node.low)];
        if (high.leaf() && low.leaf() && high.material == low.material) {
            node = {};
            node.material = high.material;
            to.nodes.resize(at + 1);
        }
    }
    to.nodes[at] = node;
    return static_cast<std::int32_t>(at);
}

}  // namespace

MaterialTree without_idle_questions(const MaterialTree& tree) {
    MaterialTree joined;
    copy_joined(tree, 0, joined);
    return joined;
}

MaterialTree fit_material_tree(std::span<const MaterialSample> samples, std::span<const BorderPiece> borders,
                               const MaterialFit& options, const Task& task) {
    return Grower(samples, borders, options, task).run();
}

}  // namespace pfgeom
