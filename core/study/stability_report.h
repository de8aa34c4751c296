// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/stability.h"

#include <string>
#include <string_view>

// The results of a stability study, as text and as CSV.

namespace carom {

/// "energy error 3.2e-14, limit 1e-05".
std::string describe(const Figure& figure);

/// Text for a case: its name, its verdict and a line for each figure; empty if the case does not apply.
std::string describe(const TrialResult& result);
/// For each column a sentence: how many cases hold.
std::string summaryOf(const StabilityStudy& study);
/// "default: 21 of 24 hold".
std::string tallyOf(const StabilityStudy& study, StudyColumn column);

/// Where and how a study was run, for every row of its CSV.
struct StudyOrigin {
    std::string command; ///< the command line
    std::string version; ///< of the program
    std::string machine; ///< processor and system
};

/// `case,name,column,figure,value,unit,limit,verdict,wall_s,command,version,machine`, a row for each figure;
/// the verdict is the figure's. A case that does not apply in a column has one row without a figure.
std::string figuresAsCsv(const StabilityStudy& study, const StudyOrigin& origin);

} // namespace carom
