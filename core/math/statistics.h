// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

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

/// Least-squares polynomial y = c0 + c1 x + ... of the given degree; coefficients lowest first.
/// Needs more than `degree` different x.
std::vector<double> fitPolynomial(std::span<const double> x, std::span<const double> y, int degree);

} // namespace carom
