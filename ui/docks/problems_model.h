// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/editor/live_build.h"
#include "ui/window/theme.h"

#include <QAbstractTableModel>

namespace carom {

/// The diagnostics of a build as rows.
class ProblemsModel : public QAbstractTableModel {
    Q_OBJECT
  public:
    enum ColumnId { Message, Line, Column, Code, ColumnCount };
    enum { SortRole = Qt::UserRole };

    ProblemsModel(const Theme& theme, QObject* parent);

    void show(const SharedBuild& result);
    void setTheme(const Theme& theme);
    SourceRange rangeAt(int row) const;

    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

  private:
    QVariant text(const Diagnostic& diagnostic, int column) const;
    QVariant sortKey(const Diagnostic& diagnostic, int column) const;
    QIcon iconOf(Severity severity) const;

    SharedBuild m_result;
    QIcon m_error, m_warning, m_hint;
};

} // namespace carom
