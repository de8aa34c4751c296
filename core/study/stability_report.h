// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/stability.h"

#include <string>
#include <string_view>

// What a stability study says, as text and as CSV.

namespace carom {

/// "energy error 3.2e-14, limit 1e-05".
std::string describe(const Figure& figure);

/// For people: the case, its verdict and a line a figure; nothing where the case does not apply.
std::string describe(const TrialResult& result);
/// A sentence a column: how many hold.
std::string summaryOf(const StabilityStudy& study);
/// "default: 21 of 24 hold".
std::string tallyOf(const StabilityStudy& study, StudyColumn column);

/// Where and how a study was run, for every row of its CSV.
struct StudyOrigin {
    std::string command; ///< the command line
    std::string version; ///< of the program
    std::string machine; ///< processor and system
};

/// `case,name,column,figure,value,unit,limit,verdict,wall_s,command,version,machine`, a row a figure; the
/// verdict is the figure's. A case that does not apply in a column has one row without a figure.
std::string figuresAsCsv(const StabilityStudy& study, const StudyOrigin& origin);

} // namespace carom
