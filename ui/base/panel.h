// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDockWidget>

namespace carom {

struct Theme;

/// What every panel has in common: its title is the dock's, its keyboard focus the focus proxy's, and
/// ui/docks/panels.def says where it stands, with which key and icon. Most panels need no theme: the palette
/// is the application's.
class Panel : public QDockWidget {
    Q_OBJECT
  public:
    using QDockWidget::QDockWidget;

    virtual void setTheme(const Theme& theme);

  Q_SIGNALS:
    /// What was done, or why not: one sentence for the status bar and the Output panel.
    void reported(const QString& sentence);
};

} // namespace carom
