// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/sentence.h"
#include "core/study/accuracy.h"

#include <optional>
#include <span>
#include <string_view>

// Measures of a setting's error. Where trajectories are chaotic, other quantities are still well defined; a
// study uses the first measure of the list that is informative for the scene, unless the user chooses one.

namespace carom {

struct MeasureRow {
    std::string_view name; ///< "trajectory"
    std::string_view noun; ///< begins a sentence: "Error", "Largest overlap"
    std::string_view axis; ///< of the diagram
    std::string_view help; ///< one sentence: what it is, and relative to what
    /// Nothing where the point has none.
    std::optional<double> (*value)(const AccuracyPoint& point, const AccuracyStudy& study) = nullptr;
    /// The smallest error that can be distinguished from zero.
    double (*resolution)(const AccuracyStudy& study) = nullptr;
    /// The part of that below which errors are equal: the reference solution's own error, or chance.
    double equalBelow = 1;
    /// A clause, why it says nothing of the scene whatever the settings do; empty: it may.
    Reason (*objection)(const AccuracyStudy& study) = nullptr;
};

std::span<const MeasureRow> measures();

/// Errors by a measure up to this are equal, as far as the study can tell; without one, by its own.
double equalErrorsOf(const MeasureRow& measure, const AccuracyStudy& study);
double equalErrorsOf(const AccuracyStudy& study);
const MeasureRow* findMeasure(std::string_view name);

/// Why the measure says nothing of the study as far as it is, a clause; empty: it does.
Reason objectionTo(const MeasureRow& measure, const AccuracyStudy& study);

/// The first measure that says something, or the first one of all if none does.
const MeasureRow& chooseMeasure(const AccuracyStudy& study);

/// "Measured by energy, since trajectory says nothing here: ...": which measure, and why.
Reason reasonOf(const AccuracyStudy& study);

} // namespace carom
