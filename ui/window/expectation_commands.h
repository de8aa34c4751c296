// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/editor/check_rows.h"

#include <QObject>
#include <QTimer>

#include <memory>
#include <vector>

namespace carom {

class DiagnosticMarks;
class ExpectationMarks;
class LiveBuild;
class LivePreview;
class MainWindow;
class Simulation;
struct Theme;

/// The way of what the simulation says of the scene's expectations to the editor's margin, the timeline and
/// the Checks panel, and from there to the frame or line one clicks on. Expectations of a text that is not
/// the one that runs wait.
class ExpectationCommands : public QObject {
    Q_OBJECT
  public:
    ExpectationCommands(MainWindow& window, Simulation& simulation, const LiveBuild& builds,
                        const LivePreview& preview, DiagnosticMarks& marks);

    /// The text has been built anew.
    void takeText();
    void setTheme(const Theme& theme);
    /// Puts an expectation behind the text, as one undo step, and shows it; bodies are those on screen.
    void write(const Expectation& expectation);
    /// Of the text, as they are shown.
    const std::vector<CheckRow>& rows() const { return m_rows; }

  Q_SIGNALS:
    void reported(const QString& sentence);

  private:
    void connectPlaces();
    bool runsWhatIsWritten() const;
    void refresh();

    MainWindow& m_window;
    Simulation& m_simulation;
    const LiveBuild& m_builds;
    const LivePreview& m_preview;
    ExpectationMarks* m_marks;
    std::shared_ptr<const JudgedRun> m_run; ///< null: nothing has been said of the scene that is loaded
    std::vector<CheckRow> m_rows;
    QTimer m_refresh; ///< messages in a text are laid out anew: a few times a second
};

} // namespace carom
