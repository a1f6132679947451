#include "pfgeom/base/reproducible.h"

#include <cmath>

namespace pfgeom {

double reproducible_log2(double x) {
    int exponent = 0;
    double m = std::frexp(x, &exponent);  // [1/2, 1), exact
    if (m < 0.70710678118654752) {
        m *= 2;
        --exponent;
    }
    // ln m = 2 artanh(t), t = (m-1)/(m+1), |t| < 0.172: 10 terms of the series reach 1e-17.
    const double t = (m - 1) / (m + 1), t2 = t * t;
    double sum = 0;
    for (int k = 21; k >= 1; k -= 2) sum = sum * t2 + 1.0 / k;
    return exponent + 2 * t * sum * 1.4426950408889634074;
}

}  // namespace pfgeom
