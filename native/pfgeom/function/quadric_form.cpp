// Source: Lukács, Martin, Marshall, "Faithful least-squares fitting of spheres, cylinders, cones and tori for
// reliable segmentation", ECCV 1998: distances to first order, Gauss-Newton steps. Departure: one table of
// forms instead of a parametrisation for each surface; what a form leaves open are a rotation of its frame
// and coefficients in it, both of which enter a step linearly.
#include "pfgeom/function/quadric_form.h"

#include "pfgeom/base/cholesky.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pfgeom {
namespace {

constexpr int kMostSteps = 20;
constexpr double kConverged = 0.9999, kHopeless = 0.7;  // of the squared error before a step
constexpr double kMostTurn = 0.3;                       // of one step
constexpr double kAligned = 0.9;  // mean cosine of normals; a thin strip lies in a plane across it
constexpr double kRidge = 1e-13;  // of the first solution
constexpr double kLeastDamping = 1e-9, kMostDamping = 1e3;

constexpr std::uint32_t bit(QuadricKind kind) {
    return 1U << static_cast<std::uint32_t>(kind);
}

using K = QuadricKind;
constexpr std::uint32_t kFree = bit(K::ellipsoid) | bit(K::one_sheet) | bit(K::two_sheets);
constexpr std::uint32_t kParaboloids = bit(K::elliptic_paraboloid) | bit(K::hyperbolic_paraboloid);
constexpr std::uint32_t kRound = bit(K::spheroid) | bit(K::circular_one_sheet) | bit(K::circular_two_sheets);
constexpr std::uint32_t kConic = bit(K::elliptic_cylinder) | bit(K::hyperbolic_cylinder);
constexpr std::uint32_t kPairs = bit(K::parallel_planes) | bit(K::crossing_planes);
constexpr std::uint32_t kCurved = kFree | kParaboloids | bit(K::elliptic_cone);
constexpr std::uint32_t kOfRevolution = kCurved | kRound | bit(K::circular_paraboloid);
constexpr std::uint32_t kAnyCylinder = kConic | bit(K::parabolic_cylinder);

constexpr std::array<QuadricForm, 12> kForms{{
    // plane, sphere
    {{-1, -1, -1}, {true, true, true}, false, 1, ~bit(K::plane)},
    {{0, 0, 0}, {true, true, true}, false, 1, kOfRevolution},
    // parallel planes, circular cylinder
    {{0, -1, -1}, {true, false, false}, false, 3, kFree | kPairs | kAnyCylinder},
    {{-1, 0, 0}, {false, true, true}, false, 3, kOfRevolution | kAnyCylinder | bit(K::circular_cone)},
    // circular cone, crossing planes, parabolic cylinder, circular paraboloid
    {{1, 0, 0}, {true, true, true}, true, 3, kOfRevolution},
    {{-1, 0, 1}, {false, true, true}, true, 3, kCurved | kConic},
    {{0, -1, -1}, {true, true, false}, false, 6, kCurved | kConic},
    {{-1, 0, 0}, {true, true, true}, false, 3, kCurved | kRound},
    // elliptic or hyperbolic cylinder, other surfaces of revolution
    {{-1, 0, 1}, {false, true, true}, false, 3, kCurved},
    {{1, 0, 0}, {true, true, true}, false, 3, kCurved},
    // elliptic cone, other paraboloids
    {{0, 1, 2}, {true, true, true}, true, 1, kFree},
    {{-1, 0, 1}, {true, true, true}, false, 3, kFree},
}};

class FormFit {
  public:
    FormFit(const QuadricForm& form, std::span<const SurfaceSpot> spots, double tolerance)
        : form_(form), spots_(spots), good_(tolerance * tolerance * static_cast<double>(spots.size())) {
        for (const int g : form.group) groups_ = std::max(groups_, static_cast<std::size_t>(g + 1));
        coefficients_ = groups_ + 1;
        for (const bool l : form.linear) coefficients_ += l ? 1 : 0;
    }

    // From this frame to the nearest minimum.
    TurnedQuadric run(const std::array<Vec3, 3>& frame) const {
        TurnedQuadric q;
        q.axes = frame;
        begin(q);
        double error = squared_error(q), damping = 1e-4;
        for (int i = 0; i < kMostSteps && damping < kMostDamping; ++i) {
            const TurnedQuadric next = step(q, damping);
            const double then = squared_error(next);
            if (!(then < error)) {
                damping *= 10;
                continue;
            }
            const bool done = then > (then > good_ ? kHopeless : kConverged) * error;
            q = next;
            error = then;
            damping = std::max(damping / 10, kLeastDamping);
            if (done) break;
        }
        return q;
    }

  private:
    using Row = Vector10;  // what a value answers to: coefficients (groups, linear, constant), rotations

    Vector10 coefficients(const TurnedQuadric& q) const {
        Vector10 x{};
        std::size_t at = groups_;
        for (std::size_t i = 0; i < 3; ++i) {
            if (form_.group[i] >= 0) x[static_cast<std::size_t>(form_.group[i])] = q.squares[i];
            if (form_.linear[i]) x[at++] = q.linear[i];
        }
        x[at] = q.constant;
        return x;
    }

    void set_coefficients(TurnedQuadric& q, const Vector10& x) const {
        std::size_t at = groups_;
        for (std::size_t i = 0; i < 3; ++i) {
            q.squares[i] = form_.group[i] >= 0 ? x[static_cast<std::size_t>(form_.group[i])] : 0;
            q.linear[i] = form_.linear[i] ? x[at++] : 0;
        }
        q.constant = x[at];
        if (!form_.singular) return;
        q.constant = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            if (q.squares[i] != 0) q.constant += q.linear[i] * q.linear[i] / (4 * q.squares[i]);
        }
    }

    Row values_row(const Vec3& y) const {
        Row row{};
        std::size_t at = groups_;
        for (int i = 0; i < 3; ++i) {
            const auto axis = static_cast<std::size_t>(i);
            if (form_.group[axis] >= 0) row[static_cast<std::size_t>(form_.group[axis])] += y[i] * y[i];
            if (form_.linear[axis]) row[at++] = y[i];
        }
        row[at] = 1;
        return row;
    }

    // The slope along a direction.
    Row slope_row(const Vec3& y, const Vec3& d) const {
        Row row{};
        std::size_t at = groups_;
        for (int i = 0; i < 3; ++i) {
            const auto axis = static_cast<std::size_t>(i);
            if (form_.group[axis] >= 0) row[static_cast<std::size_t>(form_.group[axis])] += 2 * y[i] * d[i];
            if (form_.linear[axis]) row[at++] = d[i];
        }
        return row;
    }

    Row full_row(const TurnedQuadric& q, const Vec3& y) const {
        Row row = values_row(y);
        if (form_.singular) {  // the constant follows from the others
            std::size_t at = groups_;
            for (std::size_t i = 0; i < 3; ++i) {
                const double s = q.squares[i], l = q.linear[i];
                if (s != 0) row[static_cast<std::size_t>(form_.group[i])] -= l * l / (4 * s * s);
                if (form_.linear[i]) row[at++] += s != 0 ? l / (2 * s) : 0;
            }
            row[at] = 0;
        }
        const Vec3 turn = cross(q.local_gradient(y), y);
        for (int i = 0; i < 3; ++i) row[coefficients_ + static_cast<std::size_t>(i)] = turn[i];
        return row;
    }

    static void add(Matrix10& a, Vector10& b, const Row& row, double weight, double value, std::size_t n) {
        for (std::size_t i = 0; i < n; ++i) {
            b[i] += weight * row[i] * value;
            for (std::size_t j = 0; j <= i; ++j) a[i][j] += weight * row[i] * row[j];
        }
    }

    // The coefficients in this frame: small values and a mean slope of one.
    void begin(TurnedQuadric& q) const {
        Matrix10 a{};
        Vector10 b{};
        Row slope{};
        const auto count = static_cast<double>(spots_.size());
        for (const SurfaceSpot& spot : spots_) {
            const Vec3 y = q.local(spot.point);
            const Row row = slope_row(y, q.turn(spot.inwards));
            for (std::size_t i = 0; i < coefficients_; ++i) slope[i] += row[i] / count;
            add(a, b, values_row(y), 1, 0, coefficients_);
        }
        add(a, b, slope, count, 1, coefficients_);
        double trace = 0;
        for (std::size_t i = 0; i < coefficients_; ++i) trace += a[i][i];
        for (std::size_t i = 0; i < coefficients_; ++i) a[i][i] += kRidge * trace;
        set_coefficients(q, solve_factorised(factorise(a, coefficients_), b, coefficients_));
    }

    TurnedQuadric step(const TurnedQuadric& q, double damping) const {
        const std::size_t n = coefficients_ + 3;
        Matrix10 a{};
        Vector10 b{};
        for (const SurfaceSpot& spot : spots_) {
            const Vec3 y = q.local(spot.point);
            const double slope = squared_norm(q.local_gradient(y));
            if (slope > 0) add(a, b, full_row(q, y), 1 / slope, -q.local_value(y), n);
        }
        for (std::size_t i = 0; i < n; ++i) a[i][i] = a[i][i] * (1 + damping) + 1e-300;
        const Vector10 change = solve_factorised(factorise(a, n), b, n);
        Vector10 x = coefficients(q);
        for (std::size_t i = 0; i < coefficients_; ++i) x[i] += change[i];
        TurnedQuadric next = q;
        turn(next.axes, {change[coefficients_], change[coefficients_ + 1], change[coefficients_ + 2]});
        set_coefficients(next, x);
        return next;
    }

    // By a small rotation about a vector in the frame's own coordinates.
    static void turn(std::array<Vec3, 3>& axes, Vec3 by) {
        if (const double length = norm(by); length > kMostTurn) by = by * (kMostTurn / length);
        const std::array<Vec3, 3> old = axes;
        axes[0] = normalized(old[0] + by.z * old[1] - by.y * old[2]);
        axes[1] = old[1] - by.z * old[0] + by.x * old[2];
        axes[1] = normalized(axes[1] - dot(axes[1], axes[0]) * axes[0]);
        axes[2] = cross(axes[0], axes[1]);
    }

    double squared_error(const TurnedQuadric& q) const {
        double sum = 0;
        for (const SurfaceSpot& spot : spots_) {
            const Vec3 y = q.local(spot.point);
            const double value = q.local_value(y), slope = squared_norm(q.local_gradient(y));
            if (!(slope > 0)) return std::numeric_limits<double>::infinity();
            sum += value * value / slope;
        }
        return sum;
    }

    const QuadricForm& form_;
    std::span<const SurfaceSpot> spots_;
    double good_;  // squared error
    std::size_t groups_ = 0, coefficients_ = 0;
};

// Axis i first, the others behind it; turned the other way round for the second three.
std::array<Vec3, 3> begun_with(const std::array<Vec3, 3>& axes, std::size_t i) {
    const std::array<Vec3, 3> even{axes[i % 3], axes[(i + 1) % 3], axes[(i + 2) % 3]};
    return i < 3 ? even : std::array{even[0], even[2], -even[1]};
}

}  // namespace

std::span<const QuadricForm> quadric_forms() {
    return kForms;
}

bool follows(const TurnedQuadric& q, std::span<const SurfaceSpot> spots, double tolerance) {
    double aligned = 0;
    for (const SurfaceSpot& spot : spots) {
        const Vec3 y = q.local(spot.point), g = q.local_gradient(y);
        const double slope = norm(g);
        if (!(std::abs(q.local_value(y)) <= tolerance * slope)) return false;
        if (slope > 0) aligned += dot(g, q.turn(spot.inwards)) / slope;
    }
    return aligned >= kAligned * static_cast<double>(spots.size());
}

bool fit_form(const QuadricForm& form, std::span<const SurfaceSpot> spots, double tolerance,
              std::span<const std::array<Vec3, 3>> frames, TurnedQuadric& result) {
    const FormFit fit(form, spots, tolerance);
    for (const std::array<Vec3, 3>& frame : frames) {
        for (std::size_t i = 0; i < form.orders; ++i) {
            result = fit.run(begun_with(frame, i));
            if (follows(result, spots, tolerance)) return true;
        }
    }
    return false;
}

}  // namespace pfgeom
