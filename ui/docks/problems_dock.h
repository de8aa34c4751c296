// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/docks/problems_model.h"

#include <QDockWidget>

class QSortFilterProxyModel;
class QTreeView;

namespace carom {

class EmptyState;

/// Every diagnostic of the text in a table; activating a row goes to its place.
class ProblemsDock : public QDockWidget {
    Q_OBJECT
  public:
    explicit ProblemsDock(const Theme& theme, QWidget* parent = nullptr);

    void show(const SharedBuild& result);
    void setTheme(const Theme& theme);

  Q_SIGNALS:
    void placeActivated(carom::SourceRange range);

  private:
    ProblemsModel* m_model;
    QSortFilterProxyModel* m_sorted;
    QTreeView* m_view;
    EmptyState* m_state;
};

} // namespace carom
