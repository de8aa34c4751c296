// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/random.h"

#include "core/base/assert.h"
#include "core/base/hash.h"

#include <cmath>

namespace carom {
namespace {

// ln x for x in (0, 1]: x = m 2^e with m in [sqrt(1/2), sqrt(2)), ln m = 2 artanh z with z = (m-1)/(m+1),
// |z| <= .172, by its series; the first term left out is below 1e-17.
double portableLog(double x) {
    constexpr double ln2 = 0.69314718055994530942;
    constexpr double rootHalf = 0.70710678118654752440;
    int exponent = 0;
    double m = std::frexp(x, &exponent);
    if (m < rootHalf) {
        m *= 2;
        --exponent;
    }
    const double z = (m - 1) / (m + 1);
    const double zz = z * z;
    double series = 0;
    for (int k = 21; k >= 1; k -= 2) series = series * zz + 1.0 / k;
    return 2 * z * series + exponent * ln2;
}

} // namespace

Random::Random(std::uint64_t seed, std::uint64_t stream)
    : m_key(Hash64::mix(seed + 0x9E3779B97F4A7C15ULL) ^
            Hash64::mix(Hash64::mix(stream) + 0xD1B54A32D192ED03ULL)) {}

std::uint64_t Random::bits() {
    constexpr std::uint64_t weyl = 0x9E3779B97F4A7C15ULL; // odd, so the counter visits every word
    return Hash64::mix(m_key + weyl * ++m_counter);
}

double Random::uniform() { return static_cast<double>(bits() >> 11U) * 0x1p-53; }

double Random::uniform(double low, double high) { return low + (high - low) * uniform(); }

double Random::gaussian() {
    for (;;) {
        const double u = 2 * uniform() - 1;
        const double v = 2 * uniform() - 1;
        const double s = u * u + v * v;
        if (s > 0 && s < 1) return u * std::sqrt(-2 * portableLog(s) / s);
    }
}

std::uint64_t Random::below(std::uint64_t count) {
    ASSERT(count > 0);
    const std::uint64_t rejectBelow = (0 - count) % count; // 2^64 mod count
    for (;;) {
        const std::uint64_t word = bits();
        if (word >= rejectBelow) return word % count;
    }
}

Vec3 uniformDirection(Random& random) {
    Vec3 direction;
    do
        for (double& x : direction) x = random.gaussian();
    while (!(direction.norm() > 0));
    return direction.normalized();
}

} // namespace carom
