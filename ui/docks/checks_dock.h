// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/base/panel.h"
#include "ui/base/theme.h"
#include "ui/editor/check_rows.h"

#include <cstdint>
#include <vector>

class QLabel;
class QTreeWidget;
class QTreeWidgetItem;

namespace carom {

class EmptyState;

/// Every expectation of the text: whether it holds, what was measured when it was nearest to failing, how
/// many digits of what is allowed are to spare, and where it first failed. A click goes to its line, a double
/// click on one that has failed to that frame.
class ChecksDock : public Panel {
    Q_OBJECT
  public:
    explicit ChecksDock(const Theme& theme, QWidget* parent = nullptr);

    /// `step` [s] is the length of a frame.
    void show(const std::vector<CheckRow>& rows, double step);
    void setTheme(const Theme& theme) override;

  Q_SIGNALS:
    void placeActivated(carom::SourceRange range);
    void frameActivated(std::int64_t frame);

  private:
    enum Column { Expected, Measured, Spare, FailedAt, ColumnCount };

    void fill(QTreeWidgetItem& item, const CheckRow& row);
    void sumUp();

    Theme m_theme;
    std::vector<CheckRow> m_rows;
    double m_step = 0; ///< [s]
    QTreeWidget* m_table;
    QLabel* m_sum;
    EmptyState* m_state;
};

} // namespace carom
