// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/viewport/body_grab.h"
#include "ui/viewport/navigation.h"

#include <QObject>
#include <QPointF>

#include <functional>
#include <optional>

namespace carom {

/// What a mouse event says of buttons, keys and place.
struct MouseState {
    QPointF place;                           ///< [px] of the picture
    Qt::MouseButton button = Qt::NoButton;   ///< that went down or up
    Qt::MouseButtons buttons = Qt::NoButton; ///< that are down now
    Qt::KeyboardModifiers keys = Qt::NoModifier;
};

/// What press, move and release of the mouse come to: a click, a drag of a body or a drag of the view. It
/// knows neither the widget nor the scene.
///
///     press ──▶ grabAt ──── moved 4 px ──▶ grabbed, then pulled or viewDragged ──▶ release ──▶ dropped
///       └────────────────── release ─────▶ clicked
///     another button, or letGo(), with a body held: dropped; then nothing until every button is up
class Gestures : public QObject {
    Q_OBJECT
  public:
    /// `grabAt` says what of a body, if any, a press at a place takes hold of.
    explicit Gestures(std::function<std::optional<BodyGrab>(const QPointF&)> grabAt);

    /// Which buttons turn, move and zoom the view.
    void setNavigation(const NavigationRow& preset) { m_navigation = &preset; }

    void press(const MouseState& mouse);
    /// With a button down.
    void move(const MouseState& mouse);
    void release(const MouseState& mouse);
    /// Ends a drag of a body, if one is under way, where it is.
    void letGo();

    /// Between press and release; null where no body is held.
    const BodyGrab* held() const { return m_grab ? &*m_grab : nullptr; }
    bool isDragging() const { return m_dragging; }

  Q_SIGNALS:
    /// The body that is held begins to follow the mouse.
    void grabbed();
    /// The body that is held is to follow the mouse to a place.
    void pulled(const QPointF& place, bool snaps);
    /// A body is held no more; `dragged`: it had begun to follow.
    void dropped(bool dragged);
    /// The view is to follow the mouse by so many pixels.
    void viewDragged(carom::Gesture gesture, const QPointF& by);
    /// A button went down and up with no drag between.
    void clicked(Qt::MouseButton button, const QPointF& place);

  private:
    void drop();

    std::function<std::optional<BodyGrab>(const QPointF&)> m_grabAt;
    const NavigationRow* m_navigation; ///< never null
    std::optional<BodyGrab> m_grab;
    QPointF m_pressedAt, m_lastAt;
    bool m_dragging = false;
    bool m_ended = false; ///< a drag, with a button still down: nothing more until all are up
};

/// Turns, moves or zooms the camera as the mouse was dragged [px].
void follow(Camera& camera, const PictureSize& picture, Gesture gesture, const QPointF& by);
/// Zooms as a wheel was turned by so many notches, so that `fixedPoint` [m] keeps its place.
void zoomByNotches(Camera& camera, const Vec3& fixedPoint, double notches);

} // namespace carom
