// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace carom {

/// From now on Ctrl-C (and a polite request to end, SIGTERM) only sets a flag; the loop that computes looks
/// at it once a frame, writes what there is and ends. A second one ends the program at once.
void catchInterrupts();
bool interrupted();

} // namespace carom
