// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/editor/scene_editor.h"

#include <QObject>

class QMouseEvent;

namespace carom {

/// Alt and the left button select a rectangle of the text, also behind the ends of its lines; on a number
/// they turn it (NumberScrubber). The editing widget itself selects lines then. Ctrl and a click add a caret,
/// or take away the one that is there.
class RectangleDrag : public QObject {
    Q_OBJECT
  public:
    explicit RectangleDrag(SceneEditor& editor);

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    /// The corner under the mouse: the caret's, and the opposite one if the drag begins here.
    void addCaret(const QPoint& place);
    void takeCorner(const QMouseEvent& event, bool begins);

    SceneEditor& m_editor;
    bool m_dragging = false;
};

} // namespace carom
