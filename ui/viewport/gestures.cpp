// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/gestures.h"

#include <cmath>
#include <utility>

namespace carom {

namespace {

constexpr double orbitPerPixel = 0.008; ///< [rad]
constexpr double zoomPerNotch = 0.86;   ///< of the distance
constexpr double pixelsPerNotch = 30;   ///< [px] of a drag that zooms
/// [px] between press and release; less is a click; at a quarter clicks drag.
constexpr double dragStarts = 4;

} // namespace

Gestures::Gestures(std::function<std::optional<BodyGrab>(const QPointF&)> grabAt)
    : m_grabAt(std::move(grabAt)), m_navigation(&navigationPresets().front()) {}

void Gestures::press(const MouseState& mouse) {
    const bool another = mouse.buttons != Qt::MouseButtons(mouse.button);
    letGo();
    if (another && m_ended) return;
    m_ended = false;
    m_dragging = false;
    m_pressedAt = m_lastAt = mouse.place;
    if (mouse.button == Qt::LeftButton && !mouse.keys.testFlag(Qt::ShiftModifier))
        m_grab = m_grabAt(mouse.place);
}

void Gestures::move(const MouseState& mouse) {
    if (m_ended) return;
    if (!m_dragging && (mouse.place - m_pressedAt).manhattanLength() < dragStarts) return;
    const bool begins = !std::exchange(m_dragging, true);
    const QPointF by = mouse.place - std::exchange(m_lastAt, mouse.place);
    if (!m_grab) {
        const Gesture gesture = m_navigation->gesture(mouse.buttons, mouse.keys);
        if (gesture != Gesture::None) Q_EMIT viewDragged(gesture, by);
        return;
    }
    if (begins) Q_EMIT grabbed();
    // Whoever was told may have let go.
    if (m_grab) Q_EMIT pulled(mouse.place, mouse.keys.testFlag(Qt::ControlModifier));
}

void Gestures::release(const MouseState& mouse) {
    if (m_ended) {
        m_ended = mouse.buttons != Qt::NoButton;
        return;
    }
    const bool dragged = m_dragging;
    drop();
    if (!dragged) Q_EMIT clicked(mouse.button, mouse.place);
}

void Gestures::letGo() {
    if (!m_grab) return;
    m_ended = true;
    drop();
}

void Gestures::drop() {
    const bool dragged = std::exchange(m_dragging, false);
    if (std::exchange(m_grab, std::nullopt)) Q_EMIT dropped(dragged);
}

void follow(Camera& camera, const PictureSize& picture, Gesture gesture, const QPointF& by) {
    switch (gesture) {
    case Gesture::Orbit:
        orbit(camera, -orbitPerPixel * by.x(), orbitPerPixel * by.y());
        break;
    case Gesture::Pan:
        pan(camera, picture, {by.x(), by.y()});
        break;
    case Gesture::Zoom:
        zoomByNotches(camera, camera.target, -by.y() / pixelsPerNotch);
        break;
    case Gesture::None:
        break;
    }
}

void zoomByNotches(Camera& camera, const Vec3& fixedPoint, double notches) {
    zoomAt(camera, fixedPoint, std::pow(zoomPerNotch, notches));
}

} // namespace carom
