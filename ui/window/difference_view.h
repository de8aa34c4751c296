// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QByteArray>
#include <QColor>
#include <QPlainTextEdit>

namespace carom {

struct Theme;

/// The lines in which two texts differ, with a few around them: `-` and red is gone, `+` and green is new.
class DifferenceView : public QPlainTextEdit {
    Q_OBJECT
  public:
    explicit DifferenceView(const Theme& theme, QWidget* parent = nullptr);

    void show(const QByteArray& before, const QByteArray& after);

  private:
    QColor m_good, m_error;
};

} // namespace carom
