// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/accuracy.h"
#include "ui/base/study_runner.h"
#include "ui/editor/live_build.h"
#include "ui/widgets/accuracy_chart.h"
#include "ui/base/panel.h"

#include <memory>
#include <optional>
#include <vector>

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QMenu;
class QProgressBar;
class QPushButton;
class QSpinBox;
class QToolButton;

namespace carom {

class EmptyState;
class ExportMenu;

/// What accuracy costs in time on the scene in the editor: a study runs on a thread of its own, the diagram
/// grows with it, a click on a point runs that setting in the viewport or writes it into the text. A study
/// can be kept and shown together with the next one. Stopped early, it shows what was computed, and goes on
/// from there as long as the scene and the simulated time stay the same.
class AccuracyDock : public Panel {
    Q_OBJECT
  public:
    explicit AccuracyDock(QWidget* parent = nullptr);

    /// The scene to study next; the figures of the one before stay, and say so. `name` is the file's.
    void setScene(const SharedBuild& build, const QString& name);
    /// The newest study, also one that is under way; nothing before the first.
    const std::optional<AccuracyStudy>& result() const { return m_result; }
    /// Writes .png, .svg, .pdf (the diagram) or .csv (a row a point) by the path's ending. Returns what went
    /// wrong, or an empty text.
    QString exportTo(const QString& path) const override;

  Q_SIGNALS:
    /// Run the scene so, from its start.
    void runWanted(const std::shared_ptr<const carom::Pipeline>& pipeline);
    /// Put these settings into the text.
    void settingWanted(const carom::SimulationSettings& settings);

  private:
    void startOrStop();
    AccuracyPlan chosenPlan() const;
    /// Whether the study was stopped and what it has serves the scene as it is now.
    bool canGoOn() const;
    StudyRunner::Finish run(const std::stop_token& stop, const SharedBuild& build, const AccuracyPlan& plan,
                            const KnownPoints& known);
    void showProgress(double seconds, double budget);
    void take(const AccuracyStudy& study);
    void finish(const AccuracyStudy& study, double seconds);
    void showChart();
    /// The measure of the diagram, of a study that is there or of the next one.
    void chooseMeasureOf(AccuracyStudy& study) const;
    void choose(int series, int point);
    void updateControls();
    QMenu* knobsMenu();
    void offerEngines(QMenu& menu);

    SharedBuild m_build, m_studied, m_keptBuild;
    QString m_name, m_studiedName, m_keptName;
    std::optional<AccuracyStudy> m_result, m_kept;
    AccuracyChart m_chart;
    std::optional<AccuracyPoint> m_chosen;
    /// Checked: part of the study; the data is the name.
    std::vector<QAction*> m_methods, m_integrators, m_engines;
    QPushButton* m_start;
    QToolButton* m_knobs;
    QDoubleSpinBox* m_duration; ///< [s]
    QSpinBox* m_budget;         ///< [s] of wall time
    QComboBox* m_measure;       ///< the data is the name, empty: the first that says something
    QProgressBar* m_progress;
    QLabel* m_state;
    QLabel* m_verdict; ///< the sentence
    QToolButton* m_keep;
    ExportMenu* m_export;
    PlotWidget* m_plot;
    QLabel* m_point;
    QPushButton *m_run, *m_use;
    EmptyState* m_empty;
    StudyRunner m_runner; ///< last: its study ends before what it speaks to
};

} // namespace carom
