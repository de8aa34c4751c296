// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Qt>
#include <algorithm>
#include <array>

namespace carom {

/// Shift, Ctrl and the like, which do nothing alone.
inline bool isModifierKey(int key) {
    static constexpr std::array<int, 5> modifiers = {Qt::Key_Shift, Qt::Key_Control, Qt::Key_Alt,
                                                     Qt::Key_AltGr, Qt::Key_Meta};
    return std::find(modifiers.begin(), modifiers.end(), key) != modifiers.end();
}

} // namespace carom
