// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/statistics.h"

#include <cstdint>
#include <vector>

namespace carom {

/// The summary of a series of any length in memory that does not grow with it. Mean, maximum and total are
/// exact. So are percentiles of up to 65,536 values; those of more are within 1 %, as long as they lie
/// between 1e-6 and 1e10.
class RunningSummary {
  public:
    void add(double value);

    std::uint64_t count() const { return m_count; }
    /// As summarise() says it.
    Summary summary() const;

  private:
    void sort(double value);
    double valueOfRank(std::uint64_t rank) const;

    std::uint64_t m_count = 0;
    double m_total = 0, m_maximum = 0;
    std::vector<double> m_values;      ///< all of them, while they are few
    std::vector<std::uint64_t> m_bins; ///< otherwise a histogram whose bins are 2 % wide
};

} // namespace carom
