#include "pfgeom/eval/derive.h"

#include "pfgeom/base/parallel.h"

#include <algorithm>
#include <bit>

namespace pfgeom {
namespace {

constexpr double kSupport = 1.7;    // radius of a ball, in spacings (1.8: +1.2 % bytes)
constexpr double kThinning = 0.65;  // least distance of centres (0.85: +6.5 %, 0.55: worse)
constexpr double kStay = 0.6;       // a centre that Newton moves further, in spacings, is dropped
constexpr double kBand = 1.1;       // half width of the lattice's band, in spacings (1.4: +1.4 %)
constexpr double kCrossing = 1.1;   // slack of the test whether the surface crosses a cell
constexpr double kThinReach = 2.0;  // how far from the surface, in cells, thin flags reach
constexpr double kLeastGradient = 0.1, kMostGradient = 3;
constexpr int kRootDepth = 3;       // all cells of this depth are looked at
constexpr double kRough = 2.5;      // slack of the crossing test for cells larger than kRoughSize, where the
constexpr double kRoughSize = 0.1;  // field is far from linear
constexpr std::size_t kChunk = 512;
constexpr std::size_t kBatch = 512;  // parents whose children are probed at a time

double spacing(int depth) {
    return std::ldexp(2.0, -depth);
}

// Position in Morton order: 15 bits an axis over [-1.5, 2.5), x first.
std::uint64_t morton(const Vec3& p) {
    std::uint64_t key = 0;
    std::array<std::uint32_t, 3> v{};
    for (int d = 0; d < 3; ++d) {
        v[static_cast<std::size_t>(d)] =
            static_cast<std::uint32_t>(std::clamp((p[d] + 1.5) * 8192, 0.0, 32767.0));
    }
    for (int b = 14; b >= 0; --b) {
        for (const std::uint32_t x : v) key = (key << 1) | ((x >> b) & 1U);
    }
    return key;
}

// The cells of all of [-1,1]³ at `depth`, in Morton order.
std::vector<CellIndex> all_cells(int depth) {
    std::vector<CellIndex> cells{{0, 0, 0}};
    for (int d = 0; d < depth; ++d) {
        std::vector<CellIndex> finer;
        finer.reserve(cells.size() * 8);
        for (const CellIndex& c : cells) {
            for (int t = 0; t < 8; ++t)
                finer.push_back({2 * c.x + (t >> 2), 2 * c.y + (t >> 1 & 1), 2 * c.z + (t & 1)});
        }
        cells.swap(finer);
    }
    return cells;
}

std::vector<CellIndex> children_of(std::span<const ProbedCell> parents) {
    std::vector<CellIndex> children;
    children.reserve(parents.size() * 8);
    for (const ProbedCell& parent : parents) {
        const CellIndex& c = parent.index;
        for (int t = 0; t < 8; ++t) {
            children.push_back({2 * c.x + (t >> 2), 2 * c.y + (t >> 1 & 1), 2 * c.z + (t & 1)});
        }
    }
    return children;
}

// Calls visit(children) for a few parents at a time, so that memory is that of the cells that are kept.
template <class Visit>
void for_batches_of_children(std::span<const ProbedCell> parents, DeriveBudget& budget, Visit visit) {
    for (std::size_t i = 0; i < parents.size() && !budget.exceeded(); i += kBatch) {
        visit(children_of(parents.subspan(i, std::min(kBatch, parents.size() - i))));
    }
}

// Appends those of `candidates` for which keep(jet, size) holds at their centre.
template <class Keep>
void probe(const FunctionField& field, const std::vector<CellIndex>& candidates, double size,
           DeriveBudget& budget, const Task& task, Keep keep, std::vector<ProbedCell>& kept) {
    budget.probes -= static_cast<std::int64_t>(candidates.size());
    if (budget.exceeded()) return;
    std::vector<Jet> jets(candidates.size());
    parallel_chunks(candidates.size(), kChunk, task, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) jets[i] = field.jet(cell_centre(candidates[i], size));
    });
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        if (keep(jets[i], size)) kept.push_back({candidates[i], jets[i]});
    }
    if (static_cast<std::int64_t>(kept.size()) > budget.cells) budget.probes = -1;
}

// Cells for which keep(jet, size) holds at their centre, and at the centres of all their ancestors from
// kRootDepth on.
template <class Keep>
std::vector<ProbedCell> descend(const FunctionField& field, int depth, DeriveBudget& budget, const Task& task,
                                Keep keep) {
    const int root = std::min(depth, kRootDepth);
    std::vector<ProbedCell> cells;
    probe(field, all_cells(root), spacing(root), budget, task, keep, cells);
    for (int d = root + 1; d <= depth; ++d) {
        std::vector<ProbedCell> finer;
        for_batches_of_children(cells, budget, [&](const std::vector<CellIndex>& children) {
            probe(field, children, spacing(d), budget, task, keep, finer);
        });
        cells.swap(finer);
    }
    return cells;
}

struct Centre {
    Vec3 point;
    double scale = 1;
    bool lattice = false;
    std::uint64_t order = 0;
};

void place_lattice(const FunctionField& field, const HierarchyHead& head, Level& level, const Task& task) {
    const double h = spacing(level.depth);
    const int n = 1 << level.depth;
    const Vec3 reach{(head.axes[0] + 1) / 256.0 + 0.6 * h, (head.axes[1] + 1) / 256.0 + 0.6 * h,
                     (head.axes[2] + 1) / 256.0 + 0.6 * h};
    for (int i = 0; i <= n; ++i) {
        task.check();
        for (int j = 0; j <= n; ++j) {
            for (int k = 0; k <= n; ++k) {
                const Vec3 p{-1 + i * h, -1 + j * h, -1 + k * h};
                if (std::abs(p.x) > reach.x || std::abs(p.y) > reach.y || std::abs(p.z) > reach.z) continue;
                if (level.depth > kFirstLevel) {
                    const Jet jet = field.jet(p);
                    if (std::abs(jet.value) > kBand * h * std::max(1.0, norm(jet.gradient))) continue;
                }
                level.centres.push_back(p);
            }
        }
    }
    level.scale.assign(level.centres.size(), 1.0);
    level.lattice.assign(level.centres.size(), 1);
}

// Up to three Newton steps onto the surface, the first with the jet that is known. False if it leaves its
// cell.
bool move_onto_surface(const FunctionField& field, const ProbedCell& cell, double h, Centre& out) {
    const Vec3 start = cell_centre(cell.index, h);
    Vec3 p = start;
    double length = 1;
    for (int step = 0; step < 3; ++step) {
        const Jet jet = step == 0 ? cell.jet : field.jet(p);
        length = norm(jet.gradient);
        Vec3 move = (-jet.value / std::max(length * length, 0.05)) * jet.gradient;
        const double far = norm(move);
        if (far > h) move *= h / far;
        p += move;
    }
    const Vec3 moved = p - start;
    if (std::max({std::abs(moved.x), std::abs(moved.y), std::abs(moved.z)}) > kStay * h) return false;
    out = {p, std::clamp(length, kLeastGradient, kMostGradient), false, morton(start)};
    return true;
}

// Accepts centres in their order unless one that was accepted lies within `distance`.
class Thinning {
  public:
    explicit Thinning(double distance) : distance_(distance) {}

    void offer(const Centre& c) {
        if (crowded(c.point)) return;
        std::int32_t& head = first_[CellIndex::of(c.point, 1 / distance_).key()];
        next_.push_back(head);
        head = static_cast<std::int32_t>(kept_.size());
        kept_.push_back(c);
    }
    std::vector<Centre>& kept() { return kept_; }

  private:
    bool crowded(const Vec3& p) const {
        const CellIndex at = CellIndex::of(p, 1 / distance_);
        for (int t = 0; t < 27; ++t) {
            const CellIndex cell{at.x + t / 9 - 1, at.y + t / 3 % 3 - 1, at.z + t % 3 - 1};
            for (std::int32_t i = first_.find(cell.key()); i >= 0; i = next_[static_cast<std::size_t>(i)]) {
                if (squared_norm(kept_[static_cast<std::size_t>(i)].point - p) < distance_ * distance_)
                    return true;
            }
        }
        return false;
    }

    double distance_;
    std::vector<Centre> kept_;
    std::vector<std::int32_t> next_;  // of the same grid cell
    CellTable first_;
};

// The cells of the finest depth, some eighths of all, are never held together.
std::vector<Centre> sheet_centres(const FunctionField& field, int depth, DeriveBudget& budget,
                                  const Task& task) {
    const auto crossed = [depth](const Jet& jet, double size) {
        const double l1 = std::abs(jet.gradient.x) + std::abs(jet.gradient.y) + std::abs(jet.gradient.z);
        const double slack = size > kRoughSize && size > spacing(depth) ? kRough : kCrossing;
        return std::abs(jet.value) <= slack * 0.5 * size * std::max(0.7, l1);
    };
    const double h = spacing(depth);
    Thinning thinning(kThinning * h);
    const auto move_and_offer = [&](const std::vector<ProbedCell>& cells) {
        std::vector<Centre> moved(cells.size());
        std::vector<std::uint8_t> stayed(cells.size());
        parallel_chunks(cells.size(), kChunk, task, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                stayed[i] = move_onto_surface(field, cells[i], h, moved[i]) ? 1 : 0;
        });
        for (std::size_t i = 0; i < cells.size(); ++i) {
            if (stayed[i] != 0) thinning.offer(moved[i]);
        }
        if (static_cast<std::int64_t>(thinning.kept().size()) > budget.centres) budget.probes = -1;
    };
    if (depth <= kRootDepth) {
        move_and_offer(descend(field, depth, budget, task, crossed));
    } else {
        const std::vector<ProbedCell> parents = descend(field, depth - 1, budget, task, crossed);
        for_batches_of_children(parents, budget, [&](const std::vector<CellIndex>& children) {
            std::vector<ProbedCell> cells;
            probe(field, children, h, budget, task, crossed, cells);
            move_and_offer(cells);
        });
    }
    return std::move(thinning.kept());
}

// Replaces the centres inside flagged cells by 3×3×3 lattice nodes.
void apply_thin_flags(const std::vector<ProbedCell>& cells, const Level& level, DeriveBudget& budget,
                      std::vector<Centre>& centres) {
    const double h = spacing(level.depth);
    CellTable flagged, nodes;
    std::vector<Centre> added;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (level.thin[i] == 0) continue;
        if (static_cast<std::int64_t>(added.size()) > budget.centres) budget.probes = -1;
        if (budget.exceeded()) return;
        const CellIndex& c = cells[i].index;
        flagged[c.key()] = 1;
        for (int t = 0; t < 27; ++t) {
            const CellIndex node{2 * c.x + t / 9, 2 * c.y + t / 3 % 3, 2 * c.z + t % 3};
            std::int32_t& seen = nodes[node.key()];
            if (seen > 0) continue;
            seen = 1;
            const Vec3 p{-1 + node.x * h, -1 + node.y * h, -1 + node.z * h};
            added.push_back({p, 1.0, true, 0});
        }
    }
    std::erase_if(centres, [&](const Centre& c) {
        return flagged.find(CellIndex::of(c.point + Vec3{1, 1, 1}, 1 / (2 * h)).key()) > 0;
    });
    centres.insert(centres.end(), added.begin(), added.end());
    for (Centre& c : centres) c.order = morton(c.point);
    std::stable_sort(centres.begin(), centres.end(),
                     [](const Centre& a, const Centre& b) { return a.order < b.order; });
}

}  // namespace

Quadric base_of(const HierarchyHead& head) {
    const Vec3 a{(head.axes[0] + 1) / 256.0, (head.axes[1] + 1) / 256.0, (head.axes[2] + 1) / 256.0};
    const double k = 0.5 * std::min({a.x, a.y, a.z});
    Quadric q;
    for (int d = 0; d < 3; ++d) q.c[static_cast<std::size_t>(d)] = -k / (a[d] * a[d]);
    q.c[9] = k;
    return q;
}

Level empty_level(const HierarchyHead& head, int depth) {
    Level level;
    level.depth = depth;
    level.radius = kSupport * spacing(depth);
    level.step = exp2_eighths(-int{head.step_code});
    level.towards_zero = head.shrink_code / 16.0;
    const double ratio = head.ratio_code / 64.0;
    for (int d = 7; d < depth; ++d) level.step *= ratio;
    for (int d = depth; d < 7; ++d) level.step /= ratio;
    return level;
}

DeriveBudget DeriveBudget::of_bytes(std::size_t bytes) {
    const auto n = static_cast<std::int64_t>(bytes);
    return {2048 + 32 * n, 512 + 6 * n, 2048 + 32 * n, 40'000 + 1024 * n};
}

std::vector<ProbedCell> thin_candidates(const FunctionField& field, int depth, DeriveBudget& budget,
                                        const Task& task) {
    return descend(field, depth - 1, budget, task, [](const Jet& jet, double size) {
        return std::abs(jet.value) <= kThinReach * size * std::max(0.7, norm(jet.gradient));
    });
}

void place_centres(const FunctionField& field, const HierarchyHead& head,
                   const std::vector<ProbedCell>& cells, Level& level, DeriveBudget& budget,
                   const Task& task) {
    level.centres.clear();
    level.scale.clear();
    level.lattice.clear();
    if (level.depth < head.first_sheet) {
        place_lattice(field, head, level, task);
        budget.centres -= static_cast<std::int64_t>(level.centres.size());
        return;
    }
    std::vector<Centre> centres = sheet_centres(field, level.depth, budget, task);
    if (!level.thin.empty()) apply_thin_flags(cells, level, budget, centres);
    for (const Centre& c : centres) {
        level.centres.push_back(c.point);
        level.scale.push_back(c.scale);
        level.lattice.push_back(c.lattice ? 1 : 0);
    }
    budget.centres -= static_cast<std::int64_t>(centres.size());
}

std::uint32_t fingerprint(const Level& level, std::uint32_t seed) {
    std::uint64_t hash = seed;
    const auto mix = [&hash](std::uint64_t v) {
        hash = (hash ^ v) * 0x9E3779B97F4A7C15ULL;
        hash ^= hash >> 32;
    };
    mix(level.centres.size());
    for (std::size_t i = 0; i < level.centres.size(); ++i) {
        const Vec3& c = level.centres[i];
        mix(std::bit_cast<std::uint64_t>(c.x) ^ std::rotl(std::bit_cast<std::uint64_t>(c.y), 21) ^
            std::rotl(std::bit_cast<std::uint64_t>(c.z), 42) ^ std::bit_cast<std::uint64_t>(level.scale[i]));
    }
    return static_cast<std::uint32_t>(hash);
}

}  // namespace pfgeom
