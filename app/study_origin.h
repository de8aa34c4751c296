// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/options.h"
#include "core/study/stability_report.h"

#include <string_view>

namespace carom {

/// The command line of a study as a shell would take it, the program's version, and this machine.
StudyOrigin studyOrigin(std::string_view command, const Arguments& arguments);

} // namespace carom
