// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/engines.h"

#include <string>

namespace carom {

/// The program `carom-engine-NAME` beside this one, else on the PATH. Throws UsageError where there is none.
std::string engineProgram(const std::string& engine);

/// Starts it on a scene's file and hands on what it prints, until it ends, its time is over or it is
/// cancelled; then it is ended. What went wrong, or nothing.
std::string runEngineProgram(const std::string& scene, const EngineRequest& request);

} // namespace carom
