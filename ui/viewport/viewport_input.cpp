// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/viewport.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>

#include <utility>

// What the viewport does of what Gestures says, and of wheel and keys.

namespace carom {

namespace {

constexpr double notch = 120; ///< units of a wheel's event

MouseState stateOf(const QMouseEvent& event) {
    return {event.position(), event.button(), event.buttons(), event.modifiers()};
}

} // namespace

void Viewport::listenToGestures() {
    connect(&m_gestures, &Gestures::grabbed, this,
            [this] { Q_EMIT dragBegan(m_gestures.held()->body, m_gestures.held()->handle); });
    connect(&m_gestures, &Gestures::pulled, this, &Viewport::dragBody);
    connect(&m_gestures, &Gestures::dropped, this, [this](bool dragged) {
        m_told.clear();
        if (!dragged) return;
        repaintOver(); // without the value beside the mouse
        Q_EMIT dragEnded();
    });
    connect(&m_gestures, &Gestures::viewDragged, this, [this](Gesture gesture, const QPointF& by) {
        carom::follow(m_camera, pictureSize(), gesture, by);
        moveCamera();
    });
    connect(&m_gestures, &Gestures::clicked, this, &Viewport::click);
}

void Viewport::mousePressEvent(QMouseEvent* event) {
    m_told.clear();
    m_mouseAt = event->position();
    m_gestures.press(stateOf(*event));
}

void Viewport::mouseMoveEvent(QMouseEvent* event) {
    if (event->buttons() == Qt::NoButton) {
        point(event->position());
        return;
    }
    m_mouseAt = event->position();
    m_gestures.move(stateOf(*event));
}

void Viewport::mouseReleaseEvent(QMouseEvent* event) {
    m_told.clear();
    m_gestures.release(stateOf(*event));
}

/// The tips of velocities lie over the bodies, where they are shown, and so does the gizmo; the cube lies
/// over all of it.
std::optional<BodyGrab> Viewport::grabAt(const QPointF& position) const {
    if (!hasScene() || !m_mayDrag || cubeSideAt(m_camera, cubePlace(pictureSize()), position))
        return std::nullopt;
    const Eigen::Vector2d pixel(position.x(), position.y());
    if (holds(overlays(), Overlay::Velocities)) {
        const std::span<const Vec3> velocities =
            m_snapshot ? m_snapshot->velocity : m_stage->pipeline->initialState().velocity;
        const std::optional<BodyGrab> tip = grabTip(m_camera, pictureSize(), pixel, poses(), velocities,
                                                    m_explanations.arrows() * velocityTime);
        if (tip && m_mayDrag(tip->body, tip->handle)) return tip;
    }
    const GizmoPart part = partAt(gizmo(job(pictureSize())), pixel);
    if (part != GizmoPart::None) {
        const BodyGrab grab = grabPart(m_camera, pictureSize(), part, m_selected, poses()[m_selected], pixel);
        if (m_mayDrag(grab.body, grab.handle)) return grab;
    }
    const Hit hit = hitAt(position);
    if (!hit || isWall(scene().bodies[hit.body].shape)) return std::nullopt;
    if (!m_mayDrag(hit.body, BodyHandle::Centre)) return std::nullopt;
    return grabCentre(m_camera, hit.body, poses()[hit.body], pixel);
}

void Viewport::dragBody(const QPointF& position, bool snaps) {
    const DraggedBody now =
        draggedTo(*m_gestures.held(), m_camera, pictureSize(), {position.x(), position.y()}, snaps);
    showDragged(now);
    Q_EMIT dragged(now);
}

void Viewport::showDragged(const DraggedBody& now) {
    const BodyGrab& grab = *m_gestures.held();
    // Shown at once; the scene itself follows when the text has been built.
    if (!std::exchange(m_moved, true)) m_beforeDrag = m_snapshot;
    Snapshot moved;
    if (m_snapshot) {
        moved = *m_snapshot;
    } else {
        const State& start = m_stage->pipeline->initialState();
        moved.pose = start.pose;
        moved.velocity = start.velocity;
        moved.angularVelocity = start.angularVelocity;
    }
    if (grab.handle == BodyHandle::Velocity)
        moved.velocity[grab.body] = now.velocity;
    else
        moved.pose[grab.body] = now.pose;
    m_told = tellOf(grab, now, pixelSize());
    showSnapshot(std::make_shared<const Snapshot>(std::move(moved)));
}

void Viewport::forgetDrag() {
    if (!std::exchange(m_moved, false)) return;
    m_snapshot = std::exchange(m_beforeDrag, nullptr);
    m_lines.reset();
    redraw();
}

void Viewport::focusOutEvent(QFocusEvent* event) {
    m_gestures.letGo();
    QWidget::focusOutEvent(event);
}

void Viewport::hideEvent(QHideEvent* event) {
    m_gestures.letGo();
    QWidget::hideEvent(event);
}

/// Lights what the mouse is over and could take hold of.
void Viewport::point(const QPointF& position) {
    const std::optional<ViewSide> side = cubeSideAt(m_camera, cubePlace(pictureSize()), position);
    const GizmoPart part =
        side ? GizmoPart::None : partAt(gizmo(job(pictureSize())), {position.x(), position.y()});
    const QString tip = side || part != GizmoPart::None ? QString() : tipAtPoint(position);
    const bool same = m_litSide == side && m_lit == part && m_told == tip && tip.isEmpty();
    m_litSide = side;
    m_lit = part;
    m_told = tip;
    m_mouseAt = position;
    if (!same) repaintOver();
}

void Viewport::leaveEvent(QEvent* event) {
    m_litSide.reset();
    m_lit = GizmoPart::None;
    if (!m_gestures.held()) m_told.clear();
    repaintOver();
    QWidget::leaveEvent(event);
}

void Viewport::click(Qt::MouseButton button, const QPointF& place) {
    const std::optional<ViewSide> side = cubeSideAt(m_camera, cubePlace(pictureSize()), place);
    if (button == Qt::LeftButton && side) {
        lookFrom(*side);
        return;
    }
    const Hit hit = hitAt(place);
    if (button == Qt::RightButton) Q_EMIT menuWanted(mapToGlobal(place).toPoint(), hit.body);
    if (button != Qt::LeftButton) return;
    setSelectedBody(hit.body);
    Q_EMIT bodyClicked(hit.body);
}

void Viewport::wheelEvent(QWheelEvent* event) {
    const Ray ray = rayAt(event->position());
    const Hit hit = hitAt(event->position());
    // Over the sky, the plane through the target square to the line of sight takes the place of a surface.
    const Vec3 forward = m_camera.forward();
    const double toPlane = (m_camera.target - ray.origin).dot(forward) / ray.direction.dot(forward);
    const Vec3 point = ray.origin + (hit ? hit.distance : toPlane) * ray.direction;
    zoomByNotches(m_camera, point, event->angleDelta().y() / notch);
    moveCamera();
    event->accept();
}

void Viewport::keyPressEvent(QKeyEvent* event) {
    const bool pad = event->modifiers().testFlag(Qt::KeypadModifier);
    if (event->key() == Qt::Key_F && event->modifiers() == Qt::NoModifier)
        frameSelection();
    else if (event->key() == Qt::Key_Home)
        frameAll();
    else if (pad && event->key() == Qt::Key_7)
        lookFrom(ViewSide::Top);
    else if (pad && event->key() == Qt::Key_1)
        lookFrom(ViewSide::Front);
    else if (pad && event->key() == Qt::Key_3)
        lookFrom(ViewSide::Right);
    else if (pad && event->key() == Qt::Key_5)
        setOrthographic(!m_camera.orthographic);
    else if (event->key() == Qt::Key_Menu)
        Q_EMIT menuWanted(mapToGlobal(rect().center()), m_selected);
    else
        QWidget::keyPressEvent(event);
}

} // namespace carom
