// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <span>

// Tests of hypotheses: the probability that chance alone makes values differ as much as they do.

namespace carom {

/// The largest distance between the steps of a sample, ascending, and a distribution: Kolmogorov's D.
double kolmogorovDistance(std::span<const double> sorted, const std::function<double(double)>& distribution);

/// The probability that a sample of `count` from the distribution itself is further away than `distance`: the
/// limit for large samples (N. Smirnov, "Table for estimating the goodness of fit of empirical
/// distributions", 1948) at (√n + 0.12 + 0.11/√n) D (M. A. Stephens, 1970), good to a hundredth from n = 5
/// on.
double kolmogorovTail(double distance, std::size_t count);

/// The probability that χ² with so many degrees of freedom exceeds `value`: Q(ν/2, χ²/2), the incomplete
/// gamma function, by its series or continued fraction (W. H. Press et al., "Numerical recipes", 3rd ed.
/// 2007, 6.2). To 1e-12.
double chiSquareTail(double value, double degrees);

/// What Student's t with so many degrees of freedom exceeds in size once in twenty times: the factor from a
/// standard error to a 95 % interval. G. W. Hill's expansion (M. Abramowitz, I. A. Stegun, "Handbook of
/// mathematical functions", 1964, 26.7.5); to 1e-3 from 4 degrees on.
double studentFactor(double degrees);

/// The share of molecules slower than x = v/√(kT/m): erf(x/√2) − √(2/π) x exp(−x²/2) (J. C. Maxwell, 1860).
double maxwellShare(double x);
/// Its density, √(2/π) x² exp(−x²/2).
double maxwellDensity(double x);

} // namespace carom
