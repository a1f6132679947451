#include "pfgeom/codec/mesh_part_bulges.h"

#include "pfgeom/codec/residual.h"
#include "pfgeom/eval/edge_axes.h"
#include "pfgeom/function/edges_of_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace pfgeom {
namespace {

enum Kind : std::uint32_t { kStep = 166, kNormal = 168, kSideways = 172 };  // each residual takes four

constexpr std::int32_t kMaxBulge = 1 << 27;
constexpr int kMaxStepCode = 8 * 100;  // of exp2_eighths
// Faces that meet at more than 37 degrees make a crease.
constexpr double kCreaseCosine = 0.8;
// A prediction is at most this share of the edge.
constexpr double kMostBent = 0.2;
// How fast the weights of the predictions are learned.
constexpr double kLearning = 0.02;

class BulgeCoder {
  public:
    BulgeCoder(EntropyCoder& coder, ContextMixer& mixer, MeshPart& part)
        : coder_(coder),
          mixer_(mixer),
          part_(part),
          edges_(EdgesOfFaces::of(part.faces)),
          axes_(edge_axes(part, edges_)),
          normals_(part.positions.size()),
          around_(part.positions.size()),
          steps_(exp2_eighths(part.step_code - part.bulge_code)) {
        for (const Triangle& t : part.faces) {
            const Vec3 a = at(t[0]), normal = normalized(cross(at(t[1]) - a, at(t[2]) - a));
            for (const std::int32_t v : t) normals_[static_cast<std::size_t>(v)] += normal;
        }
        for (std::size_t v = 0; v < normals_.size(); ++v) {
            if (part.on_mirror(static_cast<std::int32_t>(v))) normals_[v][part.mirror->axis] = 0;
            normals_[v] = normalized(normals_[v]);
        }
    }

    FormatStatus run() {
        if (coder_.decoding()) part_.bulges.assign(edges_.ends.size(), {});
        for (std::size_t row = 0; row < edges_.ends.size(); ++row) {
            if (coder_.exhausted()) return FormatStatus::truncated;
            if (!code(row)) return FormatStatus::bad_value;
        }
        return FormatStatus::ok;
    }

  private:
    // The bulges of the last edges at a vertex. Not all of them, so that no input can make this long.
    static constexpr std::size_t kRemembered = 8;
    struct Known {
        Vec3 along;
        double curvature = 0;  // of the bulge along the normal: over the squared length
        std::uint32_t missed = 0, sideways = 0;
        Vec3 normal;
    };
    struct Around {
        std::array<Known, kRemembered> known;
        std::size_t count = 0;
    };
    enum Class : std::uint32_t { kSmooth, kCrease, kBorder, kOther };

    Vec3 at(std::int32_t v) const {
        const auto& p = part_.positions[static_cast<std::size_t>(v)];
        return {1.0 * p[0], 1.0 * p[1], 1.0 * p[2]};
    }
    static Class class_of(const EdgeAxes& axes) {
        if (axes.faces == 1) return kBorder;
        if (axes.faces != 2) return kOther;
        return axes.fold < kCreaseCosine ? kCrease : kSmooth;
    }
    bool code(std::size_t row);
    bool code_number(std::int32_t& value, double predicted, const ResidualHint& hint) {
        constexpr double kMost = kMaxBulge;
        const auto base = static_cast<std::int32_t>(std::floor(std::clamp(predicted, -kMost, kMost) + 0.5));
        value = base + code_residual(coder_, mixer_, value - base, hint);
        return std::abs(value) < kMaxBulge;
    }

    EntropyCoder& coder_;
    ContextMixer& mixer_;
    MeshPart& part_;
    EdgesOfFaces edges_;
    std::vector<EdgeAxes> axes_;
    std::vector<Vec3> normals_;  // of the vertices
    std::vector<Around> around_;
    double steps_;  // of bulges, in a step of positions
    std::array<std::array<double, 2>, 4> weights_{{{0.5, 0.3}, {0.2, 0.3}, {0.2, 0.5}, {0.2, 0.3}}};
};

// In bulge steps, but lengths and places in steps of positions.
bool BulgeCoder::code(std::size_t row) {
    const auto& [from, to] = edges_.ends[row];
    const EdgeAxes& axes = axes_[row];
    const Class kind = class_of(axes);
    const Vec3 edge = at(to) - at(from);
    const double squared = squared_norm(edge), length = std::sqrt(squared);
    const Vec3 &n0 = normals_[static_cast<std::size_t>(from)], &n1 = normals_[static_cast<std::size_t>(to)];

    // Of an arc: its height is an eighth of its length times the angle between the normals at its ends.
    double turned = dot(n1 - n0, edge) / 8;
    if (dot(n0 + n1, axes.normal) < 0) turned = -turned;
    double sum = 0, weight = 1e-3, missed = 0, sideways = 0;
    int known = 0;
    for (const std::int32_t end : {from, to}) {
        const Around& around = around_[static_cast<std::size_t>(end)];
        for (std::size_t i = 0; i < std::min(around.count, kRemembered); ++i) {
            const Known& k = around.known[i];
            const double cosine = dot(k.along, axes.along), c2 = cosine * cosine;
            const double w = c2 * c2 + 0.05;
            sum += w * (dot(k.normal, axes.normal) < 0 ? -k.curvature : k.curvature);
            weight += w;
            missed += k.missed;
            sideways += k.sideways;
            ++known;
        }
    }
    const double most = kMostBent * length;
    const std::array<double, 2> guess{std::clamp(turned, -most, most) * steps_,
                                      std::clamp(sum / weight * squared, -most, most) * steps_};
    std::array<double, 2>& w = weights_[kind];
    const double predicted = std::clamp(w[0] * guess[0] + w[1] * guess[1], -most * steps_, most * steps_);

    Bulge& bulge = part_.bulges[row];
    const auto mean = [&](double total) {
        return std::min(half_octaves(known > 0 ? total / known : 0) + (known > 0 ? 1 : 0), 63U);
    };
    const std::uint32_t scale = std::min(half_octaves(length * steps_), 63U);
    const std::uint32_t extra = std::min(half_octaves(std::abs(predicted)), 15U) + 16 * kind;
    if (!code_number(bulge.normal, predicted, {kNormal, scale, mean(missed), extra})) return false;
    const bool bent = kind != kSmooth;
    if (!part_.is_seam(edges_.ends[row]) &&  // it stays on the plane
        !code_number(bulge.sideways, 0, {kSideways, bent ? 1 + scale : 0, mean(sideways), kind}))
        return false;

    const double error = bulge.normal - predicted;
    const double power = guess[0] * guess[0] + guess[1] * guess[1] + 4;
    for (std::size_t i = 0; i < 2; ++i) {
        w[i] = std::clamp(w[i] + kLearning * std::clamp(error, -2 * std::sqrt(power), 2 * std::sqrt(power)) *
                                     guess[i] / power,
                          -1.0, 2.0);
    }
    const Known now{axes.along, squared > 0 ? bulge.normal / (steps_ * squared) : 0,
                    static_cast<std::uint32_t>(std::min(std::abs(error), 1e6)),
                    static_cast<std::uint32_t>(std::abs(bulge.sideways)), axes.normal};
    for (const std::int32_t end : {from, to}) {
        Around& around = around_[static_cast<std::size_t>(end)];
        around.known[around.count++ % kRemembered] = now;
    }
    return true;
}

}  // namespace

FormatStatus code_bulges(EntropyCoder& coder, ContextMixer& mixer, MeshPart& part) {
    part.bulge_code = part.step_code + mixer.code_int(coder, part.bulge_code - part.step_code, kStep);
    if (part.bulge_code < -kMaxStepCode || part.bulge_code > kMaxStepCode) return FormatStatus::bad_value;
    return BulgeCoder(coder, mixer, part).run();
}

}  // namespace pfgeom
