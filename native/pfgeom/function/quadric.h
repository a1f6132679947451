// Q(x,y,z) = A x² + B y² + C z² + D xy + E xz + F yz + G x + H y + I z + K (paper eq. 1, 9).
#pragma once

#include "pfgeom/base/vec.h"

#include <array>

namespace pfgeom {

struct Quadric {
    std::array<double, 10> c{};  ///< A B C D E F G H I K

    double value(const Vec3& p) const {
        return (c[0] * p.x * p.x + c[1] * p.y * p.y + c[2] * p.z * p.z) +
               (c[3] * p.x * p.y + c[4] * p.x * p.z + c[5] * p.y * p.z) +
               (c[6] * p.x + c[7] * p.y + c[8] * p.z) + c[9];
    }
    Vec3 gradient(const Vec3& p) const {
        return {2 * c[0] * p.x + c[3] * p.y + c[4] * p.z + c[6],
                c[3] * p.x + 2 * c[1] * p.y + c[5] * p.z + c[7],
                c[4] * p.x + c[5] * p.y + 2 * c[2] * p.z + c[8]};
    }
    friend bool operator==(const Quadric&, const Quadric&) = default;
};

}  // namespace pfgeom
