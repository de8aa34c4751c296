// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/version.h"

namespace carom {

std::string_view version() { return CAROM_VERSION; }

} // namespace carom
