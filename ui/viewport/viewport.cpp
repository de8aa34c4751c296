// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/viewport.h"

#include "core/base/clock.h"
#include "ui/viewport/instances.h"
#include "ui/viewport/opengl_screen.h"
#include "ui/viewport/overlay_legend.h"
#include "ui/viewport/overlay_tips.h"

#include <QLabel>
#include <QPainter>

#include <algorithm>
#include <cmath>
#include <utility>

namespace carom {

namespace {

constexpr double selectionRadii = 5; ///< a framed body is shown with this much around it

bool same(const CameraSettings& a, const CameraSettings& b) {
    return a.position == b.position && a.target == b.target && a.fieldOfView == b.fieldOfView;
}

bool declared(const CameraSettings& camera) { return camera.position || camera.target; }

/// After a change of size the last picture is shown until the next has come: as high as the widget, since the
/// camera's angle is from top to bottom, and as wide as that makes it.
QRectF placeOfPicture(const QSize& picture, const QRectF& widget) {
    if (picture.isEmpty()) return {};
    constexpr double rounding = 1.5; // [px] by which one of fewer pixels may have another shape
    const double width = widget.height() * picture.width() / picture.height();
    if (std::abs(width - widget.width()) < rounding) return widget;
    return {widget.center().x() - width / 2, widget.y(), width, widget.height()};
}

} // namespace

Viewport::Viewport(QWidget* parent)
    : QWidget(parent), m_badge(new QLabel(this)), m_legend(new OverlayLegend(this)) {
    setAttribute(Qt::WA_OpaquePaintEvent);
    setFocusPolicy(Qt::StrongFocus);
    setMouseTracking(true);
    setContextMenuPolicy(Qt::PreventContextMenu); // a right drag moves the view; a click asks for the menu
    setMinimumSize(120, 90);
    setAccessibleName(tr("Viewport"));
    m_badge->setObjectName(QStringLiteral("viewportBadge"));
    m_badge->setProperty("role", QStringLiteral("badge"));
    m_badge->setAttribute(Qt::WA_TransparentForMouseEvents);
    m_badge->hide();
    connect(m_legend, &OverlayLegend::scaleChanged, this, [this](double scale) {
        m_explanations.setArrows(scale);
        m_lines.reset();
        showLegend();
        redraw();
    });
    listenToGestures();
    connect(&m_schedule, &PictureSchedule::due, this, &Viewport::drawForScreen);
    connect(&m_drawing, &DrawingThread::ready, this,
            [this](bool software) { m_schedule.setReady(software); });
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
    m_screen =
        new OpenGLScreen([this](QPainter& painter, const PictureJob& job) { paintOver(painter, job); }, this);
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
    m_schedule.forgetCosts();
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
    if (m_legend->isVisible()) showLegend();
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
    m_explanations.setPartner(noBody);
    m_lines.reset();
    redraw();
}

void Viewport::showPair(BodyIndex first, BodyIndex second, const Vec3& point) {
    if (!hasScene() || first >= scene().bodies.size()) return;
    m_selected = first;
    m_explanations.setPartner(second);
    m_lines.reset();
    // Where it can be seen already the camera stays.
    const std::optional<Eigen::Vector2d> at = projected(m_camera, pictureSize(), point);
    const QRectF middle =
        QRectF(rect()).adjusted(width() * 0.1, height() * 0.1, -width() * 0.1, -height() * 0.1);
    if (point.allFinite() && (!at || !middle.contains(at->x(), at->y()))) {
        m_camera.target = point;
        m_cameraMoved = true;
    }
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
    showLegend();
    redraw();
}

void Viewport::setOverlay(Overlay overlay, bool shown) {
    const Overlays one = static_cast<Overlays>(overlay);
    setOverlays(shown ? overlays() | one : overlays() & ~one);
}

void Viewport::setDarkTheme(bool dark) {
    m_dark = dark;
    showLegend();
    redraw();
}

void Viewport::setCamera(const Camera& camera) {
    m_camera = camera;
    moveCamera();
}

void Viewport::redraw() { m_schedule.changed(); }

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
    made.options.lineWidth *= scale;
    made.options.smooth = m_schedule.isSmooth();
    return made;
}

void Viewport::drawForScreen() {
    if (!m_schedule.begin()) return;
    PictureJob next = screenJob();
    next.options.shadows = m_schedule.hasShadows();
    if (m_screen)
        m_screen->post(std::move(next));
    else
        m_drawing.post(std::move(next));
}

void Viewport::takePicture(const DrawnPicture& picture) {
    const bool isThere = m_screen || !picture.image.isNull();
    if (isThere) {
        m_shown = picture;
        m_shown.image.setDevicePixelRatio(devicePixelRatioF());
        ++m_framesRendered;
        if (!m_screen) update();
        Q_EMIT frameRendered(picture.milliseconds);
    }
    m_schedule.ended(isThere ? picture.milliseconds : 0);
}

void Viewport::moveCamera() {
    m_cameraMoved = true;
    redraw();
    Q_EMIT cameraMoved();
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

void Viewport::lookFrom(ViewSide side) {
    carom::lookFrom(m_camera, side);
    moveCamera();
}

void Viewport::setOrthographic(bool orthographic) {
    if (m_camera.orthographic == orthographic) return;
    m_camera.orthographic = orthographic;
    moveCamera();
    Q_EMIT orthographicChanged(orthographic);
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
    paintOver(painter, made);
    return image;
}

void Viewport::paintLabelsOf(QPainter& painter, const PictureJob& job) const {
    if (job.stage->pipeline && holds(overlays(), Overlay::Labels))
        paintLabels(painter, job.stage->pipeline->scene(), job.poses(), job.options.camera, pictureSize(),
                    m_dark);
}

void Viewport::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    const QRectF place = placeOfPicture(m_shown.image.size(), rect());
    if (!place.contains(rect())) {
        const Eigen::Vector3f sky = viewTheme(m_dark).skyHorizon;
        painter.fillRect(rect(), QColor::fromRgbF(sky.x(), sky.y(), sky.z()));
    }
    if (m_shown.image.isNull()) return;
    painter.drawImage(place, m_shown.image);
    paintOver(painter, m_shown.job);
}

/// What lies over the picture and is of the widget, not of the scene: handles, labels, the cube.
void Viewport::paintOver(QPainter& painter, const PictureJob& job) const {
    paintLabelsOf(painter, job);
    const BodyGrab* held = m_gestures.held();
    paintGizmo(painter, gizmo(job), held != nullptr ? held->part : m_lit);
    paintViewCube(painter, job.options.camera, cubePlace(pictureSize()), m_dark, m_litSide);
    paintBeside(painter, m_mouseAt, m_told, rect(), m_dark);
}

/// Of the selected body, while it may be dragged.
std::vector<GizmoHandle> Viewport::gizmo(const PictureJob& job) const {
    const BodyIndex body = job.options.selected;
    if (body == noBody || body != m_selected || job.stage != m_stage || !m_mayDrag) return {};
    const BodyGrab* grab = m_gestures.held();
    const bool held = grab != nullptr && m_gestures.isDragging() && grab->body == body;
    if (isWall(scene().bodies[body].shape) || (!held && !m_mayDrag(body, BodyHandle::Centre))) return {};
    return gizmoOf(job.options.camera, pictureSize(), job.poses()[body].position, mayTurn(body));
}

/// Shapes that look different when they are turned.
bool Viewport::mayTurn(BodyIndex body) const {
    const Shape& shape = scene().bodies[body].shape;
    return std::holds_alternative<Cuboid>(shape) || std::holds_alternative<Cylinder>(shape);
}

QString Viewport::tipAtPoint(const QPointF& position) const {
    if (!hasScene() || !m_snapshot) return {};
    return tipAt({.scene = scene(),
                  .snapshot = *m_snapshot,
                  .overlays = overlays(),
                  .frame = m_stage->pipeline->settings().step,
                  .arrowTime = m_explanations.arrows() * velocityTime},
                 m_camera, pictureSize(), {position.x(), position.y()});
}

void Viewport::showLegend() {
    double largest = 0;
    if (m_snapshot)
        for (const ContactForce& contact : m_snapshot->contactForces)
            largest = std::max(largest, contact.force.norm());
    constexpr int leastHeight = 240; // [px] of a picture that has room for it
    m_legend->show(height() < leastHeight ? 0 : overlays(), largest, m_dark);
    placeBadge();
}

/// The picture is as it was; what lies over it is not.
void Viewport::repaintOver() {
    if (m_screen)
        m_screen->update();
    else
        update();
}

void Viewport::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    redraw();
}

void Viewport::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    if (m_screen) m_screen->setGeometry(rect());
    showLegend();
    if (!m_cameraMoved) frameAll();
    redraw();
}

void Viewport::placeBadge() {
    m_badge->adjustSize();
    m_badge->move((width() - m_badge->width()) / 2, 12);
    m_legend->move(10, height() - m_legend->height() - 10);
}

} // namespace carom

#include "moc_viewport.cpp"
