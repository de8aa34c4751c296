// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/simulation/sample_queue.h"
#include "ui/simulation/simulation_thread.h"

#include "core/simulation/pipeline.h"
#include "core/simulation/snapshot.h"

#include <QObject>
#include <QTimer>

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
    void play();
    void pause();
    void togglePlay();
    void step();
    void reset();
    /// Simulated seconds a second of wall time; nothing is as fast as possible.
    void setSpeed(std::optional<double> speed);
    /// Null: what the scene asks for. Holds for scenes loaded later, too.
    void useBroadphase(const BroadphaseRow* row);
    /// From now on structureArrived() comes before each snapshot, or no longer does.
    void wantStructure(bool wanted);

    const RunStatus& status() const { return m_status; }
    bool isRunning() const { return m_status.state == RunState::Running; }
    /// Nobody has asked for a step since the scene was loaded or reset.
    bool isAtStart() const { return m_atStart; }
    /// Null until something was loaded.
    std::shared_ptr<const Pipeline> pipeline() const { return m_pipeline; }

  Q_SIGNALS:
    void stateChanged(const carom::RunStatus& status);
    /// A new run begins at frame 0: after load and reset.
    void restarted();
    /// The broad-phase's grid cells or tree nodes in the snapshot that comes next.
    void structureArrived(const std::vector<carom::Aabb>& boxes);
    void snapshotArrived(const std::shared_ptr<const carom::Snapshot>& snapshot);
    void framesArrived(const std::vector<carom::FrameStatistics>& frames);

  private:
    void collect();

    std::shared_ptr<const Pipeline> m_pipeline;
    RunStatus m_status;
    std::uint64_t m_run = 0;
    bool m_atStart = true;
    bool m_structureWanted = false;
    QTimer m_timer;
    SimulationThread m_thread; ///< last: it is gone before anything it posts to
};

} // namespace carom
