// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/accuracy.h"

#include <functional>
#include <string>

namespace carom {

/// Counts the instructions that a simulated second takes with each finished point's setting, its first frame
/// left out: two runs of `carom run` under valgrind's callgrind, of one frame and of all; the ledger that
/// `carom run` keeps is part of it, a percent or two. Counts do not depend on what else the machine does.
/// `counted` is called after each point; false ends it. Throws UsageError where valgrind is missing, and
/// FileError where a run under it fails.
void countInstructions(AccuracyStudy& study, const std::string& scenePath,
                       const std::function<bool(std::size_t done)>& counted);

/// Throws UsageError where valgrind is not on the PATH.
void needValgrind();

} // namespace carom
