// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/editor/live_build.h"
#include "ui/base/theme.h"

#include <QAbstractTableModel>

#include <cstdint>
#include <optional>

namespace carom {

/// What is wrong with a run, where it shows.
struct RunProblem {
    std::int64_t frame = 0;
    QString message;
};

/// The diagnostics of a build as rows, and what is wrong with its run.
class ProblemsModel : public QAbstractTableModel {
    Q_OBJECT
  public:
    enum ColumnId { Message, Line, Column, Code, ColumnCount };
    enum { SortRole = Qt::UserRole };

    ProblemsModel(const Theme& theme, QObject* parent);

    void show(const SharedBuild& result);
    /// What the run on screen has come to, below what is wrong with the text; nothing clears it.
    void showRun(const std::optional<RunProblem>& problem);
    /// Of a row that is about the run: its frame.
    std::optional<std::int64_t> frameAt(int row) const;
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

    int ofText() const;
    QVariant ofRun(int column, int role) const;

    SharedBuild m_result;
    std::optional<RunProblem> m_run;
    QIcon m_error, m_warning, m_hint;
};

} // namespace carom
