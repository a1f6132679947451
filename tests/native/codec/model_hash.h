// A hash of everything that a model holds, derived geometry included: goldens are compared by it.
#pragma once

#include "pfgeom/function/model.h"

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

namespace pfgeom::test {

/// FNV-1a over 64-bit words, in the order of the members.
class ModelHash {
  public:
    std::uint64_t value() const { return hash_; }

    void add(std::uint64_t v) { hash_ = (hash_ ^ v) * 0x100000001B3ULL; }
    void add(std::int64_t v) { add(static_cast<std::uint64_t>(v)); }
    void add(std::int32_t v) { add(static_cast<std::uint64_t>(v)); }
    void add(std::uint8_t v) { add(std::uint64_t{v}); }
    void add(bool v) { add(std::uint64_t{v}); }
    void add(char v) { add(static_cast<std::uint64_t>(static_cast<unsigned char>(v))); }
    void add(double v) { add(std::bit_cast<std::uint64_t>(v)); }
    void add(const Vec3& v) { add(v.x), add(v.y), add(v.z); }
    template <class T>
    void add(const std::vector<T>& list) {
        add(std::uint64_t{list.size()});
        for (const T& item : list) add(item);
    }
    template <class T, std::size_t n>
    void add(const std::array<T, n>& list) {
        for (const T& item : list) add(item);
    }
    void add(const std::string& s) { add(std::vector<char>(s.begin(), s.end())); }

    void add(const Quadric& q) { add(q.c); }
    void add(const Perturbation& p) { add(p.factor), add(p.quadric); }
    void add(const Level& l) {
        add(l.depth), add(l.radius), add(l.step), add(l.thin), add(l.z), add(l.centres), add(l.scale),
            add(l.lattice);
    }
    void add(const HierarchyHead& h) { add(h.axes), add(h.step_code), add(h.ratio_code), add(h.first_sheet); }
    void add(const Function& f) {
        add(f.base), add(f.perturbations), add(f.levels);
        if (!f.levels.empty()) add(f.head);
    }
    void add(const SetNode& n) { add(static_cast<std::uint8_t>(n.kind)), add(n.a), add(n.b), add(n.f); }
    void add(const Solid& s) { add(s.nodes); }
    void add(const Sheet& s) {
        add(s.surface), add(s.trim);
        if (!s.cut.nodes.empty()) add(s.cut);
    }
    void add(const Bulge& b) { add(b.normal), add(b.sideways); }
    void add(const MeshPart& m) {
        add(m.step_code), add(m.positions), add(m.faces);
        if (m.curved()) add(m.bulge_code), add(m.bulges);
        if (m.mirror) add(m.mirror->axis), add(m.mirror->at);
    }
    void add(const TreeQuadric& q) {
        add(q.family), add(q.linear_shift), add(q.square_shift), add(q.n), add(q.quadric);
    }
    void add(const TreeNode& n) {
        add(static_cast<std::uint8_t>(n.kind)), add(n.axis), add(n.fine), add(n.position), add(n.quadric);
        add(n.high), add(n.low), add(n.cut);
    }
    void add(const SetTree& t) {
        add(t.resolution), add(t.low), add(t.high), add(t.complement), add(t.quadrics), add(t.nodes);
    }
    void add(const Similarity& s) { add(s.scale), add(s.rows), add(s.translation); }
    void add(const Placement& p) { add(p.turn), add(p.mirrored), add(p.scale), add(p.place); }
    void add(const Placements& p) {
        add(p.turn_steps), add(p.scale_steps), add(p.step_code), add(p.origin), add(p.list);
    }
    void add(const Object& o) {
        add(o.frame.scale_code), add(o.frame.offset), add(std::uint64_t{o.shape.index()});
        std::visit([this](const auto& shape) { add(shape); }, o.shape);
        add(o.cavity_of), add(o.instances), add(o.mesh_code);
        if (!o.placements.empty()) add(o.placements);
    }
    void add(const Promise& p) {
        add(p.metric == Metric::rms), add(p.tolerance), add(p.bound_mesh), add(p.certified), add(p.rms);
        add(p.bound_functions), add(p.functions_certified);
    }
    void add(const MaterialNode& n) {
        add(n.material), add(n.axis), add(n.bits), add(n.tilt), add(n.offset), add(n.high), add(n.low);
        add(n.normal), add(n.level);
    }
    void add(const MaterialTree& t) { add(t.nodes); }
    void add(const Paint& p) { add(p.by_quadric), add(p.trees); }
    void add(const Model& m) {
        add(m.functions), add(m.objects), add(m.diagonal), add(m.promise);
        add(m.names), add(m.world_transform), add(m.face_groups);
        if (!m.materials.empty()) add(m.materials.names), add(m.materials.objects);
        if (!m.combination.empty()) add(m.combination);
    }
    void add(const Affine& a) { add(a.rows), add(a.translation); }
    void add(const Operand& o) { add(o.objects), add(o.diagonal), add(o.promise); }
    void add(const CombinationStep& s) { add(static_cast<std::uint8_t>(s.kind)), add(s.row); }
    void add(const Combination& c) { add(c.operands), add(c.transforms), add(c.steps); }

  private:
    std::uint64_t hash_ = 0xCBF29CE484222325ULL;
};

inline std::uint64_t hash_of(const Model& model) {
    ModelHash hash;
    hash.add(model);
    return hash.value();
}

}  // namespace pfgeom::test
