// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/window/theme.h"

#include <QMainWindow>

#include <functional>

class QLabel;
class QSplitter;
class QToolBar;

namespace carom {

class AccuracyDock;
class Actions;
class BreakpointsDock;
class BroadphaseDock;
class EffectsDock;
class FindBar;
class OutlineDock;
class InspectorDock;
class OutputDock;
class PlotsDock;
class ProgressStrip;
class ProblemsDock;
class SceneEditor;
class Settings;
class Timeline;
class StabilityDock;
class TimingDock;
class TransportBar;
class Viewport;
class Workspaces;

/// The window: owns the widgets and places them, and nothing else. What they show and do is the Workbench's.
///
///     menu bar, toolbar
///     editor            │ viewport
///     find bar          │                 outline | effects
///     timeline ──────────────────────────
///     transport ─────────────────────────
///     problems | timing | broad-phase | plots | accuracy | breakpoints | output | stability
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
    ProblemsDock& problems() const { return *m_problems; }
    TimingDock& timing() const { return *m_timing; }
    BroadphaseDock& broadphase() const { return *m_broadphase; }
    AccuracyDock& accuracy() const { return *m_accuracy; }
    OutlineDock& outline() const { return *m_outline; }
    EffectsDock& effects() const { return *m_effects; }
    InspectorDock& inspector() const { return *m_inspector; }
    BreakpointsDock& breakpoints() const { return *m_breakpoints; }
    PlotsDock& plots() const { return *m_plots; }
    OutputDock& output() const { return *m_output; }
    StabilityDock& stability() const { return *m_stability; }
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
    void placeDocks();
    void addDockToggles();
    void addWorkspaceButtons(QToolBar& toolbar);

    Actions* m_actions;
    SceneEditor* m_editor;
    FindBar* m_findBar;
    Viewport* m_viewport;
    Timeline* m_timeline;
    TransportBar* m_transport;
    ProblemsDock* m_problems;
    TimingDock* m_timing;
    BroadphaseDock* m_broadphase;
    AccuracyDock* m_accuracy;
    OutlineDock* m_outline;
    EffectsDock* m_effects;
    InspectorDock* m_inspector;
    PlotsDock* m_plots;
    BreakpointsDock* m_breakpoints;
    OutputDock* m_output;
    StabilityDock* m_stability;
    QSplitter* m_splitter = nullptr;
    Workspaces* m_workspaces = nullptr;
    ProgressStrip* m_buildProgress;
    QLabel* m_warning;
    QLabel* m_memory;
    QLabel* m_caret;
    std::function<bool()> m_mayClose;
};

} // namespace carom
