// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/distributions.h"

#include "core/base/assert.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace carom {
namespace {

/// Both sums need about 9 √a terms: so many are enough up to a = 1e6, half of them to a quarter of that.
constexpr int mostTerms = 10'000;
/// A term below this part of the sum does not change a double.
constexpr double precision = 1e-16;

const double sqrtTwoOverPi = std::sqrt(2 / std::numbers::pi);

/// x^a e^−x / Γ(a).
double gammaFactor(double a, double x) { return std::exp(a * std::log(x) - x - std::lgamma(a)); }

/// P(a, x) for x < a + 1: Σ x^k / (a (a+1) ... (a+k)).
double lowerBySeries(double a, double x) {
    double term = 1 / a, sum = term;
    for (int k = 1; k < mostTerms && term > precision * sum; ++k) {
        term *= x / (a + k);
        sum += term;
    }
    return gammaFactor(a, x) * sum;
}

/// Q(a, x) for x > a + 1: the continued fraction 1/(x+1−a− 1(1−a)/(x+3−a− ...)), by W. J. Lentz's method.
double upperByFraction(double a, double x) {
    constexpr double tiny = std::numeric_limits<double>::min() / precision;
    double b = x + 1 - a, c = 1 / tiny, d = 1 / b, value = d;
    for (int k = 1; k < mostTerms; ++k) {
        const double numerator = -k * (k - a);
        b += 2;
        d = numerator * d + b;
        if (std::abs(d) < tiny) d = tiny;
        c = b + numerator / c;
        if (std::abs(c) < tiny) c = tiny;
        d = 1 / d;
        const double factor = d * c;
        value *= factor;
        if (std::abs(factor - 1) <= precision) break;
    }
    return gammaFactor(a, x) * value;
}

} // namespace

double kolmogorovDistance(std::span<const double> sorted, const std::function<double(double)>& distribution) {
    ASSERT(std::is_sorted(sorted.begin(), sorted.end()));
    const double count = static_cast<double>(sorted.size());
    double distance = 0;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        const double share = distribution(sorted[i]);
        distance = std::max(
            {distance, share - static_cast<double>(i) / count, static_cast<double>(i + 1) / count - share});
    }
    return distance;
}

double kolmogorovTail(double distance, std::size_t count) {
    const double root = std::sqrt(static_cast<double>(count));
    const double x = (root + 0.12 + 0.11 / root) * distance;
    // Two forms of one theta function; each needs a few terms where it is used.
    if (x < 1.18) {
        if (x < 0.03) return 1; // exp(−1300) less
        const double y = std::exp(-std::numbers::pi * std::numbers::pi / (8 * x * x));
        double sum = 0;
        for (int k = 1; k <= 9; k += 2) sum += std::pow(y, k * k);
        return 1 - std::sqrt(2 * std::numbers::pi) / x * sum;
    }
    double sum = 0;
    for (int k = 1; k <= 6; ++k) sum += (k % 2 == 1 ? 2 : -2) * std::exp(-2 * k * k * x * x);
    return sum;
}

double chiSquareTail(double value, double degrees) {
    ASSERT(degrees > 0);
    if (value <= 0) return 1;
    const double a = degrees / 2, x = value / 2;
    return x < a + 1 ? 1 - lowerBySeries(a, x) : upperByFraction(a, x);
}

double studentFactor(double degrees) {
    constexpr double z = 1.959963984540054; // the same of the normal distribution
    const double n = degrees, z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z, z9 = z7 * z * z;
    return z + (z3 + z) / (4 * n) + (5 * z5 + 16 * z3 + 3 * z) / (96 * n * n) +
           (3 * z7 + 19 * z5 + 17 * z3 - 15 * z) / (384 * n * n * n) +
           (79 * z9 + 776 * z7 + 1482 * z5 - 1920 * z3 - 945 * z) / (92160 * n * n * n * n);
}

double maxwellShare(double x) {
    if (x <= 0) return 0;
    return std::erf(x / std::numbers::sqrt2) - sqrtTwoOverPi * x * std::exp(-x * x / 2);
}

double maxwellDensity(double x) { return x <= 0 ? 0 : sqrtTwoOverPi * x * x * std::exp(-x * x / 2); }

} // namespace carom
