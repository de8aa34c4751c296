// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/viewport.h"

#include "core/base/clock.h"
#include "ui/viewport/instances.h"
#include "ui/viewport/navigation.h"
#include "ui/viewport/renderer.h"

#include <QApplication>
#include <QKeyEvent>
#include <QLabel>
#include <QMouseEvent>
#include <QOpenGLContext>
#include <QOpenGLFramebufferObject>
#include <QPainter>
#include <QSurfaceFormat>
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
constexpr double typingPause = 3;       ///< in times of a picture, between two of them while somebody types
constexpr double selectionRadii = 5;    ///< a framed body is shown with this much around it

bool same(const CameraSettings& a, const CameraSettings& b) {
    return a.position == b.position && a.target == b.target && a.fieldOfView == b.fieldOfView;
}

/// Knows when a key was last pressed, anywhere in the program.
class Typing : public QObject {
  public:
    static Typing& instance() {
        static Typing* const typing = new Typing; // the application's, which it ends with
        return *typing;
    }
    bool isUnderWay() const { return m_pressed && m_since.elapsed() < goesOnFor; }

  protected:
    bool eventFilter(QObject* object, QEvent* event) override {
        if (event->type() == QEvent::KeyPress) {
            m_pressed = true;
            m_since.lap();
        }
        return QObject::eventFilter(object, event);
    }

  private:
    Typing() : QObject(qApp) { qApp->installEventFilter(this); }

    static constexpr double goesOnFor = 400; // [ms] after a key
    bool m_pressed = false;
    Stopwatch m_since;
};

bool declared(const CameraSettings& camera) { return camera.position || camera.target; }

} // namespace

Viewport::Viewport(QWidget* parent)
    : QOpenGLWidget(parent), m_badge(new QLabel(this)), m_navigation(&navigationPresets().front()) {
    QSurfaceFormat format;
    format.setVersion(3, 3);
    format.setProfile(QSurfaceFormat::CoreProfile);
    format.setDepthBufferSize(24);
    format.setStencilBufferSize(8);
    setFormat(format);
    setFocusPolicy(Qt::StrongFocus);
    setMinimumSize(120, 90);
    setAccessibleName(tr("Viewport"));
    m_badge->setObjectName(QStringLiteral("viewportBadge"));
    m_badge->setStyleSheet(
        QStringLiteral("background: rgba(170, 60, 30, 220); color: white; padding: 5px 10px;"
                       "border-radius: 4px;"));
    m_badge->setAttribute(Qt::WA_TransparentForMouseEvents);
    m_badge->hide();
    m_rest.setSingleShot(true);
    m_rest.setInterval(restAfter);
    connect(&m_rest, &QTimer::timeout, this, [this] {
        m_atRest = true;
        update();
    });
    m_pause.setSingleShot(true);
    connect(&m_pause, &QTimer::timeout, this, qOverload<>(&Viewport::update));
}

Viewport::~Viewport() {
    if (context()) disconnect(context(), nullptr, this, nullptr);
    dropRenderer();
}

void Viewport::dropRenderer() {
    // Its buffers belong to the context, which is about to go.
    makeCurrent();
    m_renderer.reset();
    m_ready = false;
    doneCurrent();
}

void Viewport::showPipeline(std::shared_ptr<const Pipeline> pipeline) {
    const bool first = !m_pipeline;
    m_pipeline = std::move(pipeline);
    m_snapshot.reset();
    m_explanations.clear();
    m_startPoses.clear();
    m_pace.forget();
    m_sceneChanged = m_linesChanged = true;
    redraw();
    if (!m_pipeline) {
        m_room = {};
        m_selected = noBody;
        return;
    }
    const Scene& scene = m_pipeline->scene();
    for (const Body& body : scene.bodies) m_startPoses.push_back(body.pose);
    m_room = roomOf(scene, boundsOf(scene, m_startPoses));
    if (m_selected != noBody && m_selected >= scene.bodies.size()) m_selected = noBody;
    if (first) {
        m_camera = Camera{};
        m_cameraMoved = false;
        frameAll();
    }
    if (first || !same(scene.camera, m_declaredCamera)) {
        apply(m_camera, scene.camera);
        if (declared(scene.camera)) m_cameraMoved = true;
    }
    m_declaredCamera = scene.camera;
}

void Viewport::showSnapshot(std::shared_ptr<const Snapshot> snapshot) {
    if (!m_pipeline || !snapshot || snapshot->pose.size() != m_startPoses.size()) return;
    m_snapshot = std::move(snapshot);
    m_explanations.note(*m_pipeline, *m_snapshot);
    m_linesChanged = true;
    redraw();
}

void Viewport::showStructure(std::vector<Aabb> boxes) {
    m_explanations.setStructure(std::move(boxes));
    m_linesChanged = true;
    redraw();
}

void Viewport::showGhost(const Ghost& ghost) {
    m_explanations.setGhost(ghost);
    m_linesChanged = true;
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
    m_linesChanged = true;
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
    if (m_ready && m_renderer->isSoftware()) m_rest.start();
    if (m_pause.isActive()) return;
    // A picture under way delays a key, and one that is due goes to the display together with the text.
    const bool yields = m_ready && m_renderer->isSoftware() && Typing::instance().isUnderWay();
    const double pause = yields ? typingPause * m_lastRenderTime : m_pace.pause();
    const double wait = pause - m_sincePicture.elapsed();
    if (wait > 1)
        m_pause.start(static_cast<int>(wait));
    else
        update();
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
    return m_startPoses;
}

Ray Viewport::rayAt(const QPointF& position) const {
    Ray ray = rayThrough(m_camera, pictureSize(), {position.x(), position.y()});
    // An orthographic picture also shows what lies behind the plane of the eye.
    if (m_camera.orthographic) ray.origin -= 4 * (m_room.extent + m_camera.distance) * ray.direction;
    return ray;
}

Hit Viewport::hitAt(const QPointF& position) const {
    if (!m_pipeline) return {};
    return pick(rayAt(position), m_pipeline->scene(), poses(), m_room);
}

void Viewport::frameBox(const Aabb& box) {
    frame(m_camera, pictureSize(), box);
    redraw();
}

void Viewport::frameSelection() {
    if (!m_pipeline || m_selected == noBody || isWall(m_pipeline->scene().bodies[m_selected].shape))
        return frameAll();
    const Vec3& centre = poses()[m_selected].position;
    const double radius = boundingRadiusOf(m_pipeline->scene().bodies[m_selected].shape);
    m_cameraMoved = true;
    frameBox(grown({centre, centre}, selectionRadii * radius));
}

void Viewport::frameAll() {
    if (m_pipeline) frameBox(boundsOf(m_pipeline->scene(), poses()));
}

void Viewport::lookFrom(double yaw, double pitch) {
    m_camera.yaw = yaw;
    m_camera.pitch = pitch;
    moveCamera();
}

void Viewport::initializeGL() {
    // Comes again with a new context when the widget moves to another window.
    connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, &Viewport::dropRenderer,
            Qt::UniqueConnection);
    m_renderer = std::make_unique<Renderer>();
    m_ready = m_renderer->initialise();
    m_sceneChanged = m_linesChanged = true;
    if (!m_ready) Q_EMIT failed(m_renderer->problem());
    redraw();
}

void Viewport::resizeGL(int, int) {
    if (!m_cameraMoved) frameAll();
}

void Viewport::prepareScene() {
    static const Scene nothing;
    if (m_sceneChanged) m_renderer->show(m_pipeline ? m_pipeline->scene() : nothing, m_room);
    m_sceneChanged = false;
}

QImage Viewport::picture(const QSize& size, const Snapshot* of) {
    if (!m_ready || size.isEmpty() || (of != nullptr && of->pose.size() != m_startPoses.size())) return {};
    const Snapshot* state = of != nullptr ? of : m_snapshot.get();
    makeCurrent();
    QImage image;
    {
        QOpenGLFramebufferObject target(size, QOpenGLFramebufferObject::CombinedDepthStencil);
        if (target.isValid() && target.bind()) {
            prepareScene();
            m_renderer->showLines(m_pipeline ? m_explanations.lines(*m_pipeline, state)
                                             : std::vector<LineVertex>());
            const double width = size.width(), height = size.height();
            m_renderer->draw(state != nullptr ? std::span<const Pose>(state->pose) : poses(),
                             {.size = {width, height},
                              .camera = m_camera,
                              .theme = viewTheme(m_dark),
                              .selected = of != nullptr ? noBody : m_selected,
                              .dimmed = false,
                              .smooth = true});
            image = target.toImage().convertToFormat(QImage::Format_RGB32);
        }
    }
    m_linesChanged = true; // those of the screen again
    doneCurrent();
    update();
    return image;
}

void Viewport::paintEvent(QPaintEvent* event) {
    m_onScreen = true;
    QOpenGLWidget::paintEvent(event);
    m_onScreen = false;
}

void Viewport::paintGL() {
    if (!m_ready) return;
    const Stopwatch watch;
    prepareScene();
    if (m_linesChanged)
        m_renderer->showLines(m_pipeline ? m_explanations.lines(*m_pipeline, m_snapshot.get())
                                         : std::vector<LineVertex>());
    m_linesChanged = false;
    const double scale = devicePixelRatioF();
    const PictureSize size = pictureSize();
    const bool moving = m_renderer->isSoftware() && !m_atRest;
    const bool hurried = moving && m_onScreen && m_pace.leavesShadowsOut();
    m_renderer->draw(poses(), {.size = {std::round(size.width * scale), std::round(size.height * scale)},
                               .camera = m_camera,
                               .theme = viewTheme(m_dark),
                               .selected = m_selected,
                               .dimmed = m_dimmed,
                               .shadows = !hurried,
                               .smooth = !moving});
    if (m_pipeline && holds(overlays(), Overlay::Labels)) {
        QPainter painter(this);
        paintLabels(painter, m_pipeline->scene(), poses(), m_camera, size, m_dark);
    }
    // OpenGL only queues the work; the time that counts is the one until it is done.
    m_renderer->finish();
    m_lastRenderTime = watch.elapsed();
    if (moving && m_onScreen) m_pace.note(m_lastRenderTime, !hurried);
    m_sincePicture.lap();
    ++m_framesRendered;
    Q_EMIT frameRendered(m_lastRenderTime);
}

void Viewport::mousePressEvent(QMouseEvent* event) {
    m_pressedAt = m_lastAt = event->position();
    m_dragging = false;
    m_grab.reset();
    const bool turns = event->button() != Qt::LeftButton || event->modifiers().testFlag(Qt::ShiftModifier);
    if (!turns) m_grab = grabAt(event->position());
}

/// The tips of velocities lie over the bodies, where they are shown.
std::optional<BodyGrab> Viewport::grabAt(const QPointF& position) const {
    if (!m_pipeline || !m_mayDrag) return std::nullopt;
    const Eigen::Vector2d pixel(position.x(), position.y());
    if (holds(overlays(), Overlay::Velocities)) {
        const std::span<const Vec3> velocities =
            m_snapshot ? m_snapshot->velocity : m_pipeline->initialState().velocity;
        const std::optional<BodyGrab> tip = grabTip(m_camera, pictureSize(), pixel, poses(), velocities);
        if (tip && m_mayDrag(tip->body, tip->handle)) return tip;
    }
    const Hit hit = hitAt(position);
    if (!hit || isWall(m_pipeline->scene().bodies[hit.body].shape)) return std::nullopt;
    if (!m_mayDrag(hit.body, BodyHandle::Centre)) return std::nullopt;
    const Vec3& centre = poses()[hit.body].position;
    return BodyGrab{hit.body, BodyHandle::Centre, centre, centre, pixel};
}

void Viewport::dragBody(const QPointF& position, bool level) {
    const Vec3 value = draggedValue(*m_grab, m_camera, pictureSize(), {position.x(), position.y()}, level);
    // Shown at once; the scene itself follows when the text has been built.
    Snapshot moved;
    if (m_snapshot) {
        moved = *m_snapshot;
    } else {
        const State& start = m_pipeline->initialState();
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

void Viewport::mouseMoveEvent(QMouseEvent* event) {
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
        QOpenGLWidget::keyPressEvent(event);
}

void Viewport::resizeEvent(QResizeEvent* event) {
    QOpenGLWidget::resizeEvent(event);
    placeBadge();
}

void Viewport::placeBadge() {
    m_badge->adjustSize();
    m_badge->move((width() - m_badge->width()) / 2, 12);
}

} // namespace carom
