// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/bounded_series.h"

#include <cmath>

namespace carom {
namespace {

/// Of two stretches the second of which follows the first.
SeriesStretch joined(const SeriesStretch& a, const SeriesStretch& b) {
    SeriesStretch both = a;
    if (!(b.low >= a.low) && !std::isnan(b.low)) { // also where the first has no number
        both.low = b.low;
        both.lowAt = b.lowAt;
    }
    if (!(b.high <= a.high) && !std::isnan(b.high)) {
        both.high = b.high;
        both.highAt = b.highAt;
    }
    return both;
}

} // namespace

void BoundedSeries::add(double value) {
    if (m_count == 0) m_first = value;
    m_last = value;
    const SeriesStretch one{m_count, value, value, m_count, m_count};
    if (m_count % m_length != 0) {
        m_stretches.back() = joined(m_stretches.back(), one);
    } else {
        if (m_stretches.size() == mostStretches) joinNeighbours();
        m_stretches.push_back(one);
    }
    ++m_count;
}

/// There is an even number of whole stretches.
void BoundedSeries::joinNeighbours() {
    for (std::size_t i = 0; i + 1 < m_stretches.size(); i += 2)
        m_stretches[i / 2] = joined(m_stretches[i], m_stretches[i + 1]);
    m_stretches.resize(m_stretches.size() / 2);
    m_length *= 2;
}

std::vector<SeriesPoint> BoundedSeries::points() const {
    std::vector<SeriesPoint> points;
    if (empty()) return points;
    const auto add = [&points](std::int64_t place, double value) {
        if (points.empty() || points.back().place < place) points.push_back({place, value});
    };
    add(0, m_first);
    for (const SeriesStretch& stretch : m_stretches) {
        const bool rises = stretch.lowAt <= stretch.highAt;
        add(rises ? stretch.lowAt : stretch.highAt, rises ? stretch.low : stretch.high);
        add(rises ? stretch.highAt : stretch.lowAt, rises ? stretch.high : stretch.low);
    }
    add(m_count - 1, m_last);
    return points;
}

} // namespace carom
