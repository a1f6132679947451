#include "pfgeom/compress/shorten_borders.h"

#include "pfgeom/base/parallel.h"
#include "pfgeom/fit/material_tree.h"
#include "pfgeom/mesh/edges.h"
#include "pfgeom/mesh/islands.h"
#include "pfgeom/polygonize/paint_faces.h"

#include <algorithm>
#include <map>
#include <vector>

namespace pfgeom {
namespace {

constexpr int kMostSweeps = 16, kMostRounds = 4;
constexpr std::size_t kChunk = 256;
// Of the tolerance, for the cutting of faces along planes.
constexpr double kSnapShare = 1.0 / 16;

// One round: the surface is looked at leaf by leaf.
class Shortener {
  public:
    Shortener(TriangleMesh mesh, const Frame& frame, const BorderGoal& goal, MaterialTree& tree,
              const Task& task)
        : mesh_(std::move(mesh)),
          frame_(frame),
          goal_(goal),
          tree_(tree),
          task_(task),
          leaves_(tree.nodes.size()) {
        MaterialTree numbered = tree;
        for (std::size_t row = 0; row < numbered.nodes.size(); ++row)
            numbered.nodes[row].material = static_cast<std::int32_t>(row);
        const std::vector<const MaterialTree*> trees(mesh_.faces.size(), &numbered);
        leaf_of_ = paint_faces(mesh_, frame, trees, kSnapShare * goal.tolerance, task);
        look_at_faces();
        measure_borders();
    }

    void choose_materials() {
        bool changed = true;
        for (int sweep = 0; changed && sweep < kMostSweeps; ++sweep) {
            changed = false;
            for (std::size_t row = 0; row < leaves_.size(); ++row) changed |= improve(row);
        }
    }

    // Leaves that hold a bit, and other things which must stay, are divided. Were there any?
    bool cut_out_bits() {
        std::map<std::int32_t, MaterialTree> parts;
        const std::vector<char> wrong = faces_of_bits();
        std::map<std::int32_t, std::vector<MaterialSample>> samples;
        for (std::size_t f = 0; f < wrong.size(); ++f) {
            if (wrong[f] != 0) samples[leaf_of_[f]];
        }
        for (std::size_t f = 0; f < wrong.size(); ++f) {
            const auto at = samples.find(leaf_of_[f]);
            if (at != samples.end()) at->second.push_back(sample_of(f, wrong[f] != 0));
        }
        std::map<std::int32_t, std::vector<BorderPiece>> borders = borders_of_bits(wrong);
        for (const auto& [row, list] : samples) {
            const Place place = place_of(row);
            const MaterialFit options{goal_.tolerance / frame_.half() / 8, 8, place.cell};
            MaterialTree part = fit_material_tree(list, borders[row], options, task_);
            if (place.depth + depth_of(part, 0) <= kMaxMaterialDepth) parts[row] = std::move(part);
        }
        splice(parts);
        return !parts.empty();
    }

  private:
    // What the faces of a leaf allow, and what it borders on.
    struct LeafSurface {
        std::vector<std::int32_t> allowed;  // materials
        bool seen = false;
        std::map<std::int32_t, double> shared;  // leaf -> length of the border with it
    };

    Vec3 middle(std::size_t f) const {
        const Triangle& t = mesh_.faces[f];
        return (mesh_.vertices[t[0]] + mesh_.vertices[t[1]] + mesh_.vertices[t[2]]) / 3;
    }
    std::int32_t& material(std::int32_t row) { return tree_.nodes[static_cast<std::size_t>(row)].material; }
    std::int32_t material_of(std::size_t face) { return material(leaf_of_[face]); }

    void look_at_faces() {
        const std::size_t n = mesh_.faces.size();
        truth_.resize(n);
        parallel_chunks(n, kChunk, task_, [&](std::size_t begin, std::size_t end) {
            for (std::size_t f = begin; f < end; ++f)
                truth_[f] = goal_.surface.ask(middle(f), goal_.tolerance);
        });
        for (std::size_t f = 0; f < n; ++f) {
            LeafSurface& leaf = leaves_[static_cast<std::size_t>(leaf_of_[f])];
            if (!leaf.seen) {
                leaf.allowed.assign(truth_[f].others.begin(), truth_[f].others.end());
                leaf.allowed.push_back(truth_[f].material);
                leaf.seen = true;
            }
            std::erase_if(leaf.allowed, [&](std::int32_t m) { return m < 0 || !truth_[f].allows(m); });
        }
    }

    void measure_borders() {
        EdgeTable(mesh_.faces, mesh_.vertices.size()).for_each([&](std::span<const EdgeUse> uses) {
            const double length = norm(mesh_.vertices[uses[0].hi] - mesh_.vertices[uses[0].lo]);
            for (const EdgeUse& use : uses.subspan(1)) {
                const std::int32_t a = leaf_of_[static_cast<std::size_t>(uses[0].face())];
                const std::int32_t b = leaf_of_[static_cast<std::size_t>(use.face())];
                if (a == b) continue;
                leaves_[static_cast<std::size_t>(a)].shared[b] += length;
                leaves_[static_cast<std::size_t>(b)].shared[a] += length;
            }
        });
    }

    bool improve(std::size_t row) {
        const LeafSurface& leaf = leaves_[row];
        std::map<std::int32_t, double> along;  // material -> length of borders with it
        for (const auto& [other, length] : leaf.shared) along[material(other)] += length;
        std::int32_t& own = tree_.nodes[row].material;
        std::int32_t best = own;
        for (const std::int32_t m : leaf.allowed) {
            if (along[m] > along[best]) best = m;
        }
        if (best == own) return false;
        own = best;
        return true;
    }

    // Pieces of one material whose faces all allow the other one.
    std::vector<char> faces_of_bits() {
        const std::size_t n = mesh_.faces.size();
        std::vector<std::int32_t> materials(n);
        for (std::size_t f = 0; f < n; ++f) materials[f] = material_of(f);
        const std::vector<std::int32_t> first = first_of_piece(mesh_, materials);
        std::vector<char> bit(n, 1);
        const auto of_piece = [&](std::size_t f) -> char& { return bit[static_cast<std::size_t>(first[f])]; };
        for (std::size_t f = 0; f < n; ++f) {
            if (!truth_[f].allows(1 - materials[f])) of_piece(f) = 0;
        }
        for (std::size_t f = 0; f < n; ++f) bit[f] = of_piece(f);
        return bit;
    }

    // What it is shall stay; a bit shall become the other material.
    MaterialSample sample_of(std::size_t f, bool wrong) {
        const std::int32_t own = material_of(f);
        MaterialSample sample{frame_.to_local(middle(f)), wrong ? 1 - own : own};
        if (!wrong && truth_[f].allows(1 - own)) sample.others[0] = 1 - own;
        return sample;
    }

    // Around the bits, for each leaf that has a part of one.
    std::map<std::int32_t, std::vector<BorderPiece>> borders_of_bits(const std::vector<char>& wrong) const {
        std::map<std::int32_t, std::vector<BorderPiece>> borders;
        EdgeTable(mesh_.faces, mesh_.vertices.size()).for_each([&](std::span<const EdgeUse> uses) {
            for (const EdgeUse& use : uses) {
                const auto f = static_cast<std::size_t>(use.face());
                if (wrong[f] == 0) continue;
                const Triangle& t = mesh_.faces[f];
                const Vec3 from = mesh_.vertices[use.lo], to = mesh_.vertices[use.hi];
                const Vec3 normal = cross(mesh_.vertices[t[1]] - mesh_.vertices[t[0]],
                                          mesh_.vertices[t[2]] - mesh_.vertices[t[0]]);
                const Vec3 across = cross(to - from, normal);
                if (squared_norm(across) > 0)
                    borders[leaf_of_[f]].push_back({frame_.to_local((from + to) / 2), normalized(across)});
            }
        });
        return borders;
    }

    // Where a leaf is: what the cuts above it leave, and the questions.
    struct Place {
        Box cell = root_cell();
        int depth = 0;
    };
    Place place_of(std::int32_t row) const {
        Place place;
        for (std::int32_t at = 0; at != row; ++place.depth) {
            const MaterialNode& node = tree_.nodes[static_cast<std::size_t>(at)];
            const bool high = row < node.low;  // depth first
            place.cell = high ? high_cell(node, place.cell) : low_cell(node, place.cell);
            at = high ? node.high : node.low;
        }
        return place;
    }

    static int depth_of(const MaterialTree& tree, std::int32_t row) {
        const MaterialNode& node = tree.nodes[static_cast<std::size_t>(row)];
        return node.leaf() ? 0 : 1 + std::max(depth_of(tree, node.high), depth_of(tree, node.low));
    }

    void splice(const std::map<std::int32_t, MaterialTree>& parts) {
        for (const auto& [row, part] : parts) {
            const auto offset = static_cast<std::int32_t>(tree_.nodes.size());
            for (MaterialNode node : part.nodes) {
                if (!node.leaf()) node.high += offset, node.low += offset;
                tree_.nodes.push_back(node);
            }
            tree_.nodes[static_cast<std::size_t>(row)] = tree_.nodes[static_cast<std::size_t>(offset)];
        }
    }

    TriangleMesh mesh_;
    const Frame& frame_;
    const BorderGoal& goal_;
    MaterialTree& tree_;
    const Task& task_;
    std::vector<LeafSurface> leaves_;  // by row of the tree
    std::vector<std::int32_t> leaf_of_;
    std::vector<MaterialSample> truth_;  // about each face
};

}  // namespace

void shorten_borders(const TriangleMesh& mesh, const Frame& frame, const BorderGoal& goal, MaterialTree& tree,
                     const Task& task) {
    for (int round = 0; round < kMostRounds; ++round) {
        Shortener shortener(mesh, frame, goal, tree, task);
        shortener.choose_materials();
        const bool more = shortener.cut_out_bits();
        tree = without_idle_questions(tree);
        if (!more) return;
    }
}

}  // namespace pfgeom
