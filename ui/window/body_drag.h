// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/index.h"
#include "core/math/types.h"
#include "ui/viewport/body_grab.h"

#include <QByteArray>
#include <QObject>

#include <cstdint>
#include <string>

namespace carom {

class LiveBuild;
class LivePreview;
class SceneEditor;
class Simulation;
class Viewport;

/// Bodies are arranged with the mouse: at time 0 a body, a handle of its gizmo or the tip of its velocity
/// arrow is dragged in the viewport, and the numbers of `centre`, `vel`, `rotation` or `axis` in its
/// declaration follow, with the decimals they have. A cuboid that gives no `rotation` gets one. Nothing else
/// in the text changes, and a drag is one undo step.
class BodyDrag : public QObject {
    Q_OBJECT
  public:
    BodyDrag(SceneEditor& editor, Viewport& viewport, Simulation& simulation, const LiveBuild& builds,
             const LivePreview& preview);

  private:
    bool mayDrag(BodyIndex body, BodyHandle handle) const;
    void begin(BodyIndex body, BodyHandle handle);
    void moveTo(const DraggedBody& now);
    Vec3 valueOf(const DraggedBody& now) const;
    void end();
    /// While a body is dragged: a shortcut ends the drag first, whatever has the keyboard.
    bool eventFilter(QObject* watched, QEvent* event) override;

    SceneEditor& m_editor;
    Viewport& m_viewport;
    Simulation& m_simulation;
    const LiveBuild& m_builds;
    const LivePreview& m_preview;
    // Of the drag under way.
    BodyHandle m_handle = BodyHandle::Centre;
    bool m_isAxis = false;       ///< of a cylinder: its direction, not a rotation
    std::string m_original;      ///< the value as it was written, or as it is to be inserted
    Vec3 m_start = Vec3::Zero(); ///< the numbers in it
    std::uint32_t m_offset = 0;  ///< of the value in the text [bytes]
    QByteArray m_written;        ///< what stands there now
    bool m_dragging = false;
};

} // namespace carom
