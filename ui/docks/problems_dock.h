// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/docks/problems_model.h"
#include "ui/base/panel.h"

class QSortFilterProxyModel;
class QTreeView;

namespace carom {

class EmptyState;

/// Every diagnostic of the text in a table, and what went wrong in the run; activating a row goes to its
/// place or frame.
class ProblemsDock : public Panel {
    Q_OBJECT
  public:
    explicit ProblemsDock(const Theme& theme, QWidget* parent = nullptr);

    void show(const SharedBuild& result);
    /// What the run on screen has come to; nothing clears it.
    void showRun(const std::optional<RunProblem>& problem);
    void setTheme(const Theme& theme) override;

  Q_SIGNALS:
    void placeActivated(carom::SourceRange range);
    void frameActivated(std::int64_t frame);

  private:
    void showCount();

    ProblemsModel* m_model;
    QSortFilterProxyModel* m_sorted;
    QTreeView* m_view;
    EmptyState* m_state;
};

} // namespace carom
