#include "pfgeom/codec/placement_codec.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <vector>

namespace pfgeom {
namespace {

constexpr std::uint32_t kPlacementCount = 5;     // context of code_size
constexpr std::uint32_t kPlacementOrigin = 258;  // and the two after it: contexts of code_wide

using Turn = std::array<std::int32_t, 4>;

class PlacementCoder {
  public:
    PlacementCoder(CodecStream& stream, Placements& placements) : stream_(stream), p_(placements) {}

    void code_head(int scale_code) {
        p_.turn_steps = code_steps(p_.turn_steps, 0);
        p_.scale_steps = code_steps(p_.scale_steps, 1);
        const std::int64_t step =
            std::int64_t{scale_code} + code_int(p_.step_code - scale_code, kStepCodeKind);
        stream_.expect(std::abs(step) <= 1 << 20);
        if (stream_.ok()) p_.step_code = static_cast<int>(step);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            p_.origin[axis] =
                code_wide(stream_, p_.origin[axis], kPlacementOrigin + static_cast<std::uint32_t>(axis));
        }
    }

    void code(Placement& placement) {
        code_place(placement);
        code_turn(placement.turn);
        placement.mirrored = code_flag(stream_, placement.mirrored, kMirrorFlag);
        placement.scale = unscaled_ ? 1 : code_steps(placement.scale, 2);
    }

    /// If all have the scale 1, none is coded.
    void code_unscaled() { unscaled_ = code_flag(stream_, are_unscaled(), kUnscaledFlag); }
    /// … and then no other form of them is right.
    void check_unscaled() { stream_.expect(unscaled_ == are_unscaled()); }

  private:
    bool are_unscaled() const {
        const auto grows = [](const Placement& p) { return p.scale != 1; };
        return p_.scale_steps == 1 && std::none_of(p_.list.begin(), p_.list.end(), grows);
    }

    std::int32_t code_steps(std::int32_t n, std::uint32_t context) {
        const std::uint32_t steps =
            stream_.mixer.code_uint(stream_.coder, static_cast<std::uint32_t>(n), kStepsKind, context);
        stream_.expect(steps >= 1 && steps <= Placements::kMostScale);
        return stream_.ok() ? static_cast<std::int32_t>(steps) : 1;
    }

    // By rising x; the first is at 0.
    void code_place(Placement& placement) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::int64_t before = axis == 0 ? last_x_ : 0;
            const auto in = static_cast<std::uint32_t>(placement.place[axis] - before);
            const std::int64_t place = before + stream_.mixer.code_uint(stream_.coder, in, kPlaceKind,
                                                                        static_cast<std::uint32_t>(axis));
            stream_.expect(place <= Placements::kMostPlace);
            if (stream_.ok()) placement.place[axis] = static_cast<std::int32_t>(place);
        }
        last_x_ = placement.place[0];
    }

    // 0: a new one; n: the n-th last of the different ones.
    void code_turn(Turn& turn) {
        const auto known = std::find(turns_.rbegin(), turns_.rend(), turn);
        const auto in = known == turns_.rend() ? 0 : static_cast<std::uint32_t>(known - turns_.rbegin()) + 1;
        const std::uint32_t back = stream_.mixer.code_uint(stream_.coder, in, kKnownTurnKind);
        if (back > turns_.size()) return stream_.fail(FormatStatus::bad_value);
        if (back > 0) {
            turn = turns_[turns_.size() - back];
            turns_.erase(turns_.end() - static_cast<std::ptrdiff_t>(back));
        } else {
            code_new_turn(turn);
            stream_.expect(std::find(turns_.begin(), turns_.end(), turn) == turns_.end());
            if (turns_.size() == kRecentTurns) turns_.erase(turns_.begin());
        }
        turns_.push_back(turn);
    }

    void code_new_turn(Turn& turn) {
        const auto largest = static_cast<std::size_t>(
            std::max_element(turn.begin(), turn.end(),
                             [](auto a, auto b) { return std::abs(a) < std::abs(b); }) -
            turn.begin());
        const std::uint32_t at =
            stream_.mixer.code_uint(stream_.coder, static_cast<std::uint32_t>(largest), kLargestKind);
        if (at > 3) return stream_.fail(FormatStatus::bad_value);
        for (std::size_t i = 0; i < 4; ++i) {
            if (i == at) {
                turn[i] = p_.turn_steps;
                continue;
            }
            const std::int32_t component = code_int(turn[i], kTurnKind);
            // Those before the largest are less.
            const std::int32_t most = p_.turn_steps - (i < at ? 1 : 0);
            if (component < -most || component > most) return stream_.fail(FormatStatus::bad_value);
            turn[i] = component;
        }
    }

    std::int32_t code_int(std::int32_t value, std::uint32_t kind) {
        return stream_.mixer.code_int(stream_.coder, value, kind);
    }

    CodecStream& stream_;
    Placements& p_;
    std::vector<Turn> turns_;  // different ones, by their last use
    std::int64_t last_x_ = 0;
    bool unscaled_ = true;
};

}  // namespace

void code_placements(CodecStream& stream, Placements& placements, int scale_code) {
    code_size(stream, placements.list, kPlacementCount);
    if (placements.empty()) return;
    PlacementCoder coder(stream, placements);
    coder.code_head(scale_code);
    coder.code_unscaled();
    for (Placement& placement : placements.list) {
        if (!stream.ok()) return;
        coder.code(placement);
    }
    coder.check_unscaled();
}

}  // namespace pfgeom
