// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/pipeline.h"
#include "core/study/error_norms.h"

#include <cmath>
#include <vector>

// Energy and momentum during a run, the overlap of bodies, the residual of contacts, and the final state.
// None of it needs to follow a single body, so it is informative where trajectories branch.
//
// Energies are relative to a scale that cannot vanish, E:
//
//     E = max(K, V⁺ − V⁻, ε W s)    K the largest kinetic energy, V⁺ and V⁻ the extremes of the potential one
//                                   W the weight of all bodies [N], s the size of the scene [m]
//                                   ε = 1e-3: less exchange than this part of W s counts as none

namespace carom {

class World;

/// The final state of a run.
struct Outcome {
    double height = 0;          ///< [m] of the highest centre of a mobile body, against gravity
    Vec3 centre = Vec3::Zero(); ///< [m] centre of mass of the mobile bodies
    double restTime = 0;        ///< [s] from which on nothing moves; the end where something does
    double work = 0;            ///< [J] lost
    double energyScale = 1;     ///< [J] E
};

/// The difference of two outcomes: lengths relative to the scene's size, times to the duration, work to E.
struct OutcomeErrors {
    double height = 0, centre = 0, restTime = 0, work = 0;

    double worst() const;
};
OutcomeErrors differenceOf(const Outcome& run, const Outcome& reference, double size, double duration);

/// The largest difference of two courses of the energy [J] at the ends of frames, as far as both go, relative
/// to `scale` [J].
double distanceOf(const std::vector<double>& run, const std::vector<double>& reference, double scale);

/// Follows a run, step by step.
class RunCourse {
  public:
    /// `size` of the scene [m].
    RunCourse(const Pipeline& pipeline, double size);
    /// With the world at its start.
    RunCourse(const World& world, double size);

    void add(const World& world);
    /// Of a run elsewhere, which tells no more: energies [J] at this time [s].
    void add(double time, double kinetic, double potential);
    /// What was added last is the end of a frame.
    void endFrame() { m_frames.push_back(m_energy.back()); }

    const std::vector<double>& frames() const { return m_frames; } ///< [J], the energy at the start first
    Steadiness energy() const;                                     ///< relative to E
    double energyScale() const;
    /// Relative change of momentum, of scenes without gravity, walls and ends in the world; else 0.
    double momentumChange(const World& world) const;
    Outcome outcome(const World& world) const;
    Outcome outcome(const Pipeline& pipeline, const State& state) const;
    double overlap() const { return m_overlap; }   ///< the largest, relative to the thinnest mobile body
    double residual() const { return m_residual; } ///< [m/s], of the worst contact problem
    /// The same relative to the speed that all bodies have at the kinetic energy E.
    double relativeResidual() const;
    double coneViolation() const { return m_coneViolation; }

  private:
    double m_weightTimesSize = 0; ///< [J] ε W s
    double m_mass = 0;            ///< [kg] of the mobile bodies
    double m_thickness = 1;       ///< [m], half of the thinnest mobile body
    Vec3 m_momentum = Vec3::Zero();
    std::vector<double> m_time, m_energy, m_kinetic, m_frames;
    double m_fastest = 0, m_highest = -HUGE_VAL, m_lowest = HUGE_VAL; ///< [J]
    double m_overlap = 0, m_residual = 0, m_coneViolation = 0;
};

} // namespace carom
