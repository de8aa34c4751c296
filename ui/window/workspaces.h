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
class QTabBar;
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
/// The panels below can be collapsed to their tabs, in all workspaces: by the menu or a double click on a
/// tab; a click on a tab brings them back.
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
    /// The panels below are no longer collapsed to their tabs: somebody wants to see one.
    void expand();

    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    void divide();
    void noteDrag();
    WindowShares measured() const;
    enum class Where : bool { OnScreen, Anywhere }; ///< also behind others, or of no height yet
    QDockWidget* panelIn(Qt::DockWidgetArea area, Where where = Where::OnScreen) const;
    void arrange(WorkspaceId id);
    void arrangeAnew(const char* panels);
    void resetCurrent();
    void limitHeight(QDockWidget& dock);
    void limitHeights();
    void collapse(bool collapsed);
    void dressTabs();
    bool isBelow(const QTabBar& tabs) const;
    QAction& actionOf(WorkspaceId id) const;

    QMainWindow& m_window;
    QSplitter& m_splitter;
    const Actions& m_actions;
    QByteArray m_pristine;       ///< every panel at its first place
    WindowShares m_shares;       ///< as wished
    WindowShares m_pressed;      ///< as they were when the mouse was pressed on an edge
    bool m_clickExpands = false; ///< the last click on a tab did, so a second one collapses nothing
    WorkspaceId m_current = WorkspaceId::Write;
};

} // namespace carom
