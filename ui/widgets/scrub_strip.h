// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QWidget>

namespace carom {

/// A strip that stands for time from left to right: a press or a drag with the left button goes to a place,
/// and the mouse at rest over it is told what is there.
class ScrubStrip : public QWidget {
    Q_OBJECT
  public:
    using QWidget::QWidget;

  protected:
    /// `x` is of the widget [px].
    virtual void goTo(double x) = 0;
    /// Empty where there is nothing.
    virtual QString tellOf(double x) const = 0;

    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    bool event(QEvent* event) override;
};

} // namespace carom
