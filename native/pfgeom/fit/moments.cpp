#include "pfgeom/fit/moments.h"

#include <Eigen/Dense>

namespace pfgeom {
namespace {

using Vector10 = Eigen::Matrix<double, 10, 1>;
using Matrix10 = Eigen::Matrix<double, 10, 10>;

struct Monomials {
    Vector10 m;
    Eigen::Matrix<double, 10, 3> gradient;
};

Monomials monomials(const Vec3& p) {
    Monomials r;
    r.m << p.x * p.x, p.y * p.y, p.z * p.z, p.x * p.y, p.x * p.z, p.y * p.z, p.x, p.y, p.z, 1;
    r.gradient << 2 * p.x, 0, 0,  //
        0, 2 * p.y, 0,            //
        0, 0, 2 * p.z,            //
        p.y, p.x, 0,              //
        p.z, 0, p.x,              //
        0, p.z, p.y,              //
        1, 0, 0,                  //
        0, 1, 0,                  //
        0, 0, 1,                  //
        0, 0, 0;
    return r;
}

Matrix10 unpack(const std::array<double, 55>& upper) {
    Matrix10 full;
    std::size_t k = 0;
    for (int i = 0; i < 10; ++i) {
        for (int j = i; j < 10; ++j) full(i, j) = full(j, i) = upper[k++];
    }
    return full;
}

std::array<double, 55> pack(const Matrix10& full) {
    std::array<double, 55> upper{};
    std::size_t k = 0;
    for (int i = 0; i < 10; ++i) {
        for (int j = i; j < 10; ++j) upper[k++] = full(i, j);
    }
    return upper;
}

// T with m(p) = T m(p') for p = scale · p' + shift.
Matrix10 frame_change(double s, const Vec3& t) {
    Matrix10 T = Matrix10::Zero();
    const std::array<int, 3> square{0, 1, 2}, linear{6, 7, 8};
    const std::array<std::array<int, 3>, 3> mixed{{{3, 0, 1}, {4, 0, 2}, {5, 1, 2}}};
    for (int d = 0; d < 3; ++d) {
        const auto i = static_cast<std::size_t>(d);
        T(square[i], square[i]) = s * s;
        T(square[i], linear[i]) = 2 * s * t[d];
        T(square[i], 9) = t[d] * t[d];
        T(linear[i], linear[i]) = s;
        T(linear[i], 9) = t[d];
    }
    for (const auto& [row, a, b] : mixed) {
        T(row, row) = s * s;
        T(row, linear[static_cast<std::size_t>(a)]) = s * t[b];
        T(row, linear[static_cast<std::size_t>(b)]) = s * t[a];
        T(row, 9) = t[a] * t[b];
    }
    T(9, 9) = 1;
    return T;
}

}  // namespace

void Moments::add(const Vec3& point, const Vec3& normal, double weight) {
    const Monomials r = monomials(point);
    const Vector10 n = r.gradient * Eigen::Vector3d(normal.x, normal.y, normal.z);
    std::size_t k = 0;
    for (int i = 0; i < 10; ++i) {
        normals_[static_cast<std::size_t>(i)] += weight * n(i);
        for (int j = i; j < 10; ++j, ++k) {
            values_[k] += weight * (r.m(i) * r.m(j));
            gradients_[k] += weight * r.gradient.row(i).dot(r.gradient.row(j));
        }
    }
    weight_ += weight;
}

Moments& Moments::operator+=(const Moments& other) {
    for (std::size_t k = 0; k < values_.size(); ++k) {
        values_[k] += other.values_[k];
        gradients_[k] += other.gradients_[k];
    }
    for (std::size_t k = 0; k < normals_.size(); ++k) normals_[k] += other.normals_[k];
    weight_ += other.weight_;
    return *this;
}

Moments Moments::in_frame(double scale, const Vec3& shift) const {
    // p = scale p' + shift, so m(p') = inverse(T) m(p); ∇' = scale ∇.
    const Matrix10 inverse = frame_change(1 / scale, -shift / scale);
    Moments r;
    r.values_ = pack(inverse * unpack(values_) * inverse.transpose());
    r.gradients_ = pack(inverse * unpack(gradients_) * inverse.transpose() * (scale * scale));
    const Vector10 n = inverse * Eigen::Map<const Vector10>(normals_.data()) * scale;
    Eigen::Map<Vector10>(r.normals_.data()) = n;
    r.weight_ = weight_;
    return r;
}

Quadric Moments::solve(double normal_weight) const {
    const Matrix10 a = unpack(values_) + normal_weight * unpack(gradients_);
    const Vector10 b = -normal_weight * Eigen::Map<const Vector10>(normals_.data());
    const Vector10 q = a.completeOrthogonalDecomposition().solve(b);
    Quadric result;
    Eigen::Map<Vector10>(result.c.data()) = q;
    return result;
}

}  // namespace pfgeom
