// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/player/sample_queue.h"
#include "core/player/simulation_thread.h"

#include "core/simulation/pipeline.h"
#include "core/simulation/snapshot.h"

#include <QObject>
#include <QTimer>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace carom {

/// The GUI's side of a running scene: turns calls into commands and what comes back into signals. Every call
/// returns at once. What an earlier run still had on its way when it was loaded over or reset is dropped
/// here.
class Simulation : public QObject {
    Q_OBJECT
  public:
    explicit Simulation(QObject* parent = nullptr);

    /// Puts a scene at frame 0, paused.
    void load(std::shared_ptr<const Pipeline> pipeline);
    /// Simulates a scene up to the time that is on screen, and goes on from there as it did. The run before
    /// stays on screen until landed().
    void exchange(std::shared_ptr<const Pipeline> pipeline);
    void play();
    void pause();
    void togglePlay();
    void step();
    void stepBack();
    /// To a frame, where it has been or not; whether it plays or not does not change.
    void seek(std::int64_t frame);
    /// To frame 0, paused. What was simulated stays at hand until another scene is loaded.
    void reset();
    /// Simulated seconds a second of wall time; nothing is as fast as possible.
    void setSpeed(std::optional<double> speed);
    /// Null: what the scene asks for. Holds for scenes loaded later, too.
    void useBroadphase(const BroadphaseRow* row);
    /// From now on structureArrived() comes before each snapshot, or no longer does.
    void wantStructure(bool wanted);
    /// Whether exchange() keeps the old run as a ghost.
    void wantGhost(bool wanted) { m_thread.post(GhostCommand{wanted}); }

    /// Shows another run, from its start, as the ghost of the one that is loaded; null: none any more.
    void showGhostRun(std::shared_ptr<const Pipeline> pipeline) {
        m_thread.post(GhostRunCommand{std::move(pipeline)});
    }

    const RunStatus& status() const { return m_status; }
    bool isRunning() const { return m_status.state == RunState::Running; }
    /// On the way to another frame for so long that it can be ended: by pause().
    bool isSeeking() const { return m_status.seeking; }
    /// A step was asked for and has not been made yet.
    bool isStepping() const { return m_thread.stepWaits(); }
    /// Frame 0 is on screen and nobody has asked for another one.
    bool isAtStart() const { return m_atStart; }
    /// An exchanged scene is on its way to the time on screen.
    bool isUnderWay() const { return m_underWay; }
    /// What is on screen, or was asked for and is not there yet [s].
    double time() const { return m_time; }
    /// Where the run stops while it plays; bodies are those of the scene loaded last.
    void setBreakpoints(std::vector<Breakpoint> breakpoints);
    /// To the last frame before at which a breakpoint held; broke() says where, or that there is none.
    void findBack() { m_thread.post(FindBackCommand{}); }
    /// To a frame, paused there; explained() says what happened in it.
    void explain(std::int64_t frame);
    /// Whether a run that gains energy from nowhere pauses there.
    void stopWhereEnergyRises(bool stops) { m_thread.post(GuardCommand{stops}); }
    /// What checkpoints may take [bytes].
    void setMemoryBudget(std::size_t bytes);
    /// What they take [bytes].
    std::size_t recorded() const { return m_recorded; }
    /// Null until something was loaded.
    std::shared_ptr<const Pipeline> pipeline() const { return m_pipeline; }

  Q_SIGNALS:
    void stateChanged(const carom::RunStatus& status);
    void broke(const std::optional<carom::BreakHit>& hit);
    /// Energy has risen from nowhere, for the first time since load, exchange or reset.
    void energyRose(const carom::EnergyRise& rise);
    void explained(const carom::EventStory& story);
    /// A new run begins: after load and exchange.
    void restarted();
    /// The run is at its beginning again and what it sends comes anew.
    void rewound();
    /// The exchanged scene has come to the time on screen: its first snapshot follows.
    void landed();
    /// The run before the exchange, or the one asked for, at the time of the snapshot that comes next.
    void ghostArrived(const carom::Ghost& ghost);
    /// The broad-phase's grid cells or tree nodes in the snapshot that comes next.
    void structureArrived(const std::vector<carom::Aabb>& boxes);
    void snapshotArrived(const std::shared_ptr<const carom::Snapshot>& snapshot);
    void framesArrived(const std::vector<carom::FrameStatistics>& frames);
    /// How the expectations of the loaded scene fare now; of scenes that have some.
    void judged(const std::shared_ptr<const carom::JudgedRun>& run);

  private:
    void rest();
    void collect();
    void show(const PublishedSnapshot& published);
    void takeStatus(const RunStatus& status);

    std::shared_ptr<const Pipeline> m_pipeline;
    RunStatus m_status;
    std::uint64_t m_run = 0;
    bool m_atStart = true;
    double m_time = 0; ///< [s]
    bool m_underWay = false;
    bool m_haunted = false; ///< the snapshot before came with a ghost
    bool m_structureWanted = false;
    std::shared_ptr<const JudgedRun> m_judged; ///< the last that came
    std::size_t m_recorded = 0;                ///< [bytes]
    std::uint64_t m_statusNumber = 0;          ///< of the one taken last
    QTimer m_timer;
    SimulationThread m_thread; ///< last: it is gone before anything it posts to
};

} // namespace carom
