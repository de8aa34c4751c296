// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/running_summary.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

// Values that are kept exactly: half a megabyte, at twice a whole one.
constexpr std::size_t mostExact = 65'536;
// Ends of the bins, and the width of a bin as a ratio: percentiles are good to half of 2 %, at 1.04 to half
// of 4 %.
constexpr double lowest = 1e-6, highest = 1e10;
constexpr double width = 1.02;

const std::size_t bins = static_cast<std::size_t>(std::ceil(std::log(highest / lowest) / std::log(width)));

} // namespace

void RunningSummary::add(double value) {
    m_maximum = m_count == 0 ? value : std::max(m_maximum, value);
    m_total += value;
    ++m_count;
    if (!m_bins.empty()) {
        sort(value);
        return;
    }
    m_values.push_back(value);
    if (m_values.size() <= mostExact) return;
    m_bins.assign(bins, 0);
    for (const double old : m_values) sort(old);
    m_values = {};
}

void RunningSummary::sort(double value) {
    const double place = std::log(std::max(value, lowest) / lowest) / std::log(width);
    ++m_bins[std::min(static_cast<std::size_t>(place), bins - 1)];
}

Summary RunningSummary::summary() const {
    if (m_bins.empty()) return summarise(m_values);
    const auto share = [this](double part) {
        return valueOfRank(static_cast<std::uint64_t>(std::ceil(part * static_cast<double>(m_count))));
    };
    return {.mean = m_total / static_cast<double>(m_count),
            .median = 0.5 * (valueOfRank((m_count + 1) / 2) + valueOfRank(m_count / 2 + 1)),
            .p95 = share(0.95),
            .p99 = share(0.99),
            .maximum = m_maximum,
            .total = m_total};
}

/// Counted from 1; the middle of its bin, but never beyond the largest value.
double RunningSummary::valueOfRank(std::uint64_t rank) const {
    std::uint64_t below = 0;
    for (std::size_t bin = 0; bin < m_bins.size(); ++bin) {
        below += m_bins[bin];
        if (below >= rank)
            return std::min(m_maximum, lowest * std::pow(width, static_cast<double>(bin) + 0.5));
    }
    return m_maximum;
}

} // namespace carom
