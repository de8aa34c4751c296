// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/accuracy.h"
#include "core/study/stability_report.h"

#include <string>
#include <string_view>
#include <vector>

// Writes the points of an accuracy study as CSV, and reads them.

namespace carom {

/// A row for each point that has been run; without a reference solution it has no errors. Lengths are
/// relative to the scene's size, times and instructions are per simulated second; cells of what was not
/// measured are empty.
///
///     method, integrator, substeps, tolerance, preset, engine, default, status, reason
///     measure, error                        of the diagram
///     position, position_rms, attitude      errors; the last in rad
///     energy_drift, energy_swing, energy_worst, energy_gain, energy_off, momentum
///     penetration                           by half the thinnest mobile body
///     residual_m_s, residual, cone_violation
///     end_height, end_centre, end_rest_time, end_work   what is left at the end, deviations
///     impacts_true, impacts, impacts_matched, impact_time_s
///     copies, and of a crowd speeds, pressure and free_time, each as _lower, median, _upper
///     cost_ms, cost_min_ms, cost_max_ms, instructions
///     runs_ms                               of all runs, between semicolons
///     pareto, reference, reference_error, horizon_s, studied_s, duration_s
///                                           the horizon of half of the bodies; studied of what was asked for
///     scene, command, version, machine      the first a hash of its text
std::string pointsAsCsv(const AccuracyStudy& study, std::string_view sceneHash, const StudyOrigin& origin);

/// The conditions under which such a text was measured.
struct AccuracyOrigin {
    std::string scene;   ///< a hash of its text
    double duration = 0; ///< [s]
    std::string version; ///< of the program
};

/// The points of such a text, for a study that continues an interrupted one.
struct ReadPoints {
    KnownPoints known;
    /// The reason why no study can continue from them, as "line 3 cannot be read"; then the text must not be
    /// overwritten. Empty: one can.
    std::string objection;
};
ReadPoints pointsFromCsv(std::string_view csv, const AccuracyOrigin& origin);

/// A hash of a scene's text, as decimal digits.
std::string hashOfScene(std::string_view text);

} // namespace carom
