// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/viewport.h"

#include "ui/viewport/navigation.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>

#include <cmath>
#include <utility>

// What mouse and keys do in the viewport.

namespace carom {

namespace {

constexpr double orbitPerPixel = 0.008; ///< [rad]
constexpr double zoomPerNotch = 0.86;   ///< of the distance; a notch of a wheel is 120 units
constexpr double pixelsPerNotch = 30;   ///< [px] of a drag that zooms
constexpr double dragStarts = 4;        ///< [px]: a shorter way between press and release is a click

} // namespace

void Viewport::mousePressEvent(QMouseEvent* event) {
    const bool another = event->buttons() != Qt::MouseButtons(event->button());
    if (m_grab) letGo();
    if (another && m_letGo) return;
    m_letGo = false;
    m_pressedAt = m_lastAt = event->position();
    m_dragging = false;
    m_told.clear();
    if (event->button() == Qt::LeftButton && cubeSideAt(m_camera, cubePlace(pictureSize()), m_pressedAt))
        return;
    const bool turns = event->button() != Qt::LeftButton || event->modifiers().testFlag(Qt::ShiftModifier);
    if (!turns) m_grab = grabAt(event->position());
}

/// The tips of velocities lie over the bodies, where they are shown, and so does the gizmo.
std::optional<BodyGrab> Viewport::grabAt(const QPointF& position) const {
    if (!hasScene() || !m_mayDrag) return std::nullopt;
    const Eigen::Vector2d pixel(position.x(), position.y());
    if (holds(overlays(), Overlay::Velocities)) {
        const std::span<const Vec3> velocities =
            m_snapshot ? m_snapshot->velocity : m_stage->pipeline->initialState().velocity;
        const std::optional<BodyGrab> tip = grabTip(m_camera, pictureSize(), pixel, poses(), velocities,
                                                    m_explanations.arrows() * velocityTime);
        if (tip && m_mayDrag(tip->body, tip->handle)) return tip;
    }
    if (std::optional<BodyGrab> part = grabGizmo(position)) return part;
    const Hit hit = hitAt(position);
    if (!hit || isWall(scene().bodies[hit.body].shape)) return std::nullopt;
    if (!m_mayDrag(hit.body, BodyHandle::Centre)) return std::nullopt;
    const Pose& pose = poses()[hit.body];
    return BodyGrab{.body = hit.body,
                    .handle = BodyHandle::Centre,
                    .start = {pose, {}},
                    .point = pose.position,
                    .normal = dragNormal(m_camera),
                    .pixel = pixel};
}

std::optional<BodyGrab> Viewport::grabGizmo(const QPointF& position) const {
    const Eigen::Vector2d pixel(position.x(), position.y());
    const PictureJob now = job(pictureSize());
    const std::vector<GizmoHandle> handles = gizmo(now);
    const GizmoPart part = partAt(handles, pixel);
    if (part == GizmoPart::None) return std::nullopt;
    const BodyHandle handle = isTurn(part) ? BodyHandle::Turn : BodyHandle::Centre;
    if (!m_mayDrag(m_selected, handle)) return std::nullopt;
    const Pose& pose = poses()[m_selected];
    BodyGrab grab{.body = m_selected,
                  .handle = handle,
                  .part = part,
                  .start = {pose, {}},
                  .point = pose.position,
                  .normal = Vec3::Unit(axisOf(part)),
                  .pixel = pixel};
    // A ring follows the mouse at the place that is held: its point nearest to the ray.
    if (isTurn(part)) grab.point = pointOfRing(m_camera, pictureSize(), pose.position, grab.normal, pixel);
    return grab;
}

void Viewport::dragBody(const QPointF& position, bool snaps) {
    const DraggedBody now = draggedTo(*m_grab, m_camera, pictureSize(), {position.x(), position.y()}, snaps);
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
    if (m_grab->handle == BodyHandle::Velocity)
        moved.velocity[m_grab->body] = now.velocity;
    else
        moved.pose[m_grab->body] = now.pose;
    m_told = tellOf(*m_grab, now, pixelSize());
    showSnapshot(std::make_shared<const Snapshot>(std::move(moved)));
    Q_EMIT dragged(now);
}

void Viewport::letGo() {
    const bool held = std::exchange(m_grab, std::nullopt).has_value();
    m_letGo = held;
    m_told.clear();
    if (std::exchange(m_dragging, false) && held) Q_EMIT dragEnded();
}

void Viewport::forgetDrag() {
    if (!std::exchange(m_moved, false)) return;
    m_snapshot = std::exchange(m_beforeDrag, nullptr);
    m_lines.reset();
    redraw();
}

void Viewport::focusOutEvent(QFocusEvent* event) {
    letGo();
    QWidget::focusOutEvent(event);
}

void Viewport::hideEvent(QHideEvent* event) {
    letGo();
    QWidget::hideEvent(event);
}

/// Lights what the mouse is over and could take hold of.
void Viewport::follow(const QPointF& position) {
    const std::optional<ViewSide> side = cubeSideAt(m_camera, cubePlace(pictureSize()), position);
    const GizmoPart part =
        side ? GizmoPart::None : partAt(gizmo(job(pictureSize())), {position.x(), position.y()});
    const QString tip = side || part != GizmoPart::None ? QString() : tipAtPoint(position);
    const bool same = m_litSide == side && m_lit == part && m_told == tip && tip.isEmpty();
    m_litSide = side;
    m_lit = part;
    m_told = tip;
    m_lastAt = position;
    if (!same) repaintOver();
}

void Viewport::leaveEvent(QEvent* event) {
    m_litSide.reset();
    m_lit = GizmoPart::None;
    if (!m_grab) m_told.clear();
    repaintOver();
    QWidget::leaveEvent(event);
}

void Viewport::mouseMoveEvent(QMouseEvent* event) {
    if (event->buttons() == Qt::NoButton) {
        follow(event->position());
        return;
    }
    if (m_letGo) return;
    const QPointF moved = event->position() - m_lastAt;
    if (!m_dragging && (event->position() - m_pressedAt).manhattanLength() < dragStarts) return;
    if (m_grab && !m_dragging) Q_EMIT dragBegan(m_grab->body, m_grab->handle);
    m_dragging = true;
    m_lastAt = event->position();
    if (m_grab) {
        dragBody(event->position(), event->modifiers().testFlag(Qt::ControlModifier));
        return;
    }
    switch (m_navigation->gesture(event->buttons(), event->modifiers())) {
    case Gesture::Orbit:
        orbit(m_camera, -orbitPerPixel * moved.x(), orbitPerPixel * moved.y());
        break;
    case Gesture::Pan:
        pan(m_camera, pictureSize(), {moved.x(), moved.y()});
        break;
    case Gesture::Zoom:
        zoomAt(m_camera, m_camera.target, std::pow(zoomPerNotch, -moved.y() / pixelsPerNotch));
        break;
    case Gesture::None:
        return;
    }
    moveCamera();
}

void Viewport::mouseReleaseEvent(QMouseEvent* event) {
    if (m_letGo) {
        m_letGo = event->buttons() != Qt::NoButton;
        return;
    }
    const bool held = std::exchange(m_grab, std::nullopt).has_value();
    m_told.clear();
    if (m_dragging && held) Q_EMIT dragEnded();
    if (std::exchange(m_dragging, false)) {
        if (held) repaintOver(); // without the value beside the mouse
        return;
    }
    const std::optional<ViewSide> side = cubeSideAt(m_camera, cubePlace(pictureSize()), event->position());
    if (event->button() == Qt::LeftButton && side) {
        lookFrom(*side);
        return;
    }
    const Hit hit = hitAt(event->position());
    if (event->button() == Qt::RightButton) Q_EMIT menuWanted(event->globalPosition().toPoint(), hit.body);
    if (event->button() != Qt::LeftButton) return;
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
    zoomAt(m_camera, point, std::pow(zoomPerNotch, event->angleDelta().y() / 120.0));
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
