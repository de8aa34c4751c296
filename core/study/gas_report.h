// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/gas.h"
#include "core/study/stability_report.h"

#include <string>

namespace carom {

/// The report as text: a line for each figure with the theoretical value, then the remarks.
std::string summaryOf(const GasStudy& study);

/// `figure,value,uncertainty,theory,unit,command,version,machine`, a row for each figure; missing values are
/// empty.
std::string figuresAsCsv(const GasStudy& study, const StudyOrigin& origin);
/// The same for several scenes: `scene,figure,...`, and the rows of one.
std::string gasesColumns();
std::string gasesRows(const std::string& scene, const GasStudy& study, const StudyOrigin& origin);
/// `from,to,density,theory`, speeds in units of √(kT/m).
std::string speedsAsCsv(const GasStudy& study);
/// `from,to,balls,theory,temperature,temperature_uncertainty`, heights in m.
std::string heightsAsCsv(const GasStudy& study);

} // namespace carom
