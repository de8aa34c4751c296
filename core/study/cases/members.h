// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace carom {

class Trial;

#define CAROM_HARD_MEMBERS(which, ask) void ask(Trial& trial);
#include "core/study/cases/members.def"
#undef CAROM_HARD_MEMBERS

} // namespace carom
