// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/pauses.h"

#include <algorithm>

namespace carom {
namespace {

int timesShorter = 1; // of the GUI's thread

} // namespace

int pauseOf(int milliseconds) { return std::max(1, milliseconds / timesShorter); }

void shortenPauses(int times) { timesShorter = times; }

} // namespace carom
