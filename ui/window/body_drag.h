// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/index.h"
#include "core/math/types.h"

#include <QByteArray>
#include <QObject>

#include <cstdint>
#include <string>
#include <string_view>

namespace carom {

class LiveBuild;
class LivePreview;
class SceneEditor;
class Simulation;
class Viewport;

/// Bodies are arranged with the mouse: at time 0 a body, or the tip of its velocity arrow, is dragged in the
/// viewport, and the numbers of `centre` or `vel` in its declaration follow. Nothing else in the text
/// changes, and a drag is one undo step.
class BodyDrag : public QObject {
    Q_OBJECT
  public:
    BodyDrag(SceneEditor& editor, Viewport& viewport, Simulation& simulation, const LiveBuild& builds,
             const LivePreview& preview);

  private:
    bool mayDrag(BodyIndex body, std::string_view parameter) const;
    void begin(BodyIndex body, std::string_view parameter);
    void moveTo(const Vec3& value);
    void end();
    /// While a body is dragged: a shortcut ends the drag first, whatever has the keyboard.
    bool eventFilter(QObject* watched, QEvent* event) override;

    SceneEditor& m_editor;
    Viewport& m_viewport;
    Simulation& m_simulation;
    const LiveBuild& m_builds;
    const LivePreview& m_preview;
    // Of the drag under way.
    std::string m_original;     ///< the value as it was written
    std::uint32_t m_offset = 0; ///< of the value in the text [bytes]
    QByteArray m_written;       ///< what stands there now
    bool m_dragging = false;
};

} // namespace carom
