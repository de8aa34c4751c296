// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/navigation.h"

#include "core/base/catalogue.h"

#include <QtGlobal>

#include <array>

namespace carom {
namespace {

bool has(Qt::KeyboardModifiers modifiers, Qt::KeyboardModifier one) { return modifiers.testFlag(one); }

Gesture usual(Qt::MouseButtons buttons, Qt::KeyboardModifiers modifiers) {
    if (buttons.testAnyFlags(Qt::RightButton | Qt::MiddleButton)) return Gesture::Pan;
    if (!buttons.testFlag(Qt::LeftButton)) return Gesture::None;
    return has(modifiers, Qt::ShiftModifier) ? Gesture::Pan : Gesture::Orbit;
}

/// The middle button turns; with Shift it moves, with Ctrl it zooms.
Gesture middle(Qt::MouseButtons buttons, Qt::KeyboardModifiers modifiers) {
    if (!buttons.testFlag(Qt::MiddleButton)) return Gesture::None;
    if (has(modifiers, Qt::ShiftModifier)) return Gesture::Pan;
    return has(modifiers, Qt::ControlModifier) ? Gesture::Zoom : Gesture::Orbit;
}

/// The middle button moves, with Shift it turns; the right one zooms.
Gesture drafting(Qt::MouseButtons buttons, Qt::KeyboardModifiers modifiers) {
    if (buttons.testFlag(Qt::RightButton)) return Gesture::Zoom;
    if (!buttons.testFlag(Qt::MiddleButton)) return Gesture::None;
    return has(modifiers, Qt::ShiftModifier) ? Gesture::Orbit : Gesture::Pan;
}

/// Left turns, middle moves, right zooms, all with Alt or without.
Gesture threeButtons(Qt::MouseButtons buttons, Qt::KeyboardModifiers) {
    if (buttons.testFlag(Qt::LeftButton)) return Gesture::Orbit;
    if (buttons.testFlag(Qt::MiddleButton)) return Gesture::Pan;
    return buttons.testFlag(Qt::RightButton) ? Gesture::Zoom : Gesture::None;
}

constexpr std::array rows = {
    NavigationRow{"usual", QT_TRANSLATE_NOOP("carom::Preferences", "Left turns, right or middle moves"),
                  usual},
    NavigationRow{"three_buttons",
                  QT_TRANSLATE_NOOP("carom::Preferences", "Left turns, middle moves, right zooms"),
                  threeButtons},
    NavigationRow{"middle",
                  QT_TRANSLATE_NOOP("carom::Preferences", "Middle turns, with Shift moves, with Ctrl zooms"),
                  middle},
    NavigationRow{"drafting",
                  QT_TRANSLATE_NOOP("carom::Preferences", "Middle moves, with Shift turns; right zooms"),
                  drafting},
};

} // namespace

std::span<const NavigationRow> navigationPresets() { return rows; }

const NavigationRow& navigationPreset(const QString& name) {
    const NavigationRow* row = findByName<NavigationRow>(rows, name.toStdString());
    return row != nullptr ? *row : rows.front();
}

} // namespace carom
