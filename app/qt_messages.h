// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace carom {

/// What Qt says to programmers is not for users: it stays silent unless QT_LOGGING_RULES is set. Where Qt
/// cannot go on, because the display cannot be reached, the program ends with a sentence and exit code 3.
void quietQt();

} // namespace carom
