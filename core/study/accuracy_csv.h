// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/accuracy.h"
#include "core/study/stability_report.h"

#include <string>
#include <string_view>
#include <vector>

// The points of an accuracy study as a file, and back.

namespace carom {

/// A row a point. Lengths are relative to the scene's size, times and instructions for a simulated second;
/// what was not looked at is empty.
///
///     method, integrator, substeps, tolerance, default, status, reason
///     position, position_rms, attitude      errors; the last in rad
///     energy_drift, energy_swing, energy_worst, momentum, penetration, residual_m_s,
///     cone_violation
///     impacts_true, impacts, impacts_matched, impact_time_s
///     copies, and of a crowd speeds, pressure and free_time, each as _lower, median, _upper
///     cost_ms, cost_min_ms, cost_max_ms, instructions
///     runs_ms                               of all runs, between semicolons
///     pareto, reference, reference_error, horizon_s, duration_s
///     scene, command, version, machine      the first a hash of its text
std::string pointsAsCsv(const AccuracyStudy& study, std::string_view sceneHash, const StudyOrigin& origin);

/// The points of such a text, for a study that goes on where one was interrupted; none where it is of another
/// scene or another duration. Lines that cannot be read are left out.
std::vector<AccuracyPoint> pointsFromCsv(std::string_view csv, std::string_view sceneHash, double duration);

/// A hash of a scene's text, as decimal digits.
std::string hashOfScene(std::string_view text);

} // namespace carom
