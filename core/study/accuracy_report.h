// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/csv.h"
#include "core/study/convergence.h"

#include <string>
#include <string_view>

namespace carom {

/// For people: what errors are measured against, a table by family with its order, what a crowd does beyond
/// the horizon, the recommendation.
std::string summaryOf(const AccuracyStudy& study);

/// Studies of several scenes: a line each, `width` columns for the names.
std::string comparisonHeading(std::size_t width);
std::string comparisonLine(const std::string& scene, std::size_t width, const AccuracyStudy& study);

/// The same as a file: scene, seconds, measure, reference, distance_from_front, settings, left_out,
/// studied_s, duration_s, sentence.
std::string_view comparisonColumns();
void addComparison(const std::string& scene, const AccuracyStudy& study, CsvTable& table);

} // namespace carom
