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

  Q_SIGNALS:
    /// "png", "svg", "pdf" or "csv".
    void chosen(const QString& ending);
};

/// Asks where to write; empty if the user changed their mind. The path always has an ending.
QString askForExportPath(QWidget* parent, const QString& name, const QString& ending);

/// What was written where, or why not; an empty problem is success.
QString exportSentence(const QString& path, const QString& problem);

} // namespace carom
