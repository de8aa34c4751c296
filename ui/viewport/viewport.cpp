// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/viewport.h"

#include "core/base/clock.h"
#include "ui/viewport/instances.h"
#include "ui/viewport/navigation.h"
#include "ui/viewport/opengl_screen.h"

#include <QKeyEvent>
#include <QLabel>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>

#include <cmath>
#include <numbers>
#include <utility>

namespace carom {

namespace {

constexpr double orbitPerPixel = 0.008; ///< [rad]
constexpr double zoomPerNotch = 0.86;   ///< of the distance; a notch of a wheel is 120 units
constexpr double pixelsPerNotch = 30;   ///< [px] of a drag that zooms
constexpr double dragStarts = 4;        ///< [px]: a shorter way between press and release is a click
constexpr int restAfter = 250;          ///< [ms] without a change
constexpr double selectionRadii = 5;    ///< a framed body is shown with this much around it

bool same(const CameraSettings& a, const CameraSettings& b) {
    return a.position == b.position && a.target == b.target && a.fieldOfView == b.fieldOfView;
}

bool declared(const CameraSettings& camera) { return camera.position || camera.target; }

} // namespace

Viewport::Viewport(QWidget* parent)
    : QWidget(parent), m_badge(new QLabel(this)), m_navigation(&navigationPresets().front()) {
    setAttribute(Qt::WA_OpaquePaintEvent);
    setFocusPolicy(Qt::StrongFocus);
    setMinimumSize(120, 90);
    setAccessibleName(tr("Viewport"));
    m_badge->setObjectName(QStringLiteral("viewportBadge"));
    m_badge->setProperty("role", QStringLiteral("badge"));
    m_badge->setAttribute(Qt::WA_TransparentForMouseEvents);
    m_badge->hide();
    m_rest.setSingleShot(true);
    m_rest.setInterval(restAfter);
    connect(&m_rest, &QTimer::timeout, this, [this] {
        m_atRest = m_stale = true;
        schedule();
    });
    m_pause.setSingleShot(true);
    connect(&m_pause, &QTimer::timeout, this, &Viewport::drawForScreen);
    connect(&m_drawing, &DrawingThread::ready, this, [this](bool software) {
        m_ready = true;
        m_software = software;
        redraw();
    });
    connect(&m_drawing, &DrawingThread::drawn, this, &Viewport::takePicture);
    connect(&m_drawing, &DrawingThread::failed, this, &Viewport::failed);
}

Viewport::~Viewport() = default;

void Viewport::drawIn(DrawingPlace place) {
    const bool inWindow =
        place == DrawingPlace::Window || (place == DrawingPlace::Automatic && m_drawing.hasGraphicsCard());
    if (inWindow == drawsInWindow()) return;
    delete std::exchange(m_screen, nullptr);
    if (!inWindow) return;
    m_screen = new OpenGLScreen(
        [this](QPainter& painter, const PictureJob& job) { paintLabelsOf(painter, job); }, this);
    m_screen->setGeometry(rect());
    m_screen->lower(); // the badge stays above it
    connect(m_screen, &OpenGLScreen::drawn, this, &Viewport::takePicture);
    connect(m_screen, &OpenGLScreen::failed, this, &Viewport::failed);
}

void Viewport::showPipeline(std::shared_ptr<const Pipeline> pipeline) {
    const bool first = !hasScene();
    const std::shared_ptr<Stage> stage = std::make_shared<Stage>();
    stage->pipeline = std::move(pipeline);
    m_snapshot.reset();
    m_moved = false;
    m_explanations.clear();
    m_lines.reset();
    m_pace.forget();
    m_stage = stage;
    redraw();
    if (!hasScene()) {
        m_selected = noBody;
        return;
    }
    for (const Body& body : scene().bodies) stage->start.push_back(body.pose);
    stage->room = roomOf(scene(), boundsOf(scene(), stage->start));
    if (m_selected != noBody && m_selected >= scene().bodies.size()) m_selected = noBody;
    if (first) {
        m_camera = Camera{};
        m_cameraMoved = false;
        frameAll();
    }
    if (first || !same(scene().camera, m_declaredCamera)) {
        apply(m_camera, scene().camera);
        if (declared(scene().camera)) m_cameraMoved = true;
    }
    m_declaredCamera = scene().camera;
}

void Viewport::showSnapshot(std::shared_ptr<const Snapshot> snapshot) {
    if (!hasScene() || !snapshot || snapshot->pose.size() != m_stage->start.size()) return;
    m_snapshot = std::move(snapshot);
    m_explanations.note(*m_stage->pipeline, *m_snapshot);
    m_lines.reset();
    redraw();
}

void Viewport::showStructure(std::vector<Aabb> boxes) {
    m_explanations.setStructure(std::move(boxes));
    m_lines.reset();
    redraw();
}

void Viewport::showGhost(const Ghost& ghost) {
    m_explanations.setGhost(ghost);
    m_lines.reset();
    redraw();
}

void Viewport::setSelectedBody(BodyIndex body) {
    if (m_selected == body) return;
    m_selected = body;
    redraw();
}

void Viewport::setDimmed(bool dimmed, const QString& badge) {
    m_dimmed = dimmed;
    m_badge->setText(badge);
    m_badge->setVisible(dimmed && !badge.isEmpty());
    placeBadge();
    redraw();
}

void Viewport::setOverlays(Overlays overlays) {
    m_explanations.setOverlays(overlays);
    m_lines.reset();
    redraw();
}

void Viewport::setOverlay(Overlay overlay, bool shown) {
    const Overlays one = static_cast<Overlays>(overlay);
    setOverlays(shown ? overlays() | one : overlays() & ~one);
}

void Viewport::setDarkTheme(bool dark) {
    m_dark = dark;
    redraw();
}

void Viewport::setCamera(const Camera& camera) {
    m_camera = camera;
    moveCamera();
}

void Viewport::redraw() {
    m_atRest = false;
    m_stale = true;
    if (m_software) m_rest.start();
    schedule();
}

/// At once would draw every change of several that come together.
void Viewport::schedule() {
    if (!m_ready || m_underWay || m_pause.isActive() || !isVisible()) return;
    m_pause.start(std::max(0, static_cast<int>(m_pace.pause() - m_sincePicture.elapsed())));
}

PictureJob Viewport::job(const PictureSize& pixels) const {
    return {.stage = m_stage,
            .state = m_snapshot,
            .lines = std::make_shared<const std::vector<LineVertex>>(),
            .options = {.size = pixels,
                        .camera = m_camera,
                        .theme = viewTheme(m_dark),
                        .selected = m_selected,
                        .dimmed = m_dimmed,
                        .smooth = true}};
}

PictureJob Viewport::screenJob() {
    const double scale = devicePixelRatioF();
    const PictureSize size = pictureSize();
    PictureJob made = job({std::round(size.width * scale), std::round(size.height * scale)});
    if (!m_lines)
        m_lines = std::make_shared<const std::vector<LineVertex>>(
            hasScene() ? m_explanations.lines(*m_stage->pipeline, m_snapshot.get())
                       : std::vector<LineVertex>());
    made.lines = m_lines;
    made.options.smooth = !isMoving();
    return made;
}

void Viewport::drawForScreen() {
    if (m_underWay || !m_stale || !isVisible()) return;
    PictureJob next = screenJob();
    m_hurried = isMoving() && m_pace.leavesShadowsOut();
    next.options.shadows = !m_hurried;
    m_stale = false;
    m_underWay = true;
    if (m_screen)
        m_screen->post(std::move(next));
    else
        m_drawing.post(std::move(next));
}

void Viewport::takePicture(const DrawnPicture& picture) {
    m_underWay = false;
    m_sincePicture.lap();
    if (m_screen || !picture.image.isNull()) {
        m_shown = picture;
        m_shown.image.setDevicePixelRatio(devicePixelRatioF());
        if (!picture.job.options.smooth) m_pace.note(picture.milliseconds, !m_hurried);
        ++m_framesRendered;
        if (!m_screen) update();
        Q_EMIT frameRendered(picture.milliseconds);
    }
    if (m_stale) schedule();
}

void Viewport::moveCamera() {
    m_cameraMoved = true;
    redraw();
}

PictureSize Viewport::pictureSize() const {
    return {std::max(1.0, static_cast<double>(width())), std::max(1.0, static_cast<double>(height()))};
}

std::span<const Pose> Viewport::poses() const {
    if (m_snapshot) return m_snapshot->pose;
    return m_stage->start;
}

Ray Viewport::rayAt(const QPointF& position) const {
    Ray ray = rayThrough(m_camera, pictureSize(), {position.x(), position.y()});
    // An orthographic picture also shows what lies behind the plane of the eye.
    if (m_camera.orthographic) ray.origin -= 4 * (m_stage->room.extent + m_camera.distance) * ray.direction;
    return ray;
}

Hit Viewport::hitAt(const QPointF& position) const {
    if (!hasScene()) return {};
    return pick(rayAt(position), scene(), poses(), m_stage->room);
}

void Viewport::frameBox(const Aabb& box) {
    frame(m_camera, pictureSize(), box);
    redraw();
}

void Viewport::frameSelection() {
    if (!hasScene() || m_selected == noBody || isWall(scene().bodies[m_selected].shape)) return frameAll();
    const Vec3& centre = poses()[m_selected].position;
    const double radius = boundingRadiusOf(scene().bodies[m_selected].shape);
    m_cameraMoved = true;
    frameBox(grown({centre, centre}, selectionRadii * radius));
}

void Viewport::frameAll() {
    if (hasScene()) frameBox(boundsOf(scene(), poses()));
}

void Viewport::lookFrom(double yaw, double pitch) {
    m_camera.yaw = yaw;
    m_camera.pitch = pitch;
    moveCamera();
}

PictureJob Viewport::view(const QSize& pixels) const {
    PictureJob made = job({static_cast<double>(pixels.width()), static_cast<double>(pixels.height())});
    made.options.selected = noBody;
    made.options.dimmed = false;
    return made;
}

QImage Viewport::picture(const QSize& size) {
    if (size.isEmpty()) return {};
    PictureJob made = job({static_cast<double>(size.width()), static_cast<double>(size.height())});
    if (hasScene())
        made.lines = std::make_shared<const std::vector<LineVertex>>(
            m_explanations.lines(*m_stage->pipeline, made.state.get()));
    made.options.dimmed = false;
    return m_drawing.draw(std::move(made));
}

QImage Viewport::shownPicture() {
    const PictureJob made = screenJob();
    QImage image = m_drawing.draw(made);
    if (image.isNull()) return image;
    image.setDevicePixelRatio(devicePixelRatioF());
    QPainter painter(&image);
    paintLabelsOf(painter, made);
    return image;
}

void Viewport::paintLabelsOf(QPainter& painter, const PictureJob& job) const {
    if (job.stage->pipeline && holds(overlays(), Overlay::Labels))
        paintLabels(painter, job.stage->pipeline->scene(), job.poses(), job.options.camera, pictureSize(),
                    m_dark);
}

void Viewport::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    if (m_shown.image.isNull()) {
        const Eigen::Vector3f sky = viewTheme(m_dark).skyHorizon;
        painter.fillRect(rect(), QColor::fromRgbF(sky.x(), sky.y(), sky.z()));
        return;
    }
    // After a change of size the last picture is stretched until the next has come.
    painter.drawImage(rect(), m_shown.image);
    paintLabelsOf(painter, m_shown.job);
}

void Viewport::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    redraw();
}

void Viewport::mousePressEvent(QMouseEvent* event) {
    const bool another = event->buttons() != Qt::MouseButtons(event->button());
    if (m_grab) letGo();
    if (another && m_letGo) return;
    m_letGo = false;
    m_pressedAt = m_lastAt = event->position();
    m_dragging = false;
    const bool turns = event->button() != Qt::LeftButton || event->modifiers().testFlag(Qt::ShiftModifier);
    if (!turns) m_grab = grabAt(event->position());
}

/// The tips of velocities lie over the bodies, where they are shown.
std::optional<BodyGrab> Viewport::grabAt(const QPointF& position) const {
    if (!hasScene() || !m_mayDrag) return std::nullopt;
    const Eigen::Vector2d pixel(position.x(), position.y());
    if (holds(overlays(), Overlay::Velocities)) {
        const std::span<const Vec3> velocities =
            m_snapshot ? m_snapshot->velocity : m_stage->pipeline->initialState().velocity;
        const std::optional<BodyGrab> tip = grabTip(m_camera, pictureSize(), pixel, poses(), velocities);
        if (tip && m_mayDrag(tip->body, tip->handle)) return tip;
    }
    const Hit hit = hitAt(position);
    if (!hit || isWall(scene().bodies[hit.body].shape)) return std::nullopt;
    if (!m_mayDrag(hit.body, BodyHandle::Centre)) return std::nullopt;
    const Vec3& centre = poses()[hit.body].position;
    return BodyGrab{hit.body, BodyHandle::Centre, centre, centre, pixel};
}

void Viewport::dragBody(const QPointF& position, bool level) {
    const Vec3 value = draggedValue(*m_grab, m_camera, pictureSize(), {position.x(), position.y()}, level);
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
    if (m_grab->handle == BodyHandle::Centre)
        moved.pose[m_grab->body].position = value;
    else
        moved.velocity[m_grab->body] = value;
    showSnapshot(std::make_shared<const Snapshot>(std::move(moved)));
    Q_EMIT dragged(value);
}

void Viewport::letGo() {
    const bool held = std::exchange(m_grab, std::nullopt).has_value();
    m_letGo = held;
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

void Viewport::mouseMoveEvent(QMouseEvent* event) {
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
    if (m_dragging && held) Q_EMIT dragEnded();
    if (m_dragging || event->button() != Qt::LeftButton) return;
    const Hit hit = hitAt(event->position());
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
    constexpr double quarter = std::numbers::pi / 2;
    const bool pad = event->modifiers().testFlag(Qt::KeypadModifier);
    if (event->key() == Qt::Key_F && event->modifiers() == Qt::NoModifier)
        frameSelection();
    else if (event->key() == Qt::Key_Home)
        frameAll();
    else if (pad && event->key() == Qt::Key_7)
        lookFrom(0, quarter);
    else if (pad && event->key() == Qt::Key_1)
        lookFrom(0, 0);
    else if (pad && event->key() == Qt::Key_3)
        lookFrom(quarter, 0);
    else if (pad && event->key() == Qt::Key_5) {
        m_camera.orthographic = !m_camera.orthographic;
        moveCamera();
    } else
        QWidget::keyPressEvent(event);
}

void Viewport::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    if (m_screen) m_screen->setGeometry(rect());
    placeBadge();
    if (!m_cameraMoved) frameAll();
    redraw();
}

void Viewport::placeBadge() {
    m_badge->adjustSize();
    m_badge->move((width() - m_badge->width()) / 2, 12);
}

} // namespace carom

#include "moc_viewport.cpp"
