// How an octree for rays is made: level by level, each cell from what its parent knows.
#pragma once

#include "pfgeom/base/parallel.h"
#include "pfgeom/render/ray_octree.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace pfgeom {

/// What is left of an object in a cell while the octree is made.
enum class CellFate : std::uint8_t { outside, inside, leaf, split };

inline Box widened(const Box& box, double by) {
    return {box.lo - Vec3{by, by, by}, box.hi + Vec3{by, by, by}};
}

/// What the contents of a level may weigh together, in about 16 bytes: 512 MiB. Real models need a hundredth;
/// an expression that no cell prunes stays as coarse as this allows.
constexpr double kMostWeight = 1 << 25;

/// Level by level. fate = look(parent's content, cell, depth, content): what is left there and what becomes
/// of it; keep(content): the next leaf's number, from one thread and in a fixed order.
/// weigh(content): what it counts against kMostWeight.
template <class Content, class Look, class Keep, class Weigh>
RayOctree make_octree(const Box& box, const Content& whole, const Task& task, Look look, Keep keep,
                      Weigh weigh) {
    constexpr std::size_t kChunk = 16;  // cells, of some 10 µs each
    struct Cell {
        Box box;
        Content content;
        CellFate fate = CellFate::outside;
        std::int32_t node = -1;  // where its number is to be written
        unsigned place = 0;
    };
    RayOctree tree;
    tree.box = box;
    std::vector<Cell> cells(1), split;
    cells[0].box = box;
    cells[0].fate = look(whole, box, 0, cells[0].content);
    for (int depth = 1; !cells.empty(); ++depth) {
        split.clear();
        double weight = 0;
        for (const Cell& cell : cells) weight += cell.fate == CellFate::split ? weigh(cell.content) : 0;
        const bool too_much = 8 * weight > kMostWeight;
        for (Cell& cell : cells) {
            if (too_much && cell.fate == CellFate::split) cell.fate = CellFate::leaf;
            std::int32_t number = cell.fate == CellFate::inside ? RayOctree::kInside : RayOctree::kOutside;
            if (cell.fate == CellFate::leaf) number = RayOctree::kFirstLeaf - keep(std::move(cell.content));
            if (cell.fate == CellFate::split) {
                number = static_cast<std::int32_t>(tree.nodes.size());
                tree.nodes.emplace_back();
            }
            (cell.node < 0 ? tree.root : tree.nodes[static_cast<std::size_t>(cell.node)][cell.place]) =
                number;
            if (cell.fate != CellFate::split) continue;
            cell.node = number;
            split.push_back(std::move(cell));
        }
        cells.assign(8 * split.size(), {});
        parallel_chunks(cells.size(), kChunk, task, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const Cell& parent = split[i / 8];
                Cell& cell = cells[i];
                cell.place = static_cast<unsigned>(i % 8);
                cell.node = parent.node;
                cell.box = child_box(parent.box, cell.place);
                cell.fate = look(parent.content, cell.box, depth, cell.content);
            }
        });
    }
    return tree;
}

}  // namespace pfgeom
