// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/ide.h"

namespace carom {

/// Saves the viewport's picture of a scene at one frame, simulated from the start: the same scene gives the
/// same picture. Needs a QApplication; returns the exit code.
int savePicture(const std::string& scene, const PictureRequest& request);

} // namespace carom
