// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/benchmark.h"

#include <optional>
#include <string>

// The results of a benchmark as text and as CSV.

namespace carom {

/// The points of one scene and one algorithm, ascending by number.
std::vector<BenchmarkPoint> pointsOf(const Benchmark& benchmark, const GeneratorRow& scene,
                                     const BroadphaseRow& algorithm);

/// How many bodies an algorithm simulates at 30 frames a second (the reference's real time), between measured
/// numbers by a power law.
struct RealTimeReach {
    double n = 0;
    bool measured =
        false; ///< false: the largest number measured, `n`, is still in real time; the limit is higher
};
/// Nothing if even the smallest number is too slow, or if nothing was measured.
std::optional<RealTimeReach> realTimeReach(const std::vector<BenchmarkPoint>& points);

/// Median time of a frame [ms] = constant + linear N + quadratic N², by least squares; as in the reference's
/// figure 4.15. Needs three points.
struct QuadraticFit {
    double constant = 0, linear = 0, quadratic = 0;
    double determination = 0; ///< R²: the share of the variance it explains
};
std::optional<QuadraticFit> fitQuadratic(const std::vector<BenchmarkPoint>& points);

/// The exponent of a power law through the median times from `from` bodies on. Needs two points there.
std::optional<double> growthExponent(const std::vector<BenchmarkPoint>& points, std::int64_t from = 1000);

/// `scene,n,bodies,broadphase,frames,first_ms,mean_ms,median_ms,p95_ms,max_ms,frame_rate,broadphase_ms,
/// narrowphase_ms,pairs,tested,contacts,swaps,memory_bytes`, a row a point. A scene of the user's is called
/// `scene`.
std::string pointsAsCsv(const Benchmark& benchmark);
/// `scene,n,broadphase,frame,time,simulate_ms,broadphase_ms,narrowphase_ms,pairs,tested,contacts,swaps`, a
/// row a frame.
std::string tracesAsCsv(const Benchmark& benchmark);
/// The report as text: tables of times, then sentences.
std::string summaryOf(const Benchmark& benchmark);

} // namespace carom
