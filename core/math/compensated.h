// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/types.h"

// Sums and products with their rounding errors, for positions that must be known more precisely than one
// double allows: a gap of a nanometre at a height of a metre has seven of sixteen digits left. A position is
// then x + r, a coordinate and its remainder, and changes are added to both.
//
//     a + b = s + e     D. Knuth, "The art of computer programming" 2, 1969, 4.2.2, theorem B
//     a · b = p + e     T. Dekker, "A floating-point technique for extending the available precision",
//                       Numerische Mathematik 18, 1971
//     x·y               in about twice the digits: T. Ogita, S. Rump, S. Oishi, "Accurate sum and dot
//                       product", SIAM Journal on Scientific Computing 26, 2005, algorithm Dot2
//
// Limits: no number may exceed 1e300, where Dekker's splitting overflows. Contraction must be off.

namespace carom {

/// A number, or a vector by its coordinates, and its rounding error.
template<class Value>
struct WithRest {
    Value value, rest;
};

inline WithRest<double> exactSum(double a, double b) {
    const double value = a + b;
    const double part = value - a;
    return {value, (a - (value - part)) + (b - part)};
}
inline WithRest<Vec3> exactSum(const Vec3& a, const Vec3& b) {
    const Vec3 value = a + b;
    const Vec3 part = value - a;
    return {value, (a - (value - part)) + (b - part)};
}

inline WithRest<double> exactProduct(double a, double b) {
    constexpr double splitter = 134217729; // 2^27 + 1: the upper half of the digits
    const double wideA = splitter * a, wideB = splitter * b;
    const double highA = wideA - (wideA - a), highB = wideB - (wideB - b);
    const double lowA = a - highA, lowB = b - highB;
    const double value = a * b;
    return {value, ((highA * highB - value) + highA * lowB + lowA * highB) + lowA * lowB};
}

/// Moves the place value + rest by `change`.
inline void moveBy(const Vec3& change, Vec3& value, Vec3& rest) {
    const WithRest<Vec3> sum = exactSum(value, change + rest);
    value = sum.value;
    rest = sum.rest;
}

/// How far the surface of a ball of this radius [m] about value + rest [m] is above the plane normal·x =
/// offset [m], as exactly as these numbers say it.
inline double exactGap(const Vec3& normal, double offset, double radius, const Vec3& value,
                       const Vec3& rest) {
    double sum = 0, left = normal.dot(rest);
    const auto add = [&](double term) {
        const WithRest<double> next = exactSum(sum, term);
        sum = next.value;
        left += next.rest;
    };
    for (int axis = 0; axis < 3; ++axis) {
        const WithRest<double> product = exactProduct(normal[axis], value[axis]);
        add(product.value);
        left += product.rest;
    }
    add(-offset);
    add(-radius);
    return sum + left;
}

} // namespace carom
