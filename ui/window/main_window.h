// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/base/theme.h"

#include <QMainWindow>

#include <functional>
#include <vector>

class QLabel;
class QSplitter;
class QToolBar;

namespace carom {

class Actions;
class FindBar;
class Panel;
class ProgressStrip;
class SceneEditor;
class Settings;
class Timeline;
class TransportBar;
class Viewport;
class Workspaces;
#define CAROM_PANEL(name, Name, place, key, icon) class Name##Dock;
#include "ui/docks/panels.def"
#undef CAROM_PANEL

/// The window: owns the widgets and places them, and nothing else. What they show and do is the Workbench's.
///
///     menu bar, toolbar
///     editor            │ viewport
///     find bar          │                 outline | effects
///     timeline ──────────────────────────
///     transport ─────────────────────────
///     problems | timing | broad-phase | plots | accuracy | breakpoints | checks | output | stability | race
///     | sweep
class MainWindow : public QMainWindow {
    Q_OBJECT
  public:
    MainWindow(const Theme& theme, const Settings& settings);
    ~MainWindow() override;

    Actions& actions() const { return *m_actions; }
    SceneEditor& editor() const { return *m_editor; }
    FindBar& findBar() const { return *m_findBar; }
    Viewport& viewport() const { return *m_viewport; }
    Timeline& timeline() const { return *m_timeline; }
    TransportBar& transport() const { return *m_transport; }
#define CAROM_PANEL(name, Name, place, key, icon)                                                            \
    Name##Dock& name() const { return *m_##name; }
#include "ui/docks/panels.def"
#undef CAROM_PANEL
    const std::vector<Panel*>& panels() const { return m_panels; }
    /// Of a build that takes its time.
    ProgressStrip& buildProgress() const { return *m_buildProgress; }

    void setTheme(const Theme& theme);
    /// Takes up the actions' keys anew: the editor gives up its own use of them.
    void releaseKeys();
    /// In front, with the keyboard in it.
    void open(QDockWidget& dock);
    /// A sentence in the status bar, for a while or, with 0, until the next; as much of it as fits.
    void tell(const QString& sentence, int milliseconds = 0);
    /// What the user has to know until it is over, an empty text; beside the place of the caret.
    void warn(const QString& sentence);
    /// What a run takes of its budget, in the status bar; the tip says what for.
    void showMemory(const QString& words, const QString& tip);
    void showCaret(std::uint32_t line, std::uint32_t column);
    void saveLayout(Settings& settings) const;
    /// Asked before the window closes; false keeps it open.
    void setMayClose(std::function<bool()> mayClose) { m_mayClose = std::move(mayClose); }

  Q_SIGNALS:
    void fileDropped(const QString& path);

  protected:
    void closeEvent(QCloseEvent* event) override;
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;

  private:
    void placeCentre();
    void makePanels(const Theme& theme);
    void placePanels();
    void addPanelToggles();
    void addWorkspaceButtons(QToolBar& toolbar);

    Actions* m_actions;
    SceneEditor* m_editor;
    FindBar* m_findBar;
    Viewport* m_viewport;
    Timeline* m_timeline;
    TransportBar* m_transport;
#define CAROM_PANEL(name, Name, place, key, icon) Name##Dock* m_##name = nullptr;
#include "ui/docks/panels.def"
#undef CAROM_PANEL
    std::vector<Panel*> m_panels; ///< in the order of panels.def
    QSplitter* m_splitter = nullptr;
    Workspaces* m_workspaces = nullptr;
    ProgressStrip* m_buildProgress;
    QLabel* m_warning;
    QLabel* m_memory;
    QLabel* m_caret;
    std::function<bool()> m_mayClose;
};

} // namespace carom
