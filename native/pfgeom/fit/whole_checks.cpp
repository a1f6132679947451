#include "pfgeom/fit/whole_checks.h"

#include <algorithm>
#include <cmath>

namespace pfgeom {
namespace {

constexpr double kRoomToRound = 0.02;  // of the limit, beyond what least squares keep
constexpr double kLeastSlope = 1e-9;

PowerSums weighted(const Region& region, std::span<const Spot> spots, double tolerance) {
    PowerSums sums = region.sums;
    const double face = region.area / static_cast<double>(region.faces.size());
    for (const Spot& spot : spots) {
        const Vec3 outwards = normalized(-region.quadric.gradient(spot.point));
        sums.add(spot.point, outwards, face / (spot.share * spot.share));
    }
    const double part = region.area / static_cast<double>(std::max<std::size_t>(region.hidden.size(), 1));
    for (const HiddenPoint& h : region.hidden) {
        const double weight = tolerance / h.room;
        sums.add(h.point, h.normal, part * weight * weight);
    }
    return sums;
}

// By sides, since an ellipsoid may have tips: there gradients are small, and first-order distances too.
void add_sides(const Quadric& q, const Spot& spot, double limit, std::vector<CheckPoint>& points) {
    const Vec3 &p = spot.point, g = q.gradient(p);
    const double slope = std::max(norm(g), kLeastSlope);
    const double own = std::abs(q.value(p)) / slope + kRoomToRound * limit;
    const Vec3 in = g * (std::max(spot.share * limit, std::min(own, limit)) / slope);
    if (q.value(p + in) >= 0) points.push_back({p + in, 0, CheckPoint::Kind::positive});
    if (q.value(p - in) < 0) points.push_back({p - in, 0, CheckPoint::Kind::negative});
}

}  // namespace

RegionChecks checks_of_whole(const Region& region, std::span<const Spot> spots, double tolerance,
                             double share) {
    RegionChecks checks;
    checks.sums = weighted(region, spots, tolerance);
    const Quadric q = checks.sums.system().solve(tolerance * tolerance);
    for (const Spot& spot : spots) add_sides(q, spot, share * tolerance, checks.points);
    for (const HiddenPoint& h : region.hidden) {
        const Vec3 p = h.point + h.normal * ((h.inside ? share : -share) * h.room);
        checks.points.push_back({p, 0, h.inside ? CheckPoint::Kind::negative : CheckPoint::Kind::positive});
    }
    return checks;
}

}  // namespace pfgeom
