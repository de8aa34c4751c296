// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/csv.h"
#include "core/study/convergence.h"

#include <string>
#include <string_view>

namespace carom {

/// The report as text: the reference solution, a table by family with its order of convergence, averages of a
/// crowd beyond the horizon, and the recommendation.
std::string summaryOf(const AccuracyStudy& study);

/// A line for each of several scenes' studies; names are `width` characters wide.
std::string comparisonHeading(std::size_t width);
std::string comparisonLine(const std::string& scene, std::size_t width, const AccuracyStudy& study);

/// The same as CSV: scene, seconds, measure, reference, distance_from_front, settings, left_out,
/// studied_s, duration_s, sentence.
std::string_view comparisonColumns();
void addComparison(const std::string& scene, const AccuracyStudy& study, CsvTable& table);

} // namespace carom
