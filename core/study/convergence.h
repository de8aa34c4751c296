// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/sentence.h"
#include "core/study/accuracy.h"

#include <optional>
#include <string>
#include <vector>

// Conclusions from the points of an accuracy study.

namespace carom {

/// Points that differ in their substeps only, ascending; of any status.
struct AccuracyFamily {
    std::string name;
    std::vector<const AccuracyPoint*> points;
};
std::vector<AccuracyFamily> familiesOf(const AccuracyStudy& study);

/// The order of convergence: the median slope of log error against log substep between neighbouring points
/// whose errors are below 0.35, so that the first term dominates, and above the reference solution's
/// resolution and rounding. Nothing with fewer than two such slopes, or if they do not agree.
std::optional<double> orderOf(const AccuracyFamily& family, const AccuracyStudy& study);

/// Usable points of Carom for which no other of these has a smaller error at the same cost or less, ascending
/// by error.
std::vector<const AccuracyPoint*> paretoFront(const AccuracyStudy& study);

/// The cheapest usable point with at most this error, or null.
const AccuracyPoint* cheapestWithin(const AccuracyStudy& study, double error);

/// The cheapest usable point that is accurate enough: within the plan's target by the study's measure, and by
/// every other informative measure no worse than the scene's own setting, chance or the target. If there is
/// none, the cheapest by the study's measure alone, else the most accurate one; null without points.
const AccuracyPoint* recommended(const AccuracyStudy& study);

/// The point of the scene's own setting; null if it was not measured.
const AccuracyPoint* ownPoint(const AccuracyStudy& study);

/// Whether a setting of Carom is no worse than the scene's own by any measure, as far as the study can tell.
/// By measures that the diagram does not show, errors below the target count as none.
bool isNoWorseThanOwn(const AccuracyStudy& study, const AccuracyPoint& point);

/// The cost of the scene's own setting, divided by that of the cheapest usable setting that is no worse by
/// any measure, as far as the reference solution can tell; 1 if none is cheaper. Nothing if the scene's own
/// setting has no figures.
std::optional<double> distanceFromFront(const AccuracyStudy& study);

/// Whether nothing moves in the reference solution, within the target.
bool nothingMoves(const AccuracyStudy& study);

/// The name of a setting, with its substeps in words.
Reason saidOf(const AccuracySetting& setting);

/// "Error below 0.001 costs 0.8 ms per simulated second: microcollisions, verlet, 4 substeps; 12 times
/// cheaper than the scene's own setting ...", or "Nothing moves: every setting holds; the cheapest costs
/// ...".
Reason recommendation(const AccuracyStudy& study);

/// What errors are measured against, up to which time, and how exact that is: one or two sentences.
Reason yardstickOf(const AccuracyStudy& study);

/// The results of other engines, a line for each family, and how their rules differ from Carom's; empty
/// without any.
Reason enginesIn(const AccuracyStudy& study);

/// The settings that did not fit into the budget: sentences, or empty.
Reason omissionsOf(const AccuracyStudy& study);

} // namespace carom
