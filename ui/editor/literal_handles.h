// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/editor/scene_editor.h"

#include <QTimer>
#include <QWidget>

namespace carom {

class ColourSwatch;
class NumberHandle;
class NumberScrubber;

/// What can be taken hold of beside the literals of the text: under a number the mouse is over, or that is
/// selected, a handle that turns it when it is dragged, as Alt and a drag on the number do where the window
/// manager leaves Alt to us; beside a colour a square of it, which asks for another one when it is clicked.
class LiteralHandles : public QObject {
    Q_OBJECT
  public:
    LiteralHandles(SceneEditor& editor, NumberScrubber& scrubber);

    /// Asks for another colour in place of the one at the caret; false where there is none.
    bool pickColourAtCaret();

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    void lookAt(const QPoint& place);
    void lookAtSelection();
    bool offerNumber(std::int64_t offset);
    bool offerColour(std::int64_t offset);
    void place(QWidget& handle, std::int64_t offset, int x) const;
    void hide();
    void pick(std::int64_t offset);

    SceneEditor& m_editor;
    NumberHandle* m_number;
    ColourSwatch* m_colour;
    QTimer m_leave; ///< the mouse is between a literal and its handle
};

} // namespace carom
