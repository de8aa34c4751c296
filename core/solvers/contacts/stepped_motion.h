// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/ledger.h"
#include "core/dynamics/work_counters.h"
#include "core/solvers/contacts/manifolds.h"
#include "core/solvers/contacts/spring_rows.h"
#include "core/solvers/contacts/velocity_solve.h"

#include <span>
#include <vector>

// The base path of `contacts`: moves any bodies with any contacts through a substep at a cost that is known
// beforehand,
//
//     contact points × steps × passes
//
// with two steps of two passes, or of four where there are few contacts, whatever their shapes, restitution
// and friction. Forces are found by sweeps over four contacts at a time (velocity_solve.h). What accuracy
// this has is a matter of the number of substeps; islands that are worth it and within the budget are refined
// instead (island_motion.h).
//
// Pairs that do not meet as they move (open manifolds) are no rows, but watched: where impulses have changed
// the velocity of one so that the pair would close its gap within the step, its contact is found, and the
// step is solved on with it; so up to a few times a step, for impulses that are passed on.

namespace carom {

struct SteppedInput {
    const Bodies& bodies;
    Vec3 gravity;        ///< [m/s²]
    double duration = 0; ///< [s]
    State& state;
    Ledger* ledger = nullptr;
    double tolerance = 0;                     ///< no further pass where rows are solved to this [m/s]
    std::span<const std::uint32_t> springs{}; ///< of the bodies, into Bodies::springs
    int passes = 1; ///< of each kind in a step; twice as many where there are few contacts
};

struct SteppedReport {
    double residual = 0;       ///< [m/s], as the last pass found its rows
    double maxPenetration = 0; ///< [m]
    WorkCounters work;
    Loss loss;
};

class SteppedMotion {
  public:
    /// Moves `list`, mobile bodies. `places` are their contacts, brought up to date, in the order they are to
    /// be swept; no other body is in contact with them. Forces of the contacts are changed.
    SteppedReport advance(const SteppedInput& input, std::span<const BodyIndex> list,
                          std::span<const std::uint32_t> places, Manifolds& manifolds);

  private:
    void loadBodies(const SteppedInput& input, std::span<const BodyIndex> list);
    void loadRows(const SteppedInput& input, std::span<const std::uint32_t> places,
                  const Manifolds& manifolds, SteppedReport& report);

    struct Watched {
        std::uint32_t place = 0, a = 0, b = 0; ///< bodies of the solve
        Vec3 normal = Vec3::Zero();
        double gap = 0;                  ///< along the normal, when the rows were made [m]
        double radiusA = 0, radiusB = 0; ///< of what turns with the bodies [m]
    };
    std::uint32_t localOf(const SteppedInput& input, BodyIndex i) const {
        return input.bodies.mobile[i] != 0 ? m_local[i] : m_rows.immobile();
    }
    void addRow(const SteppedInput& input, std::uint32_t place, const PlacedManifold& contact,
                const Manifolds& manifolds);
    void watch(const SteppedInput& input, std::uint32_t place, const Manifolds& manifolds);
    bool isStruck(const Watched& pair, double duration) const;
    bool addStruck(const SteppedInput& input, double duration, Manifolds& manifolds, SteppedReport& report);
    void sweep(const StepSettings& settings, bool first, SteppedReport& report);
    void step(const SteppedInput& input, std::span<const BodyIndex> list, double duration, bool first,
              Manifolds& manifolds, SteppedReport& report);
    void move(const SteppedInput& input, std::span<const BodyIndex> list, double duration);
    void storeForces(double duration, Manifolds& manifolds) const;

    std::vector<std::uint32_t> m_local; // by body of the scene
    std::vector<SolverBody> m_bodies;   // the last cannot move
    std::vector<Displacement> m_moved;
    std::vector<std::array<double, 3>> m_free; // velocities that nothing but gravity has changed
    std::vector<std::uint8_t> m_struck;        // by anything since the rows were made
    ContactRows m_rows;
    std::vector<Watched> m_watched;
    std::vector<SolverBody> m_before; // an impact's rebound
    std::vector<SpringRow> m_springs;
    int m_passes = 0; // of each kind in a step
};

} // namespace carom
