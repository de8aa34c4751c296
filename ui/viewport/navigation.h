// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <Qt>

#include <cstdint>
#include <span>

namespace carom {

/// What a drag in the viewport does.
enum class Gesture : std::uint8_t { None, Orbit, Pan, Zoom };

/// Which buttons do it: habits from other programs are hard to change.
struct NavigationRow {
    const char* name;  ///< kept in the settings
    const char* title; ///< in the preferences
    Gesture (*gesture)(Qt::MouseButtons buttons, Qt::KeyboardModifiers modifiers);
};

/// The first is the usual one.
std::span<const NavigationRow> navigationPresets();
/// The row of that name, else the usual one.
const NavigationRow& navigationPreset(const QString& name);

} // namespace carom
