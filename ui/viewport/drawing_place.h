// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

#include <cstdint>
#include <span>

namespace carom {

/// Where the pictures on screen are drawn.
enum class DrawingPlace : std::uint8_t {
    Automatic, ///< in the window where there is a graphics card, else by a thread
    Window,    ///< by a QOpenGLWidget
    Thread,    ///< by a thread of their own, and shown as images
};

struct DrawingPlaceRow {
    DrawingPlace place;
    const char* name;  ///< kept in the settings
    const char* title; ///< in the preferences
};

/// The first is the usual one.
std::span<const DrawingPlaceRow> drawingPlaces();
/// The row of that name, else the usual one.
const DrawingPlaceRow& drawingPlace(const QString& name);

} // namespace carom
