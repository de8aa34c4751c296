// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/player/speed_meter.h"
#include "ui/base/theme.h"

#include <QObject>
#include <QString>

#include <cstdint>
#include <optional>
#include <utility>

namespace carom {

class FrameLog;
class LivePreview;
class MainWindow;
class Simulation;
struct BroadphaseRow;
struct RunStatus;

/// The Simulation menu and the transport bar, and the way of snapshots and samples to what shows them.
class RunCommands : public QObject {
    Q_OBJECT
  public:
    RunCommands(MainWindow& window, Simulation& simulation, FrameLog& log, LivePreview& preview);

    void setTheme(const Theme& theme);
    /// What became of so much energy [J]: "0.25 J lost"; less than none is gained.
    static QString energyWords(double lost);

  Q_SIGNALS:
    void reported(const QString& sentence);

  private:
    void connectActions();
    void connectFrames();
    void connectPanels();
    void connectBreakpoints();
    void connectGuard();
    void connectStories();
    void stepUnlessHeld(void (Simulation::*step)());
    /// Notices whether a key is pressed or held.
    bool eventFilter(QObject* watched, QEvent* event) override;
    void describeRun();
    void showStatus(const RunStatus& status);
    void noteSpeed(double time);
    QString whyItStopped(const RunStatus& status) const;

    MainWindow& m_window;
    Simulation& m_simulation;
    FrameLog& m_log;
    LivePreview& m_preview;
    const BroadphaseRow* m_broadphase = nullptr; ///< chosen in its panel; null: what the scene asks for
    std::optional<std::pair<std::int64_t, QString>>
        m_hit; ///< frame and words of the last breakpoint that held
    SpeedMeter m_speed;
    bool m_keyHeld = false; ///< the last key came of its own, because it is held down
    Theme m_theme;
};

} // namespace carom
