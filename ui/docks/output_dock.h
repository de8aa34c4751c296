// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/base/panel.h"

class QPlainTextEdit;

namespace carom {

/// What was done, each line with the time of day.
class OutputDock : public Panel {
    Q_OBJECT
  public:
    explicit OutputDock(QWidget* parent = nullptr);

    void add(const QString& line);

  private:
    QPlainTextEdit* m_text;
};

} // namespace carom
