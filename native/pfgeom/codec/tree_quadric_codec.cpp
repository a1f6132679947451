#include "pfgeom/codec/tree_quadric_codec.h"

#include "pfgeom/function/quadric_family.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace pfgeom {
namespace {

constexpr int kMostWidth = 28;  // of a difference of integers of up to 26 bits

// Quadrics further back than this are not looked at as models for a new one.
constexpr std::size_t kMostLike = 256;
constexpr int kLeastGain = 8;  // in bits, for which one is taken

// Kinds of the model.
enum Kind : std::uint32_t {
    kFamilyKind,
    kFamilyOfKind,
    kLinearShift,
    kSquareShift,
    kNotZero,
    kWider,
    kFurther,
    kNegative,
    kIsLike,
    kLikeWhich,
    kSame,
    kTurned,
};

// What an integer stands for.
enum Role : std::uint32_t { kConstant, kLinear, kFirstSquare, kLaterSquare };

int width_of(std::int32_t value) {
    return static_cast<int>(std::bit_width(static_cast<std::uint32_t>(std::abs(value))));
}

// A length in units, as the width of an integer.
int width_of_length(double length) {
    return std::bit_width(static_cast<std::uint32_t>(std::min(length, 0x1p26)));
}

// Sum over the axes of g² / 4a - 1 / 4a: the constant of a round quadric whose slope on its surface is 1.
// Axes along which the centre is not in the cube are left out.
double constant_of_slope_one(const Quadric& q) {
    double sum = 0, first = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double a = q.c[axis], g = q.c[6 + axis];
        if (a == 0 || std::abs(g) > 2 * std::abs(a)) continue;
        sum += g * g / (4 * a);
        if (first == 0) first = a;
    }
    return first == 0 ? 0 : sum - 1 / (4 * first);
}

double largest_square(const Quadric& q) {
    return std::max({std::abs(q.c[0]), std::abs(q.c[1]), std::abs(q.c[2])});
}

std::uint32_t role_of(const TreeQuadric& quadric, int index) {
    const int degree = quadric_families()[quadric.family].degree(index);
    return degree == 0 ? kConstant : degree == 1 ? kLinear : index == 0 ? kFirstSquare : kLaterSquare;
}

// About the bits that are saved by writing a quadric after another one: family, shifts and equal integers
// against a flag for each integer.
int gain_of(const TreeQuadric& quadric, const TreeQuadric& like) {
    if (like.family != quadric.family || like.linear_shift != quadric.linear_shift ||
        like.square_shift != quadric.square_shift) {
        return 0;
    }
    int gain = 8;
    for (std::size_t i = 0; i < quadric_families()[quadric.family].size; ++i) {
        const bool same = std::abs(quadric.n[i]) == std::abs(like.n[i]);
        gain += same ? 1 + width_of(quadric.n[i]) : -1;
    }
    return gain;
}

// The integers up to index - 1, the others 0.
Quadric begin_of(const TreeQuadric& quadric, int index, int resolution) {
    TreeQuadric begin = quadric;
    for (std::size_t i = static_cast<std::size_t>(index); i < begin.n.size(); ++i) begin.n[i] = 0;
    return expand(begin, resolution);
}

}  // namespace

void TreeQuadricCoder::code(std::span<TreeQuadric> quadrics, std::size_t index, int resolution) {
    TreeQuadric& quadric = quadrics[index];
    const TreeQuadric* like = code_like(quadrics.first(index), quadric);
    if (like == nullptr) {
        code_form(quadric);
    } else if (stream_.decoding()) {
        quadric = {like->family, like->linear_shift, like->square_shift, {}, {}};
    }
    for (int i = 0; i < quadric_families()[quadric.family].size; ++i) {
        const auto at = static_cast<std::size_t>(i);
        if (like != nullptr && code_same(quadric.n[at], like->n[at], role_of(quadric, i))) continue;
        code_integer(quadric, i, resolution);
    }
    quadric.quadric = expand(quadric, resolution);
}

// The earlier quadric that this one is written after, or null.
const TreeQuadric* TreeQuadricCoder::code_like(std::span<const TreeQuadric> earlier,
                                               const TreeQuadric& quadric) {
    const std::span<const TreeQuadric> recent = earlier.last(std::min(earlier.size(), kMostLike));
    if (recent.empty()) return nullptr;
    std::size_t best = recent.size();  // by how far back, from 0
    if (!stream_.decoding()) {
        int most = width_of(static_cast<std::int32_t>(recent.size())) + kLeastGain;
        for (std::size_t back = 0; back < recent.size(); ++back) {
            const int gain = gain_of(quadric, recent[recent.size() - 1 - back]);
            if (gain <= most) continue;
            most = gain;
            best = back;
        }
    }
    if (bit(best < recent.size(), kIsLike, 16384, {0}) == 0) return nullptr;
    return &recent[recent.size() - 1 - model_.choose(stream_.coder, best, recent.size(), kLikeWhich)];
}

// An integer like the other quadric's, but perhaps for its sign.
bool TreeQuadricCoder::code_same(std::int32_t& n, std::int32_t like, std::uint32_t role) {
    if (bit(std::abs(n) == std::abs(like), kSame, 45000, {role}) == 0) return false;
    const bool turned = like != 0 && bit((n < 0) != (like < 0), kTurned, 16384, {role}) != 0;
    n = turned ? -like : like;
    return true;
}

void TreeQuadricCoder::code_form(TreeQuadric& quadric) {
    code_family(quadric);
    const QuadricFamily& family = quadric_families()[quadric.family];
    if (family.has_linear_shift())
        quadric.linear_shift = code_shift(quadric.linear_shift, kLinearShift, family.kind);
    if (family.has_squares())
        quadric.square_shift = code_shift(quadric.square_shift, kSquareShift, family.kind);
}

// Which kind of family, then which family of that kind.
void TreeQuadricCoder::code_family(TreeQuadric& quadric) {
    const auto families = quadric_families();
    const std::size_t in = quadric.family;
    std::uint32_t kind = 0;
    constexpr std::uint32_t kLast = static_cast<std::uint32_t>(FamilyKind::general);
    const auto wanted = static_cast<std::uint32_t>(families[in].kind);
    while (kind < kLast && bit(wanted > kind, kFamilyKind, 45000, {kind}) != 0) ++kind;
    std::uint8_t family = 0;
    while (static_cast<std::uint32_t>(families[family].kind) != kind) ++family;
    while (family + 1U < families.size() && families[family + 1U].kind == families[family].kind &&
           bit(in > family, kFamilyOfKind, 40000, {family}) != 0) {
        ++family;
    }
    quadric.family = family;
}

// Four bits, the highest first.
std::uint8_t TreeQuadricCoder::code_shift(std::uint8_t shift, std::uint32_t kind, FamilyKind family) {
    std::uint32_t at = 1;
    for (int i = 3; i >= 0; --i) {
        const std::uint32_t finer = 16 * static_cast<std::uint32_t>(family) + at;
        at = 2 * at + static_cast<std::uint32_t>(bit(shift >> i & 1, kind, 32768, {at, finer}));
    }
    return static_cast<std::uint8_t>(at & 15U);
}

void TreeQuadricCoder::code_integer(TreeQuadric& quadric, int index, int resolution) {
    const QuadricFamily& family = quadric_families()[quadric.family];
    const int degree = family.degree(index), linear = resolution - quadric.linear_shift;
    const std::uint32_t role = role_of(quadric, index);
    std::int32_t& n = quadric.n[static_cast<std::size_t>(index)];
    const auto place = 16U * static_cast<std::uint32_t>(family.kind) + static_cast<std::uint32_t>(index);
    if (family.kind == FamilyKind::axis_plane && degree == 1) {
        n = bit(n < 0, kNegative, 32768, {kLinear, 4U + quadric.family}) != 0 ? -1 : 1;
        return;
    }
    const Quadric before = begin_of(quadric, index, resolution);
    const double square = largest_square(before);
    const double unit = std::ldexp(1.0, degree == 0   ? resolution
                                        : degree == 1 ? linear
                                                      : linear - quadric.square_shift);
    if (degree == 2) {
        const int expected = index == 0 ? 3 : width_of_length(square * unit);
        n = code_value(n, expected, role, place);
    } else if (degree == 1) {
        n = code_value(n, std::max(linear, width_of_length(square * unit)), role, place);
    } else {
        const double guess = constant_of_slope_one(before) * unit;
        const double room = guess == 0 ? unit / 4 : unit / (4 * square);
        const auto base = static_cast<std::int32_t>(std::floor(std::clamp(guess, -0x1p26, 0x1p26) + 0.5));
        n = base + code_value(n - base, width_of_length(room), role, place);
    }
    stream_.expect(std::abs(n) <= kMostQuadricInteger);
    if (!stream_.ok()) n = 0;
}

// Zero or not, width, sign, the bits below the highest raw.
std::int32_t TreeQuadricCoder::code_value(std::int32_t value, int expected_width, std::uint32_t role,
                                          std::uint32_t place) {
    if (bit(value != 0, kNotZero, 52000, {role, place}) == 0) return 0;
    const int width = code_width(width_of(value), std::clamp(expected_width, 1, kMostWidth), role, place);
    const bool negative = bit(value < 0, kNegative, 32768, {role}) != 0;
    const auto in = static_cast<std::uint32_t>(std::abs(value));
    const std::uint32_t top = 1U << (width - 1);
    const std::uint32_t magnitude = top | stream_.coder.code_raw(in & (top - 1), width - 1);
    return negative ? -static_cast<std::int32_t>(magnitude) : static_cast<std::int32_t>(magnitude);
}

// Above the expected width or not, then how far from it.
int TreeQuadricCoder::code_width(int width, int expected, std::uint32_t role, std::uint32_t place) {
    const bool wider = expected < kMostWidth && bit(width > expected, kWider, 16384, {role, place}) != 0;
    const int step = wider ? 1 : -1, end = wider ? kMostWidth : 1;
    int at = wider ? expected + 1 : expected;
    for (std::uint32_t i = 0; at != end; ++i, at += step) {
        const std::uint32_t where = 64 * i + (wider ? 32U : 0U);
        if (bit(step * (width - at) > 0, kFurther, 38000, {where + role, 1024 * place + where}) == 0) break;
    }
    return at;
}

}  // namespace pfgeom
