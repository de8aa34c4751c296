// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/benchmark.h"
#include "ui/base/study_runner.h"
#include "ui/widgets/benchmark_charts.h"

#include <QWidget>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;

namespace carom {

class EmptyState;
class ExportMenu;
class ValueTable;

/// "Compare all": every broad-phase on the scene from its start, over the same frames, or on a generator's
/// scenes of growing size; what each took, as a table, as charts and as files. It works on a thread and on
/// worlds of its own; the running simulation goes on. Stopped early, it shows what was computed.
class BroadphaseComparison : public QWidget {
    Q_OBJECT
  public:
    explicit BroadphaseComparison(QWidget* parent = nullptr);

    /// The scene to compare on next; figures of the one before stay, and say so. May be null.
    void setPipeline(std::shared_ptr<const Pipeline> pipeline);
    /// The newest comparison; nothing before the first.
    const std::optional<Benchmark>& result() const { return m_result; }
    /// Writes .png, .svg, .pdf (the chart shown) or .csv (a row an algorithm) by the path's ending. Returns
    /// what went wrong, or an empty text.
    QString exportTo(const QString& path) const;
    /// A row a frame and algorithm; returns likewise. Comparisons on a generator keep no frames.
    QString exportFramesTo(const QString& path) const;

    /// What it needs with the chart beside the table [px].
    int widthSideBySide() const;
    /// Puts the chart below the table, or beside it.
    void stack(bool stacked);

  Q_SIGNALS:
    /// What was compared or written, or why not: one sentence.
    void reported(const QString& sentence);

  private:
    using Study = std::function<Benchmark(const BenchmarkListener& goOn)>;
    enum class Remaining { Foreseeable, Unknown }; ///< whether frames later on take about as long

    void startOrStop();
    Study chosenStudy() const;
    StudyRunner::Finish run(const std::stop_token& stop, const Study& study, Remaining remaining);
    void showProgress(std::int64_t done, std::int64_t total, std::optional<double> secondsLeft);
    void finish(const Benchmark& result, double seconds);
    void updateControls();
    static QString listOf(const QStringList& names);
    QString sentenceOf(const Benchmark& result) const;
    void showTable();
    void showChart();
    void askForExport(const QString& ending, QString (BroadphaseComparison::*write)(const QString&) const);

    std::shared_ptr<const Pipeline> m_pipeline, m_compared;
    std::optional<Benchmark> m_result;
    std::vector<NamedChart> m_charts;
    QPushButton* m_button;
    QComboBox* m_subject; ///< the data of an item is the generator's name, none for the scene
    QProgressBar* m_progress;
    QLabel* m_state;
    QComboBox* m_chart;
    ExportMenu* m_export;
    EmptyState* m_empty;
    ValueTable* m_table = nullptr;
    PlotWidget* m_plot;
    StudyRunner m_runner; ///< last: its study ends before what it speaks to
};

} // namespace carom
