// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/engines.h"

#include <QByteArray>
#include <QStringList>

// The programs of other engines, for the accuracy panel: `carom-engine-NAME` beside this program or on the
// PATH. What they print is read in core/study/engines.h.

namespace carom {

/// The names of those that are installed, without `carom-engine-`, in alphabetical order.
QStringList installedEngines();

/// Runs one on a scene; to be called on the thread of a study. What went wrong, or nothing.
std::string runEngineOn(const QByteArray& scene, const EngineRequest& request);

} // namespace carom
