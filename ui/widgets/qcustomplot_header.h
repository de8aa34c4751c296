// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The library's header is written with Qt's keywords, which our own code does without.
#define signals Q_SIGNALS
#define slots Q_SLOTS
#define foreach Q_FOREACH
#include <qcustomplot.h>
#undef signals
#undef slots
#undef foreach
