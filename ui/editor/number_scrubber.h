// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/editor/scene_editor.h"

#include "core/language/number_step.h"

#include <QObject>
#include <QPoint>
#include <QTimer>

#include <optional>

class QMouseEvent;
class QWheelEvent;

namespace carom {

/// Turns numbers in the text: Alt+wheel or Ctrl+Shift+wheel over one, or Alt and a drag that begins on one,
/// by steps of its second significant digit (with Alt, Shift makes them ten times larger and Ctrl smaller). A
/// drag, or a turn of the wheel without a pause, is one undo step.
class NumberScrubber : public QObject {
    Q_OBJECT
  public:
    explicit NumberScrubber(SceneEditor& editor);

    /// Turns the number at the caret, as one undo step; false where there is none.
    bool turnAtCaret(int steps);

    /// A drag that a handle beside the number makes, without Alt: takes hold of the number at a place (false
    /// where there is none), turns it by as many steps as a way to the right has [px], each 10^power times as
    /// large, and ends the undo step.
    bool hold(std::uint32_t offset);
    void drag(int way, int power);
    void letGo();

  Q_SIGNALS:
    /// After each step: the picture should follow at once.
    void turned();

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    struct Grip {
        NumberAt number;      ///< its range is kept up to date
        bool isWhole = false; ///< takes no fraction
        QByteArray original;  ///< the literal when it was taken hold of
        QByteArray written;   ///< what stands there now
    };

    bool take(std::uint32_t offset);
    bool takeUnder(const QPoint& place);
    void turnTo(std::int64_t steps, int power = 0);
    bool press(const QMouseEvent& event);
    bool move(const QMouseEvent& event);
    bool wheel(const QWheelEvent& event);

    SceneEditor& m_editor;
    std::optional<Grip> m_grip; ///< while it stands an undo step is open
    bool m_dragging = false;
    QPoint m_pressedAt;
    int m_wheel = 0; ///< [eighths of a degree] turned since the number was taken
    std::int64_t m_wheelSteps = 0;
    int m_wheelPower = 0; ///< of the steps
    QTimer m_pause;       ///< ends a turn of the wheel
};

} // namespace carom
