// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/types.h"

#include <cstdint>

namespace carom {

/// A counter-based generator: the k-th word depends on the seed, the stream and k only, so the same seed
/// gives the same numbers on every machine, and streams can be drawn in any order. Only exactly rounded
/// operations
/// (+ - * / sqrt) are used, never a function of the C library whose last digit may differ.
class Random {
  public:
    explicit Random(std::uint64_t seed, std::uint64_t stream = 0);

    std::uint64_t bits();
    /// Uniform in [0, 1), 53 bits.
    double uniform();
    /// Uniform in [low, high).
    double uniform(double low, double high);
    /// Normal with mean 0 and standard deviation 1: G. Marsaglia, T. A. Bray, "A convenient method for
    /// generating normal variables", SIAM Review 6 (1964), the polar method; its second number is not kept.
    double gaussian();
    double gaussian(double mean, double deviation) { return mean + deviation * gaussian(); }
    /// Uniform in 0 .. count-1, without bias; count > 0.
    std::uint64_t below(std::uint64_t count);

  private:
    std::uint64_t m_key;
    std::uint64_t m_counter = 0;
};

/// A unit vector, uniform over all directions: three normal numbers (x, y, z in this order) have no
/// direction they prefer.
Vec3 uniformDirection(Random& random);

} // namespace carom
