// All zeros of a function of one variable whose second derivative is bounded.
#pragma once

#include "pfgeom/render/ray.h"

#include <algorithm>
#include <cmath>

namespace pfgeom {

/// Calls found(t) where f changes its sign in the span, rising, until it returns true; returns whether it
/// did. `bend`: |f''| is at most this. Zeros closer to each other than `resolution` may be left out in pairs.
/// The sign is that of f(t) >= 0.
///
/// Over a span of length d, f is within bend d² / 8 of its chord, and its slope within bend d / 2 of the
/// chord's: so ends of one sign far enough from zero have no zero between them, and a chord steep enough has
/// one zero at most. What neither settles is halved.
template <class Function, class Found>
class SpanRoots {
  public:
    SpanRoots(Function f, double bend, double resolution, Found found)
        : f_(f), bend_(bend), resolution_(resolution), found_(found) {}

    bool run(const RaySpan& span) {
        from_value_ = f_(span.from);
        return search({span.from, from_value_}, {span.to, f_(span.to)}, kHalvings);
    }
    /// f at the span's beginning.
    double from_value() const { return from_value_; }

  private:
    // Halving on every side is for the few functions of hostile files that bend by any amount; others need
    // some ten halvings in a cell.
    static constexpr int kHalvings = 40, kMostEvaluations = 1024;
    // Regula falsi needs 3 to 5 steps in a cell, as the function is nearly linear there; bisection never
    // more.
    static constexpr int kSteps = 100;
    static constexpr double kRefine = 1e-3;  // of the resolution

    struct End {
        double t, value;
        bool high() const { return value >= 0; }
    };

    bool search(const End& a, const End& b, int halvings) {
        const double d = b.t - a.t, rise = std::abs(b.value - a.value);
        const bool steep = rise > 0.5 * bend_ * d * d, changes = a.high() != b.high();
        if (!changes) {
            const double clear = std::min(std::abs(a.value), std::abs(b.value));
            if (steep || clear > 0.125 * bend_ * d * d) return false;
        }
        if (steep || d <= resolution_ || halvings == 0 || evaluations_ >= kMostEvaluations)
            return changes && found_(refine(a, b, rise / d - 0.5 * bend_ * d));
        const double t = a.t + 0.5 * d;
        const End middle{t, f_(t)};
        ++evaluations_;
        return search(a, middle, halvings - 1) || search(middle, b, halvings - 1);
    }

    // Source: Dowell, Jarratt, "A modified regula falsi method for computing the root of an equation", 1971
    // (Illinois). Departure: every third step that does not halve the bracket is a bisection.
    // `slope`: the least one, if positive.
    double refine(End a, End b, double slope) const {
        int side = 0;
        double before = b.t - a.t;
        for (int step = 1; step <= kSteps && b.t - a.t > kRefine * resolution_; ++step) {
            double t = a.t - a.value * ((b.t - a.t) / (b.value - a.value));
            if (step % 3 == 0) {
                if (b.t - a.t > 0.5 * before) t = a.t + 0.5 * (b.t - a.t);
                before = b.t - a.t;
            }
            if (!(t > a.t && t < b.t)) return a.value == 0 ? a.t : t <= a.t ? a.t : b.t;
            const double value = f_(t);
            if (std::abs(value) <= kRefine * resolution_ * slope || value == 0) return t;
            if ((value >= 0) == a.high()) {
                if (side < 0) b.value *= 0.5;
                a = {t, value};
                side = -1;
            } else {
                if (side > 0) a.value *= 0.5;
                b = {t, value};
                side = 1;
            }
        }
        return a.t + 0.5 * (b.t - a.t);
    }

    Function f_;
    double bend_, resolution_;
    Found found_;
    double from_value_ = 0;
    int evaluations_ = 0;
};

}  // namespace pfgeom
