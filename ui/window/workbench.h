// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/editor/live_build.h"
#include "ui/base/document.h"
#include "ui/base/settings.h"

#include <QObject>

#include <memory>

namespace carom {

class DiagnosticMarks;
class ExpectationCommands;
class FileCommands;
class FrameLog;
class HelpCommands;
class LanguageCommands;
class LivePreview;
class MainWindow;
class MemoryUse;
class PictureCommands;
class Recovery;
class RunCommands;
class Selection;
class Simulation;

/// The IDE put together: the window's widgets on one side, document, builds and simulation on the other, and
/// the signals between them. What happens on a keystroke reads from top to bottom in connectText().
class Workbench : public QObject {
    Q_OBJECT
  public:
    Workbench();
    ~Workbench() override;

    MainWindow& window() const { return *m_window; }
    Document& document() const { return *m_document; }
    LiveBuild& builds() const { return *m_builds; }
    Simulation& simulation() const { return *m_simulation; }
    FrameLog& frames() const { return *m_frames; }
    FileCommands& files() const { return *m_files; }
    const LivePreview& preview() const { return *m_preview; }
    const MemoryUse& memory() const { return *m_memory; }
    PictureCommands& pictures() const { return *m_pictures; }

    HelpCommands& help() const { return *m_help; }
    const ExpectationCommands& expectations() const { return *m_expectations; }

    /// What a session without a scene begins with: the file opened last, at the place one was at; else, and
    /// then it returns false, a first scene to play with.
    bool openLastOrFirst();
    /// Asks about the text of a session that crashed, if there is one, and takes it up; true if it did.
    bool offerRecovery();
    /// Plays the scene; one that is still being built as soon as it is.
    void playWhenBuilt();
    /// Keeps unsaved text in a swap file from now on.
    void keepUnsavedText();

  private:
    void connectText();
    void connectProgress();
    void connectAccuracy();
    void connectReports();
    void warnOfNoScene(const BuildResult& result);
    void showBuild(const SharedBuild& result);
    void connectPreferences();
    void showPreferences();
    void takeMemoryBudget();
    void connectTheme();
    void setDark(bool dark);

    Settings m_settings;
    std::unique_ptr<MainWindow> m_window;
    std::unique_ptr<Document> m_document;
    std::unique_ptr<LiveBuild> m_builds;
    std::unique_ptr<Simulation> m_simulation;
    std::unique_ptr<FrameLog> m_frames;
    std::unique_ptr<Recovery> m_recovery; ///< null until unsaved text is kept
    // Owned by the widgets or objects they serve.
    DiagnosticMarks* m_marks;
    LanguageCommands* m_language;
    LivePreview* m_preview;
    FileCommands* m_files;
    HelpCommands* m_help;
    RunCommands* m_runs;
    MemoryUse* m_memory;
    ExpectationCommands* m_expectations;
    PictureCommands* m_pictures = nullptr;
    Selection* m_selection;
};

} // namespace carom
