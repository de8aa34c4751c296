// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/generators/portable.h"

#include <cmath>
#include <numbers>

namespace carom {
namespace {

/// Terms of the series: at π/2 the first one left out is 1e-18 of the sum.
constexpr int terms = 12;

// Adds term, −term x²/((k+1)(k+2)), ... from the given first term of power k, smallest first.
double alternatingSeries(double term, int power, double x) {
    double all[terms];
    for (double& value : all) {
        value = term;
        term *= -(x * x) / ((power + 1) * (power + 2));
        power += 2;
    }
    double sum = 0;
    for (int i = terms; i-- > 0;) sum += all[i];
    return sum;
}

double radiansOf(double degrees) { return degrees * (std::numbers::pi / 180); }

} // namespace

double portableCubeRoot(double x) {
    int exponent = 0;
    std::frexp(x, &exponent);
    double root = std::ldexp(1.0, exponent / 3); // within a factor 2^(4/3) of the root
    for (int i = 0; i < 12; ++i) root = (2 * root + x / (root * root)) / 3;
    return root;
}

double portableSine(double degrees) {
    const double x = radiansOf(degrees);
    return alternatingSeries(x, 1, x);
}

double portableCosine(double degrees) { return alternatingSeries(1, 0, radiansOf(degrees)); }

} // namespace carom
