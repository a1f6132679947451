// Generalised winding numbers: solid angles of near triangles, dipoles for far clusters.
// Sources: Jacobson, Kavan, Sorkine-Hornung, "Robust inside-outside segmentation using generalized winding
// numbers", 2013; van Oosterom, Strackee, "The solid angle of a plane triangle", 1983; Barill, Dickson,
// Schmidt, Levin, Jacobson, "Fast winding numbers for soups and clouds", 2018 (first order only).
#include "pfgeom/mesh/angle.h"
#include "pfgeom/mesh/bvh.h"
#include "pfgeom/mesh/bvh_stack.h"

namespace pfgeom {
namespace {

constexpr double kPi = 3.14159265358979323846;

// Sums over the triangles of a cluster.
struct Cluster {
    double area = 0;
    Vec3 area_centre, area_normal;  // centre times area; normal of length area

    void add(const Cluster& other) {
        area += other.area;
        area_centre += other.area_centre;
        area_normal += other.area_normal;
    }
};

Cluster cluster_of(const Vec3* t) {
    const Vec3 n = cross(t[1] - t[0], t[2] - t[0]) * 0.5;
    const double area = norm(n);
    return {area, (t[0] + t[1] + t[2]) * (area / 3), n};
}

BvhDipole dipole_of(const Cluster& cluster, const BvhNode& node, int k) {
    const Vec3 lo{node.lo[0][k], node.lo[1][k], node.lo[2][k]},
        hi{node.hi[0][k], node.hi[1][k], node.hi[2][k]};
    const Vec3 centre = cluster.area > 0 ? cluster.area_centre / cluster.area : lo;
    return {centre, cluster.area_normal, norm(max(hi - centre, centre - lo))};
}

// Of a small patch, as if all its area were at its centre.
double solid_angle(const BvhDipole& dipole, const Vec3& offset, double squared_distance) {
    return dot(dipole.area_normal, offset) / (squared_distance * std::sqrt(squared_distance));
}

}  // namespace

std::vector<std::array<BvhDipole, 4>> bvh_dipoles(const std::vector<BvhNode>& nodes,
                                                  const std::vector<Vec3>& corners) {
    std::vector<std::array<BvhDipole, 4>> dipoles(nodes.size());
    std::vector<Cluster> clusters(nodes.size());
    for (std::size_t i = nodes.size(); i-- > 0;) {  // children come after their parents
        const BvhNode& node = nodes[i];
        for (int k = 0; k < 4; ++k) {
            if (node.lo[0][k] > node.hi[0][k]) continue;  // unused
            Cluster cluster;
            for (std::int32_t t = node.first[k]; t < node.first[k] + node.count[k]; ++t) {
                cluster.add(cluster_of(&corners[3 * static_cast<std::size_t>(t)]));
            }
            if (node.count[k] == 0) cluster = clusters[node.first[k]];
            dipoles[i][k] = dipole_of(cluster, node, k);
            clusters[i].add(cluster);
        }
    }
    return dipoles;
}

double Bvh::solid_angle(const Vec3& p, std::int32_t triangle) const {
    const Vec3* t = &corners_[3 * static_cast<std::size_t>(triangle)];
    const Vec3 a = t[0] - p, b = t[1] - p, c = t[2] - p;
    const double la = norm(a), lb = norm(b), lc = norm(c);
    const double volume = dot(a, cross(b, c));
    return 2 * reproducible_atan2(volume, la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

double Bvh::winding_number(const Vec3& p, double accuracy) const {
    if (nodes_.empty()) return 0;
    double sum = 0;
    BvhStack stack;
    stack.push({0, 0, 0});
    while (!stack.empty()) {
        const std::int32_t index = stack.pop().first;
        const BvhNode& node = nodes_[index];
        for (int k = 0; k < 4; ++k) {
            if (node.lo[0][k] > node.hi[0][k]) continue;  // unused
            const BvhDipole& dipole = dipoles_[index][k];
            const Vec3 offset = dipole.centre - p;
            const double far = accuracy * dipole.radius, d = squared_norm(offset);
            if (d > far * far) {
                sum += pfgeom::solid_angle(dipole, offset, d);
            } else if (node.count[k] == 0) {
                stack.push({0, node.first[k], 0});
            }
            if (d > far * far) continue;
            for (std::int32_t t = node.first[k]; t < node.first[k] + node.count[k]; ++t)
                sum += solid_angle(p, t);
        }
    }
    return sum / (4 * kPi);
}

double Bvh::signed_distance(const Vec3& p) const {
    const double distance = std::sqrt(closest(p).squared_distance);
    return winding_number(p) > 0.5 ? distance : -distance;
}

}  // namespace pfgeom
