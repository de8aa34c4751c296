// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/bounded_series.h"
#include "core/simulation/quantities.h"
#include "ui/player/probe_run.h"
#include "ui/widgets/plot.h"
#include "ui/base/panel.h"

#include <QTimer>

#include <cstdint>
#include <memory>
#include <vector>

class QComboBox;
class QLabel;
class QListWidget;
class QToolButton;

namespace carom {

class BodyBox;

class EmptyState;

/// Curves over time: any quantity of any body or of the whole, from the start of the run to as far as it has
/// come, also when they are asked for late: then they are filled in in the background. Bodies are remembered
/// by name, so curves survive an edit. A long run's curves keep the least and the greatest figure of each
/// stretch of frames, so that memory does not grow with it.
class PlotsDock : public Panel {
    Q_OBJECT

  public:
    explicit PlotsDock(QWidget* parent = nullptr);

    /// The scene that runs; the same one again changes nothing.
    void showPipeline(std::shared_ptr<const Pipeline> pipeline);
    /// The run has come to this frame.
    void reach(std::int64_t frame);
    /// The frame on screen.
    void showFrame(std::int64_t frame);
    /// Adds a curve of the whole scene.
    void plotWhole(std::string_view quantity);
    /// Offers this body first; noBody: the whole.
    void offerBody(BodyIndex body);

    const ChartSpec& chart() const { return m_chart; }
    /// Memory of the curves [bytes].
    std::size_t bytes() const;
    /// Writes .png, .svg, .pdf (the chart) or .csv (every frame, or in a long run the least and greatest of
    /// each stretch) by the path's ending. Returns what went wrong, or an empty text.
    QString exportTo(const QString& path) const override;

  Q_SIGNALS:
    /// A click in the chart, at the time of this frame.
    void framePicked(std::int64_t frame);
    /// What a curve shows is to be expected of the scene from now on.
    void expectationWanted(const carom::Expectation& expectation);

  private:
    struct Curve {
        const QuantityRow* quantity = nullptr;
        bool ofWhole = true;
        QString body; ///< name; empty for the whole
        BoundedSeries figures;
    };

    void layOut();
    void fillQuantities();
    void addCurve();
    void add(Curve curve);
    void removeCurve();
    void offerExpectations();
    BodyIndex bodyOf(const Curve& curve) const;
    void restart();
    void extend();
    void take(const std::vector<ProbeRow>& rows);
    void redraw();
    void tellProgress();
    void pickAt(double time);
    double step() const;
    std::int64_t measured() const;
    QString titleOf(const Curve& curve) const;
    QString writeCsv(const QString& path) const;

    std::shared_ptr<const Pipeline> m_pipeline;
    std::vector<Curve> m_curves;
    std::int64_t m_reached = 0;
    std::int64_t m_shown = 0; ///< frame on screen
    ChartSpec m_chart;
    ProbeRun m_run;
    QTimer m_refresh; ///< a chart of thousands of frames takes 10 ms to draw: a few times a second
    BodyBox* m_bodies;
    QComboBox* m_quantities;
    QListWidget* m_list;
    QToolButton* m_add;
    QToolButton* m_remove;
    QToolButton* m_expect;
    PlotWidget* m_plot;
    EmptyState* m_state;
    QLabel* m_progress; ///< of curves that are behind the run
};

} // namespace carom
