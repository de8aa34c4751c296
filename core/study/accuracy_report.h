// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/convergence.h"
#include "core/study/stability_report.h"

#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// For people: what errors are measured against, a table by family with its order, the recommendation.
std::string summaryOf(const AccuracyStudy& study);

/// `method,integrator,substeps,tolerance,default,status,reason,position,position_rms,attitude,energy_drift,
/// energy_swing,energy_worst,momentum,penetration,cost_ms,cost_min_ms,cost_max_ms,runs_ms,pareto,reference,
/// reference_error,horizon_s,duration_s,scene,command,version,machine`, a row a point. `runs_ms` has the
/// times of the runs between semicolons; `scene` is a hash of its text.
std::string pointsAsCsv(const AccuracyStudy& study, std::string_view sceneHash, const StudyOrigin& origin);

/// The points of such a text, for a study that goes on where one was interrupted; none where it is of another
/// scene or another duration. Lines that cannot be read are left out.
std::vector<AccuracyPoint> pointsFromCsv(std::string_view csv, std::string_view sceneHash, double duration);

/// A hash of a scene's text, as decimal digits.
std::string hashOfScene(std::string_view text);

} // namespace carom
