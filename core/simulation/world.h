// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/broadphase/broadphase.h"
#include "core/dynamics/state.h"
#include "core/simulation/checkpoint.h"
#include "core/simulation/health.h"
#include "core/simulation/pipeline.h"
#include "core/simulation/snapshot.h"
#include "core/simulation/statistics.h"

#include "core/integrators/integrator.h"
#include "core/solvers/solver.h"

#include <memory>
#include <vector>

namespace carom {

class World;

/// Advances a world one frame: the main function of the simulation.
void stepWorld(World& world);
/// Energy and momentum of a state, into the statistics.
void account(const Pipeline& pipeline, const State& state, FrameStatistics& frame);

/// A simulation of a scene: a constant Pipeline, the State, and what the algorithms keep between frames. One
/// thread at a time may use it.
class World {
  public:
    explicit World(std::shared_ptr<const Pipeline> pipeline);

    /// Advances one frame (settings().step seconds). A world that is not healthy stays where it is.
    void step() { stepWorld(*this); }
    /// Back to frame 0.
    void reset();

    const Pipeline& pipeline() const { return *m_pipeline; }
    std::shared_ptr<const Pipeline> sharedPipeline() const { return m_pipeline; }
    const State& state() const { return m_state; }
    /// Of the last step; all zero but energy and momentum at frame 0. A step that lost its state keeps the
    /// energy and momentum of the one before.
    const FrameStatistics& statistics() const { return m_statistics; }
    const Health& health() const { return m_health; }
    Snapshot snapshot() const;
    std::vector<ContactForce> contactForces() const;
    Checkpoint checkpoint() const;
    /// Goes on from a checkpoint of a world of this pipeline, to the bit as that world did.
    void restore(const Checkpoint& checkpoint);
    /// A 64-bit hash of the exact state: every mobile body's pose and velocities, and the frame.
    std::uint64_t stateHash() const;

    /// Whether the audit of energy and momentum is kept from now on (FrameStatistics::ledger). It costs a
    /// percent or two, and the motion is the same to the bit.
    void keepLedger(bool keep) { m_keepsLedger = keep; }

    /// Goes on with another broad-phase from the next step; the motion is the same to the bit.
    void useBroadphase(const BroadphaseRow& row);
    const BroadphaseRow& broadphaseRow() const { return *m_broadphaseRow; }
    const Broadphase& broadphase() const { return *m_broadphase; }
    /// The grid cells or tree nodes of the last update; before the first one, those that it would make of
    /// this state.
    std::vector<Aabb> broadphaseStructure() const;

  private:
    friend void stepWorld(World& world);

    std::shared_ptr<const Pipeline> m_pipeline;
    State m_state;
    FrameStatistics m_statistics;
    Health m_health;
    const BroadphaseRow* m_broadphaseRow = nullptr;
    std::unique_ptr<Broadphase> m_broadphase;
    std::unique_ptr<Solver> m_solver;
    Workers m_workers;
    bool m_keepsLedger = false;
    std::vector<double> m_stored; // [J], by Pipeline::stored(): when a frame begins and ends
};

} // namespace carom
