// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/base/actions.h"
#include "ui/base/settings.h"

#include <QByteArray>
#include <QObject>

#include <cstdint>

class QDockWidget;
class QMainWindow;
class QSplitter;
class QToolBar;

namespace carom {

enum class WorkspaceId : std::uint8_t {
#define CAROM_WORKSPACE(id, panels, text, below) id,
#include "ui/window/workspaces.def"
#undef CAROM_WORKSPACE
};

/// Four arrangements of the panels: to write, to watch, to measure, to study. Each is kept as it was left and
/// can be put back to how it came. Sizes are kept as shares of the window: they follow its size, and a small
/// window, where panels are narrower than anyone wished, does not change them. Only dragging an edge does.
class Workspaces : public QObject {
    Q_OBJECT
  public:
    /// The window has all its panels and they are where they belong.
    Workspaces(QMainWindow& window, QSplitter& splitter, const Actions& actions);

    /// Takes up the arrangement of the last session.
    void restore(const Settings& settings);
    void save(Settings& settings) const;
    WorkspaceId current() const { return m_current; }
    void show(WorkspaceId id);

    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    void divide();
    void noteDrag();
    WindowShares measured() const;
    QDockWidget* panelIn(Qt::DockWidgetArea area) const;
    void arrange(WorkspaceId id);
    void resetCurrent();
    void dropLinesUnderTabs();
    QAction& actionOf(WorkspaceId id) const;

    QMainWindow& m_window;
    QSplitter& m_splitter;
    const Actions& m_actions;
    QByteArray m_pristine;  ///< every panel at its first place
    WindowShares m_shares;  ///< as wished
    WindowShares m_pressed; ///< as they were when the mouse was pressed on an edge
    WorkspaceId m_current = WorkspaceId::Write;
};

} // namespace carom
