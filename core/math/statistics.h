// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace carom {

/// Summary statistics of a series of measurements. All zero for an empty series.
struct Summary {
    double mean = 0, median = 0, p95 = 0, p99 = 0, maximum = 0, total = 0;
};

/// Percentiles are the nearest rank: the smallest value that at least that share of the series does not
/// exceed; the median of an even count is the mean of the middle two.
Summary summarise(std::span<const double> values);

/// Where a figure lies, at 95 %.
struct Interval {
    double low = 0, high = 0;

    bool overlaps(const Interval& other) const { return low <= other.high && other.low <= high; }
};

/// The confidence interval of the median of a time series, such as frame times. Neighbouring values are
/// correlated, so the series is divided into forty batches of equal length, or fewer of at least three
/// values, and the order statistics of the batch medians give the interval without an assumption on their
/// distribution (W. J. Conover, "Practical Nonparametric Statistics", 1999, section 3.2). Nothing for a
/// series of fewer than six batches, which do not determine an interval at 95 %.
std::optional<Interval> medianInterval(std::span<const double> values);

/// Least-squares polynomial y = c0 + c1 x + ... of the given degree; coefficients lowest first.
/// Needs more than `degree` different x.
std::vector<double> fitPolynomial(std::span<const double> x, std::span<const double> y, int degree);

} // namespace carom
