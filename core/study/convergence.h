// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/sentence.h"
#include "core/study/accuracy.h"

#include <optional>
#include <string>
#include <vector>

// What the points of an accuracy study say together.

namespace carom {

/// Points that differ in their substeps only, ascending; every status.
struct AccuracyFamily {
    std::string name;
    std::vector<const AccuracyPoint*> points;
};
std::vector<AccuracyFamily> familiesOf(const AccuracyStudy& study);

/// The order of convergence: the median slope of log error against log substep between neighbouring points
/// that have converged so far that it shows (errors below 0.35) and are above the reference solution's
/// resolution and rounding. Nothing of fewer than two such slopes, or where they do not agree.
std::optional<double> orderOf(const AccuracyFamily& family, const AccuracyStudy& study);

/// Usable points of ours that no other one of them beats in error without costing more, ascending by error.
std::vector<const AccuracyPoint*> paretoFront(const AccuracyStudy& study);

/// The cheapest usable point with at most this error, or null.
const AccuracyPoint* cheapestWithin(const AccuracyStudy& study, double error);

/// The cheapest usable point that is accurate enough: within the plan's target by the study's measure, and by
/// every other that says something no worse than the scene's own setting, chance or the target. Where there
/// is none the cheapest by the study's measure alone, then the most accurate one; null without any.
const AccuracyPoint* recommended(const AccuracyStudy& study);

/// What the scene runs with as it is; null where it was not measured.
const AccuracyPoint* ownPoint(const AccuracyStudy& study);

/// Whether a setting of ours is no worse than the scene's own by any measure, as far as the study can tell:
/// by those that the diagram does not show, what is below the target is as good as none.
bool isNoWorseThanOwn(const AccuracyStudy& study, const AccuracyPoint& point);

/// How many times cheaper the cheapest usable setting is that is no worse than the scene's own by any
/// measure, as far as the reference solution can tell; 1 where none is cheaper. Nothing where the own setting
/// has no figures.
std::optional<double> distanceFromFront(const AccuracyStudy& study);

/// Whether nothing moves in the reference solution, by what is accurate enough.
bool nothingMoves(const AccuracyStudy& study);

/// A setting by its name, whose substeps are said in words.
Reason saidOf(const AccuracySetting& setting);

/// "Error below 0.001 costs 0.8 ms per simulated second: microcollisions, verlet, 4 substeps; 12 times
/// cheaper than the scene's own setting ...", or "Nothing moves: every setting holds; the cheapest costs
/// ...".
Reason recommendation(const AccuracyStudy& study);

/// What errors are deviations from, up to when, and how far they can be trusted: one or two sentences.
Reason yardstickOf(const AccuracyStudy& study);

/// What other engines reach, a line each family, and where their rules are not ours; nothing without any.
Reason enginesIn(const AccuracyStudy& study);

/// What did not fit into the budget: sentences, or nothing.
Reason omissionsOf(const AccuracyStudy& study);

} // namespace carom
