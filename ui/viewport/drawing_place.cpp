// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/drawing_place.h"

#include "core/base/catalogue.h"

#include <QtGlobal>

#include <array>

namespace carom {
namespace {

constexpr std::array rows = {
    DrawingPlaceRow{DrawingPlace::Automatic, "automatic",
                    QT_TRANSLATE_NOOP("carom::Preferences", "as the machine does best")},
    DrawingPlaceRow{DrawingPlace::Window, "window",
                    QT_TRANSLATE_NOOP("carom::Preferences", "in the window, by OpenGL (graphics cards)")},
    DrawingPlaceRow{DrawingPlace::Thread, "thread",
                    QT_TRANSLATE_NOOP("carom::Preferences", "beside it, by a thread (software OpenGL)")},
};

} // namespace

std::span<const DrawingPlaceRow> drawingPlaces() { return rows; }

const DrawingPlaceRow& drawingPlace(const QString& name) {
    const DrawingPlaceRow* row = findByName<DrawingPlaceRow>(rows, name.toStdString());
    return row != nullptr ? *row : rows.front();
}

} // namespace carom
