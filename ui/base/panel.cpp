// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/panel.h"

namespace carom {

void Panel::setTheme(const Theme&) {}

} // namespace carom

#include "moc_panel.cpp"
