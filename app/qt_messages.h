// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace carom {

/// Qt's messages for programmers are suppressed unless QT_LOGGING_RULES is set. Where Qt cannot start,
/// because the display cannot be reached, the program ends with a message and exit code 3.
void quietQt();

} // namespace carom
