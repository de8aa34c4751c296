// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/viewport/camera.h"
#include "ui/viewport/drawing_place.h"
#include "ui/viewport/drawing_thread.h"
#include "ui/viewport/explanations.h"
#include "ui/viewport/gestures.h"
#include "ui/viewport/gizmo.h"
#include "ui/viewport/picking.h"
#include "ui/viewport/picture_schedule.h"
#include "ui/viewport/view_cube.h"

#include <QImage>
#include <QPointF>
#include <QWidget>

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

class QLabel;
class QPainter;

namespace carom {

class OpenGLScreen;
class OverlayLegend;

/// Shows one scene in its newest state. Left drag orbits, or moves a body where that is allowed: at its
/// height, or as the handles of its gizmo say where it is selected; with Ctrl in round steps. Right or middle
/// drag pans, the wheel zooms at the cursor, a click selects, a right click asks for the menu; F frames the
/// selection, Home everything; a click on the cube in the corner looks from that side, as do 7, 1, 3 of the
/// number pad (top, front, right), and 5 changes between perspective and orthographic.
class Viewport : public QWidget {
    Q_OBJECT

  public:
    explicit Viewport(QWidget* parent = nullptr);
    ~Viewport() override;

    /// Before it is first shown; until then a thread draws. Automatic waits until it is known what there is.
    void drawIn(DrawingPlace place);
    bool drawsInWindow() const { return m_screen != nullptr; }

    /// A new scene at its start. The camera stays, unless this is the first scene since the last clearing or
    /// the scene's own `camera` declaration has changed. Null clears.
    void showPipeline(std::shared_ptr<const Pipeline> pipeline);
    /// The newest state of the scene shown; a state of another scene is not taken.
    void showSnapshot(std::shared_ptr<const Snapshot> snapshot);
    /// The cells or nodes that Overlay::Structure draws with the snapshot that comes next.
    void showStructure(std::vector<Aabb> boxes);
    /// The run before an edit, drawn as wire with the snapshot that comes next; an empty one clears.
    void showGhost(const Ghost& ghost);
    /// Outlines a body; noBody clears.
    void setSelectedBody(BodyIndex body);
    BodyIndex selectedBody() const { return m_selected; }
    /// Selects the first body, outlines the second one, too, and brings the point between them [m] into view.
    void showPair(BodyIndex first, BodyIndex second, const Vec3& point);
    /// Greys the picture and shows why, while the text does not build.
    void setDimmed(bool dimmed, const QString& badge);
    void setDarkTheme(bool dark);

    /// Which buttons turn, move and zoom.
    void setNavigation(const NavigationRow& preset) { m_gestures.setNavigation(preset); }
    /// Which explanations are drawn over the bodies.
    void setOverlays(Overlays overlays);
    void setOverlay(Overlay overlay, bool shown);
    Overlays overlays() const { return m_explanations.overlays(); }

    const Camera& camera() const { return m_camera; }
    void setCamera(const Camera& camera);
    /// World metres that a pixel covers at the camera's target.
    double pixelSize() const { return m_camera.pixelSize(pictureSize()); }
    /// Asked before a drag takes hold of a body instead of turning the view; by default nothing can be taken.
    void setMayDrag(std::function<bool(BodyIndex, BodyHandle)> mayDrag) { m_mayDrag = std::move(mayDrag); }
    /// What the overlays show at a point of the widget [px], in words.
    QString tipAtPoint(const QPointF& position) const;
    /// What a click at a point of the widget would select [px].
    Hit hitAt(const QPointF& position) const;

    /// The scene as it is looked at now, without what is marked in it, to be drawn elsewhere.
    PictureJob view(const QSize& pixels) const;
    /// The view as a picture of any size [px], with what the overlays draw. Null where OpenGL does not work
    /// or the size is too much for it.
    QImage picture(const QSize& size);

    /// What belongs on the screen now, drawn anew and waited for; in device pixels.
    QImage shownPicture();

    std::int64_t framesRendered() const { return m_framesRendered; }
    double lastRenderTime() const { return m_shown.milliseconds; } ///< [ms], until the picture was complete
    /// Of the state that the picture on screen shows.
    std::int64_t shownFrame() const { return m_shown.job.state ? m_shown.job.state->frame : 0; }

    /// What stands beside the mouse: what a drag has come to, or what the overlays show under it.
    const QString& told() const { return m_told; }

    QSize sizeHint() const override { return {800, 600}; }

  public Q_SLOTS:
    /// Everything, where nothing is selected.
    void frameSelection();
    void frameAll();

    /// Ends a drag of a body, if one is under way, where it is.
    void letGo() { m_gestures.letGo(); }
    /// Shows the body that is held as it is to be, where that is not quite where the mouse is.
    void showDragged(const DraggedBody& now);
    void lookFrom(carom::ViewSide side);
    void setOrthographic(bool orthographic);
    /// Shows again what a drag has moved since the scene was shown: it has come to nothing.
    void forgetDrag();

  Q_SIGNALS:
    /// noBody: the background.
    void bodyClicked(carom::BodyIndex body);
    /// The menu is wanted there, on the screen; noBody: of the background.
    void menuWanted(const QPoint& place, carom::BodyIndex body);
    /// A body, or the tip of its velocity, follows the mouse.
    void dragBegan(carom::BodyIndex body, carom::BodyHandle handle);
    void dragged(const carom::DraggedBody& now);
    void dragEnded();
    /// By the user, or by setCamera.
    void cameraMoved();
    /// Between perspective and orthographic.
    void orthographicChanged(bool orthographic);
    /// A new picture is about to be on screen.
    void frameRendered(double milliseconds);
    /// The picture cannot be drawn, and why.
    void failed(const QString& problem);

  protected:
    void paintEvent(QPaintEvent* event) override;
    void showEvent(QShowEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void leaveEvent(QEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;
    void hideEvent(QHideEvent* event) override;

  private:
    PictureSize pictureSize() const;
    std::span<const Pose> poses() const;
    Ray rayAt(const QPointF& position) const;
    void frameBox(const Aabb& box);
    void placeBadge();
    std::optional<BodyGrab> grabAt(const QPointF& position) const;
    std::vector<GizmoHandle> gizmo(const PictureJob& job) const;
    bool mayTurn(BodyIndex body) const;
    void dragBody(const QPointF& position, bool snaps);
    void click(Qt::MouseButton button, const QPointF& place);
    void point(const QPointF& position);
    void listenToGestures();
    void paintOver(QPainter& painter, const PictureJob& job) const;
    void repaintOver();
    void showLegend();
    void moveCamera();
    bool hasScene() const { return m_stage->pipeline != nullptr; }
    const Scene& scene() const { return m_stage->pipeline->scene(); }
    /// Something to be seen has changed.
    void redraw();
    PictureJob job(const PictureSize& pixels) const;
    PictureJob screenJob();
    void drawForScreen();
    void takePicture(const DrawnPicture& picture);
    void paintLabelsOf(QPainter& painter, const PictureJob& job) const;

    DrawingThread m_drawing;
    OpenGLScreen* m_screen = nullptr; ///< null: pictures come from m_drawing
    std::shared_ptr<const Stage> m_stage = std::make_shared<const Stage>(); ///< never null
    std::shared_ptr<const Snapshot> m_snapshot;
    std::shared_ptr<const Snapshot> m_beforeDrag; ///< null where the start was shown
    bool m_moved = false;                         ///< by a drag, since the scene was shown
    Explanations m_explanations;
    std::shared_ptr<const std::vector<LineVertex>>
        m_lines; ///< of m_snapshot; null when they must be made anew
    DrawnPicture m_shown;
    Camera m_camera;
    CameraSettings m_declaredCamera;
    PictureSchedule m_schedule{[this] { return isVisible(); }};
    bool m_cameraMoved = false; ///< by the user: resizing no longer frames the scene anew
    bool m_dark = true;
    bool m_dimmed = false;
    BodyIndex m_selected = noBody;
    QLabel* m_badge = nullptr;
    Gestures m_gestures{[this](const QPointF& place) { return grabAt(place); }};
    std::function<bool(BodyIndex, BodyHandle)> m_mayDrag;
    QPointF m_mouseAt; ///< [px]
    QString m_told;    ///< what the drag has come to, or the overlays show under the mouse
    OverlayLegend* m_legend;
    GizmoPart m_lit = GizmoPart::None; ///< under the mouse
    std::optional<ViewSide> m_litSide; ///< of the cube, likewise
    std::int64_t m_framesRendered = 0;
};

} // namespace carom
