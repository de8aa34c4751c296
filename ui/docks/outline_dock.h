// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/docks/outline_model.h"
#include "ui/base/panel.h"

class QLineEdit;
class QSortFilterProxyModel;
class QTreeView;

namespace carom {

class EmptyState;

/// Every declaration of the text, with its label; choosing one goes to it. The row of the declaration at the
/// caret is marked. A line above narrows the list to what contains the words written there.
class OutlineDock : public Panel {
    Q_OBJECT
  public:
    explicit OutlineDock(const Theme& theme, QWidget* parent = nullptr);

    void show(const SharedBuild& result);
    void setTheme(const Theme& theme) override;
    void followCaret(std::uint32_t offset);

  Q_SIGNALS:
    void placeActivated(carom::SourceRange range);

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    void fitColumns();
    void markRow();

    OutlineModel* m_model;
    QSortFilterProxyModel* m_filtered;
    QLineEdit* m_filter;
    QTreeView* m_view;
    EmptyState* m_state;
    std::uint32_t m_caret = 0;
};

} // namespace carom
