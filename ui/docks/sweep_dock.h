// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/clock.h"
#include "core/language/parameter_change.h"
#include "core/study/sweep_files.h"
#include "ui/base/panel.h"
#include "ui/base/study_runner.h"
#include "ui/editor/live_build.h"
#include "ui/widgets/sweep_charts.h"

#include <QTimer>

#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;
class QToolButton;

namespace carom {

class EmptyState;
class ExportMenu;
class SweepForm;

/// The scene in the editor, run again and again with other numbers in its text: what `carom sweep` does, from
/// a form. Runs are made on the threads that the window leaves; the chart grows with them. A sweep can be
/// paused, kept beside the next one, exported as the command line would have written it, and copied as its
/// command. A click on a point shows that run as a ghost, and writes its values into the text if asked.
class SweepDock : public Panel {
    Q_OBJECT
  public:
    explicit SweepDock(QWidget* parent = nullptr);

    /// Runs of a sweep in the window at most: the panel keeps all results; at ten times that takes ten times
    /// the memory and time. Larger sweeps belong to `carom sweep`.
    static constexpr std::size_t mostRuns = 100'000;

    /// The scene to sweep next; the figures of the one before stay. `name` is the file's, `path` where it is,
    /// empty where it is nowhere yet.
    void setScene(const SharedBuild& build, const QString& name, const QString& path);
    SweepForm& form() const { return *m_form; }
    /// What the form asks for, for a shell.
    QString command() const;
    /// Of the newest sweep; null before the first.
    const Sweep* sweep() const { return m_sweep.get(); }
    const std::vector<SweepResult>& results() const { return m_results; } ///< in the order of the runs
    /// Writes .png, .svg, .pdf (the chart) or .csv (a row a run) by the path's ending. Returns what went
    /// wrong, or an empty text.
    QString exportTo(const QString& path) const override;
    /// Writes what `carom sweep -o FOLDER` does: of a sweep that was paused, what `--resume` goes on with.
    QString exportFolder(const QString& folder) const;

  Q_SIGNALS:
    /// Show this run beside that of the scene; null: none any more.
    void ghostWanted(const std::shared_ptr<const carom::Pipeline>& pipeline);
    /// Put these values into the text.
    void valuesWanted(const std::vector<carom::ParameterValue>& values);

  private:
    QWidget* makeFigures();
    void connectControls();
    void startOrPause();
    /// Whether the sweep was paused and is still what form and text say.
    bool canGoOn() const;
    StudyRunner::Finish run(const std::stop_token& stop, const SweepDefinition& definition,
                            const std::string& text);
    StudyRunner::Finish goOn(const std::stop_token& stop, const std::shared_ptr<const Sweep>& sweep,
                             std::vector<bool> known);
    void refuse(const QString& objection);
    void collect();
    void finish();
    void showProgress();
    void showChart();
    void choosePoint(std::size_t series, std::size_t mark);
    void chooseRun(std::optional<std::size_t> run);
    void buildChosen();
    void askForFolder();
    void updateControls();
    const SweepChart* shownChart() const; ///< null: none
    void nameCharts();

    SharedBuild m_build;
    QString m_name, m_path;
    std::shared_ptr<const Sweep> m_sweep;
    QString m_sweptName;
    std::vector<SweepResult> m_results; ///< in the order of the runs
    SweepPoints m_points;
    std::vector<SweepChart> m_charts;
    std::optional<ChartSpec> m_kept;
    std::optional<std::size_t> m_chosen; ///< a run
    bool m_ghostIsWanted = false;        ///< of the run chosen: to be built when the one before is
    std::size_t m_before = 0;            ///< runs that were there when it went on
    Stopwatch m_since;

    std::mutex m_mutex; ///< of what waits
    std::vector<SweepResult> m_waiting;
    std::shared_ptr<const Sweep> m_begun; ///< with what waits

    SweepForm* m_form;
    QPushButton* m_start;
    QToolButton *m_copy, *m_keep;
    QProgressBar* m_progress;
    QLabel* m_state;
    QComboBox* m_shown; ///< the measure of the chart
    ExportMenu* m_export;
    PlotWidget* m_plot;
    QLabel* m_point;
    QPushButton *m_use, *m_hide;
    EmptyState* m_empty;
    QTimer m_poll;
    double m_chartCost = 0; ///< of the last chart [ms]
    Stopwatch m_sinceChart;
    StudyRunner m_builder, m_runner; ///< last: their work ends before what it speaks to
};

} // namespace carom
