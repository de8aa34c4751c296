// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

class QAction;
class QLabel;
class QProgressBar;

namespace carom {

/// In the status bar while something takes its time: what it is, how far, how long still, and a button that
/// ends it. Hidden otherwise.
class ProgressStrip : public QWidget {
    Q_OBJECT
  public:
    /// `cancel` is what the button does.
    ProgressStrip(const QString& what, QAction& cancel, QWidget* parent = nullptr);

    /// The part done, 0..1, and the seconds left.
    void showProgress(double done, double secondsLeft);

  private:
    QString m_what;
    QLabel* m_text;
    QProgressBar* m_bar;
};

} // namespace carom
