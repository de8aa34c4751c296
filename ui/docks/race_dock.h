// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/clock.h"
#include "core/study/race.h"
#include "ui/base/panel.h"
#include "ui/base/study_runner.h"
#include "ui/editor/live_build.h"
#include "ui/widgets/plot.h"

#include <QTimer>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

class QBoxLayout;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QPushButton;
class QSlider;
class QSpinBox;
class QToolButton;

namespace carom {

class EmptyState;
class ExportMenu;
class Viewport;

/// Two runs of the scene side by side: with two settings, or with the text beside an earlier one or a file.
/// Two viewports with one camera and one time show both, a chart shows the greatest distance of a body from
/// itself as it grows, and the first bit that differs is named. The runs are computed on a thread of their
/// own and played in real time as far as they are there.
class RaceDock : public Panel {
    Q_OBJECT
  public:
    explicit RaceDock(QWidget* parent = nullptr);
    ~RaceDock() override;

    void setTheme(const Theme& theme) override;
    /// The scene of the next race; the one under way, or shown, stays. `name` is the file's.
    void setScene(const SharedBuild& build, const QString& name);
    /// The second run is of this text from now on; an empty one: of the first one's.
    void setOtherText(const QString& text, const QString& name);

    /// Of the newest race; null before the first.
    const RaceRecording* recording() const { return m_recording.get(); }
    std::int64_t shownFrame() const { return m_frame; }
    /// From the first race on.
    Viewport& viewport(std::size_t side) const { return *m_views[side]; }
    /// Writes .png, .svg, .pdf (the chart) or .csv (a row a frame) by the path's ending. Returns what went
    /// wrong, or an empty text.
    QString exportTo(const QString& path) const override;

  private:
    /// What one of the two runs is made with.
    struct Side {
        QComboBox *preset, *method, *integrator;
        QSpinBox* substeps;
        QLabel* title; ///< above its viewport
    };

    /// What is asked for, taken to the thread.
    struct Plan {
        SharedBuild build;
        std::string otherText; ///< empty: the build's
        std::array<SimulationSettings, 2> settings;
        std::array<QString, 2> names; ///< of the texts
        double duration = 0;          ///< [s]
    };
    /// What comes back before the first step.
    struct Contest {
        std::array<std::shared_ptr<const Pipeline>, 2> runs;
        std::array<QString, 2> names;
        std::shared_ptr<RaceRecording> recording;
        std::int64_t frames = 0;
    };

    Side makeSide(const QString& name, const QString& suffix);
    QWidget* makeBoth();
    void makeViews();
    QWidget* makeTop();
    void connectControls();
    SimulationSettings settingsOf(const Side& side) const;
    void startOrStop();
    StudyRunner::Finish run(const std::stop_token& stop, const Plan& plan);
    void begin(const Contest& contest);
    void refuse(const QString& sentence);
    void finish();
    void follow();
    void play(bool plays);
    void showFrame(std::int64_t frame);
    void showPoints();
    void showDifference();
    void askForOtherFile();
    void updateControls();
    ChartSpec chart() const;

    SharedBuild m_build;
    QString m_name;
    QString m_otherText, m_otherName; ///< of the second run; empty: the first one's
    std::shared_ptr<RaceRecording> m_recording;
    std::array<std::shared_ptr<const Pipeline>, 2> m_raced; ///< of the recording
    std::vector<double> m_times, m_distances;               ///< what the chart shows [s], [m]
    std::int64_t m_frame = 0;                               ///< on screen
    double m_time = 0;                                      ///< [s], of what is played; between frames
    bool m_linking = false;                                 ///< one camera follows the other

    QPushButton* m_start;
    QDoubleSpinBox* m_duration; ///< [s]
    QToolButton* m_other;       ///< the menu of the second run's text
    QLabel* m_state;
    QPushButton* m_first; ///< the first difference; goes there
    ExportMenu* m_export;
    QToolButton* m_play;
    QSlider* m_slider;
    std::array<Side, 2> m_sides;
    std::array<QBoxLayout*, 2> m_places{}; ///< of the viewports
    std::array<Viewport*, 2> m_views{};    ///< from the first race on: each draws in a thread of its own
    bool m_dark = true;
    PlotWidget* m_plot;
    EmptyState* m_empty;
    QTimer m_clock; ///< while it plays, or is computed
    Stopwatch m_sinceTick, m_sinceChart;
    StudyRunner m_runner; ///< last: its study ends before what it speaks to
};

} // namespace carom
