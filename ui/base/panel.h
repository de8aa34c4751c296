// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDockWidget>

namespace carom {

class ExportMenu;
struct Theme;

/// What every panel has in common: its title is the dock's, its keyboard focus the focus proxy's, and
/// ui/docks/panels.def says where it stands, with which key and icon. Most panels need no theme: the palette
/// is the application's. Many export what they show.
class Panel : public QDockWidget {
    Q_OBJECT
  public:
    using QDockWidget::QDockWidget;

    virtual void setTheme(const Theme& theme);
    /// Writes what the panel shows by the path's ending: .png, .svg, .pdf (its chart) or .csv (its figures).
    /// Returns what went wrong, or an empty text.
    virtual QString exportTo(const QString& path) const;

  Q_SIGNALS:
    /// What was done, or why not: one sentence for the status bar and the Output panel.
    void reported(const QString& sentence);

  protected:
    /// The button that exports what the panel shows, to files that are called `name` if the user agrees.
    ExportMenu* makeExportMenu(const QString& name);
    /// Asks where to, exports and reports it; returns the sentence, empty if the user changed their mind.
    QString askForExport(const QString& name, const QString& ending);
};

} // namespace carom
