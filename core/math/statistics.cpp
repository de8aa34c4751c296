// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/statistics.h"

#include "core/base/assert.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

double nearestRank(const std::vector<double>& sorted, double share) {
    const double rank = std::ceil(share * static_cast<double>(sorted.size()));
    return sorted[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

} // namespace

Summary summarise(std::span<const double> values) {
    if (values.empty()) return {};
    std::vector<double> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    Summary summary;
    for (const double value : values) summary.total += value;
    const std::size_t half = sorted.size() / 2;
    summary.mean = summary.total / static_cast<double>(sorted.size());
    summary.median = sorted.size() % 2 == 1 ? sorted[half] : 0.5 * (sorted[half - 1] + sorted[half]);
    summary.p95 = nearestRank(sorted, 0.95);
    summary.p99 = nearestRank(sorted, 0.99);
    summary.maximum = sorted.back();
    return summary;
}

std::optional<Interval> medianInterval(std::span<const double> values) {
    // Stretches, and values in each. Of fewer than six medians no two enclose the true one with 95 %; the
    // median of fewer than three values is no better than a value. At most forty, so that stretches are long:
    // neighbouring values depend on each other, the medians of long stretches hardly do.
    constexpr std::size_t mostStretches = 40, leastStretches = 6, leastLength = 3;
    constexpr double quantile = 1.959964; // of the normal distribution, for 95 %
    const std::size_t length = std::max(leastLength, (values.size() + mostStretches - 1) / mostStretches);
    const std::size_t count = values.size() / length;
    if (count < leastStretches) return std::nullopt;
    std::vector<double> medians;
    for (std::size_t i = 0; i < count; ++i)
        medians.push_back(summarise(values.subspan(i * length, length)).median);
    std::sort(medians.begin(), medians.end());
    // How many of the medians lie below the true one is binomial with p = 1/2.
    const double n = static_cast<double>(count), half = quantile * std::sqrt(n) / 2;
    const double below = std::max(0.0, std::floor(n / 2 - half));
    const std::size_t first = static_cast<std::size_t>(below);
    return Interval{medians[first], medians[count - 1 - first]};
}

std::vector<double> fitPolynomial(std::span<const double> x, std::span<const double> y, int degree) {
    ASSERT(x.size() == y.size() && degree >= 0);
    const Eigen::Index rows = static_cast<Eigen::Index>(x.size());
    Eigen::MatrixXd powers(rows, degree + 1);
    Eigen::VectorXd values(rows);
    for (Eigen::Index i = 0; i < rows; ++i) {
        double power = 1;
        for (int k = 0; k <= degree; ++k) {
            powers(i, k) = power;
            power *= x[static_cast<std::size_t>(i)];
        }
        values(i) = y[static_cast<std::size_t>(i)];
    }
    const Eigen::VectorXd fitted = powers.colPivHouseholderQr().solve(values);
    return {fitted.data(), fitted.data() + fitted.size()};
}

} // namespace carom
