// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace carom {

/// What people ask of a series of measurements. All zero for an empty series.
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

/// Of the median of a series measured one after the other, such as frame times. Neighbours are alike, so that
/// a stretch of them says hardly more than one: the series is cut into forty stretches of equal length, or
/// fewer of at least three, and the order of the stretches' medians gives the interval without any assumption
/// on how they are distributed (W. J. Conover, "Practical Nonparametric Statistics", 1999, section 3.2).
/// Nothing for a series of fewer than six stretches, which cannot say it at 95 %.
std::optional<Interval> medianInterval(std::span<const double> values);

/// Least-squares polynomial y = c0 + c1 x + ... of the given degree; coefficients lowest first.
/// Needs more than `degree` different x.
std::vector<double> fitPolynomial(std::span<const double> x, std::span<const double> y, int degree);

} // namespace carom
