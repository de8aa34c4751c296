// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How long the program waits before it acts on what may not be complete: until typing rests, until another
// program has written a file, until figures that change may be shown again. People need these pauses; a test
// that waits for what comes behind one does not.

namespace carom {

/// A pause that is usually so long [ms], at least 1.
int pauseOf(int milliseconds);

/// From now on pauses are so many times shorter; 1 in the program.
void shortenPauses(int times);

} // namespace carom
