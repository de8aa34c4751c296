// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// A long time series in bounded memory: of each interval of consecutive values only the minimum and the
// maximum and their positions are kept. An interval's length is a power of two; when there are too many
// intervals, neighbours are merged in pairs.
//
//     figure      3 1 4 1 5 9 2 6 5 3 5          stretches of 4: [1..4] [2..9] [3..5]
//
// A screen shows the same curve, as long as it has no more columns of pixels than there are stretches.

namespace carom {

/// Consecutive figures; those that are no numbers count as places only.
struct SeriesStretch {
    std::int64_t first = 0;             ///< place of the first figure
    double low = 0, high = 0;           ///< NaN where none of them is a number
    std::int64_t lowAt = 0, highAt = 0; ///< places
};

/// A figure of a curve, by its place.
struct SeriesPoint {
    std::int64_t place = 0;
    double value = 0;
};

class BoundedSeries {
  public:
    /// Twice the columns of a wide screen: half as many are left after neighbours were joined.
    static constexpr std::size_t mostStretches = 8192;

    void add(double value);
    void clear() { *this = {}; }

    bool empty() const { return m_count == 0; }
    /// Figures added; the last one stands at count() - 1.
    std::int64_t count() const { return m_count; }
    /// Figures of a stretch; the last one may have fewer.
    std::int64_t length() const { return m_length; }
    double last() const { return m_last; }
    std::span<const SeriesStretch> stretches() const { return m_stretches; }
    /// The one that a place from 0 to count() - 1 lies in.
    const SeriesStretch& at(std::int64_t place) const {
        return m_stretches[static_cast<std::size_t>(place / m_length)];
    }
    /// The curve: every figure while length() is 1; then each stretch's least and greatest in their order,
    /// and the first and last figure exactly.
    std::vector<SeriesPoint> points() const;
    /// Memory [bytes].
    std::size_t bytes() const { return m_stretches.capacity() * sizeof(SeriesStretch); }

  private:
    void joinNeighbours();

    std::vector<SeriesStretch> m_stretches;
    std::int64_t m_count = 0, m_length = 1;
    double m_first = 0, m_last = 0;
};

} // namespace carom
