#include "pfgeom/fit/face_samples.h"

#include "pfgeom/fit/collapse_mesh.h"
#include "pfgeom/fit/missed_points.h"
#include "pfgeom/mesh/bvh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pfgeom {
namespace {

// An edge or face is divided into at most this many parts along each side.
constexpr int kMostParts = 24;

int parts(double length, double spacing) {
    return static_cast<int>(std::clamp(std::ceil(length / spacing), 1.0, static_cast<double>(kMostParts)));
}

}  // namespace

FaceSamples::FaceSamples(const TriangleMesh& original, double spacing) : of_faces_(original.faces.size()) {
    sample_faces(original, spacing);
    sample_edges(original, spacing);
}

double FaceSamples::start_from(const TriangleMesh& part, const Task& task) {
    const Bvh bvh(part, task);
    double sum = 0;
    for (std::size_t f = part.faces.size(); f < of_faces_.size(); ++f) {
        std::int32_t hint = -1;
        for (; !of_faces_[f].empty(); of_faces_[f].pop_back()) {
            task.check();
            FaceSample sample = of_faces_[f].back();
            const ClosestPoint found = bvh.closest(sample.p, std::numeric_limits<double>::infinity(), hint);
            hint = found.face;
            sample.squared = found.squared_distance;
            sum += sample.weight * sample.squared;
            put(found.face, sample);
        }
    }
    of_faces_.resize(part.faces.size());
    return sum;
}

void FaceSamples::add(const Vec3& p, double weight, std::size_t face) {
    of_faces_[face].push_back({p, weight, 0, static_cast<std::int32_t>(face)});
    ++count_;
    total_weight_ += weight;
}

void FaceSamples::add(const std::vector<MissedPoint>& missed) {
    for (const MissedPoint& m : missed) put(m.face, {m.p, 0, m.squared, m.origin});
    count_ += missed.size();
}

// Vertices (once each) and the inside of each face: its centroid, or a lattice if it is large.
void FaceSamples::sample_faces(const TriangleMesh& mesh, double spacing) {
    std::vector<std::uint8_t> seen(mesh.vertices.size(), 0);
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        std::array<Vec3, 3> t;
        for (std::size_t k = 0; k < 3; ++k) t[k] = mesh.vertices[static_cast<std::size_t>(mesh.faces[f][k])];
        const double area = norm(cross(t[1] - t[0], t[2] - t[0])) / 2;
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint8_t& mark = seen[static_cast<std::size_t>(mesh.faces[f][k])];
            if (mark == 0) add(t[k], area / 4, f);
            mark = 1;
        }
        const int n =
            parts(std::sqrt(longest_squared(t)), spacing) + 2;  // without its border: one point for n = 3
        const double weight = 0.75 * area / ((n - 1) * (n - 2) / 2);
        for (int i = 1; i < n; ++i) {
            for (int j = 1; i + j < n; ++j) add((t[0] * (n - i - j) + t[1] * i + t[2] * j) / n, weight, f);
        }
    }
}

// The inside of each edge that is longer than the spacing.
void FaceSamples::sample_edges(const TriangleMesh& mesh, double spacing) {
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& a = mesh.vertices[static_cast<std::size_t>(mesh.faces[f][k])];
            const Vec3& b = mesh.vertices[static_cast<std::size_t>(mesh.faces[f][(k + 1) % 3])];
            const int n = parts(norm(b - a), spacing);
            for (int i = 1; i < n; ++i) add(a + (b - a) * (static_cast<double>(i) / n), 0, f);
        }
    }
}

}  // namespace pfgeom
