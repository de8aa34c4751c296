// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QStackedWidget>
#include <QString>

class QLabel;

namespace carom {

/// A panel that has nothing to show says so, and what one would do to change that.
class EmptyState : public QStackedWidget {
    Q_OBJECT
  public:
    EmptyState(QWidget* content, const QString& hint, QWidget* parent = nullptr);

    void setEmpty(bool empty);
    void setHint(const QString& hint);

  private:
    QLabel* m_hint;
};

} // namespace carom
