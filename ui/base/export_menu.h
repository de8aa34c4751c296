// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QToolButton>

namespace carom {

/// The button with which every chart is written to a file: PNG, SVG, PDF or CSV.
class ExportMenu : public QToolButton {
    Q_OBJECT
  public:
    explicit ExportMenu(QWidget* parent = nullptr);

    /// One more entry, for figures of another kind; whoever adds it connects it.
    QAction& addEntry(const QString& text);

  Q_SIGNALS:
    /// "png", "svg", "pdf" or "csv".
    void chosen(const QString& ending);
};

/// Asks where to write; empty if the user changed their mind. The path always has an ending.
QString askForExportPath(QWidget* parent, const QString& name, const QString& ending);

/// Whether the path's ending asks for figures; else for a chart.
bool isCsv(const QString& path);

/// What was written where, or why not; an empty problem is success.
QString exportSentence(const QString& path, const QString& problem);

} // namespace carom
