// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/force_term.h"

#include <cstddef>
#include <span>
#include <vector>

// Implicit steps of bodies under force terms, stable at any step size:
//
//     m (v₁ − v₀) = h (m g + F(w)) + p      w = (1 − θ) v₀ + θ v₁      x₁ = x₀ + h (v₀ + v₁)/2
//     θ = 1/(1 − e⁻ᶻ) − 1/z                 z = λ h
//
//     legend   v₀, v₁  velocities at both ends [m/s]       F  the terms' force, in the middle of the way [N]
//              p       impulse of contacts and springs [N s]      h  the step [s]
//              λ       fastest rate on the way (ForceTerm::addRates) [1/s]
//
// θ is fitted so that what vanishes as e^(−λt) does so exactly (W. Liniger, R. A. Willoughby, "Efficient
// integration methods for stiff systems of ordinary differential equations", SIAM Journal on Numerical
// Analysis 7, 1970). For short steps θ → 1/2: the implicit midpoint rule, of order two; for long ones θ → 1,
// implicit Euler. A constant velocity is found exactly at any step. And z (1 − θ) ≤ 1: so a velocity that
// falls or rises towards such a constant one never passes it, however long the step.
//
// The equation is solved by Newton's method. About a guess of w, with F and its slope s there, it is linear:
//
//     m̃ (v₁ − v̂) = p      m̃ = m + θ h s      v̂ = v₀ + h (m g + F + s (w − v₀))/m̃
//
// so for the solver of p it is a body of another mass and another free velocity. The slope is taken for all
// directions alike; along the force, where it counts, Newton's method converges quadratically.

namespace carom {

struct Bodies;
struct State;

class ForcedSteps {
  public:
    struct Step {
        std::size_t owner = 0;      ///< the number that its owner gave
        double mass = 0;            ///< m [kg]
        double weight = 0.5;        ///< θ
        Vec3 before = Vec3::Zero(); ///< v₀ [m/s]
        Vec3 place = Vec3::Zero();  ///< x₀ [m]
        Vec3 at = Vec3::Zero();     ///< w [m/s]
        Vec3 force = Vec3::Zero();  ///< F [N] there
        double slope = 0;           ///< s [N s/m]
        Vec3 after = Vec3::Zero();  ///< v₁ [m/s], the result
        Vec3 given = Vec3::Zero();  ///< what the terms gave, to be recorded [N s]
        bool isSolved = false;      ///< without p
    };
    struct Start {
        BodyIndex body = noBody;
        Pose pose;
        Vec3 velocity = Vec3::Zero();        ///< [m/s]
        Vec3 angularVelocity = Vec3::Zero(); ///< [rad/s]
        Vec3 angularMomentum = Vec3::Zero(); ///< [kg m²/s]
    };

    bool isEmpty() const { return m_steps.empty(); }
    std::span<Step> steps() { return m_steps; }
    void clear();
    /// Another body, for a step of `duration` [s] from `start` on.
    void add(std::size_t owner, const Bodies& bodies, const Start& start, double duration);
    void add(std::size_t owner, const Bodies& bodies, const State& state, BodyIndex body, double duration);
    /// Solves the steps of all bodies as if nothing but gravity and the terms acted.
    void solve(const Forces& forces, const Vec3& gravity, double duration);
    /// Evaluates the terms at the velocities `after`. False, and nothing has changed, if those are for every
    /// body the velocities of the last evaluation, within `tolerance` [m/s].
    bool follow(const Forces& forces, double tolerance);

    double massOf(const Step& step) const { return step.mass + step.weight * m_duration * step.slope; } ///< m̃
    Vec3 freeVelocityOf(const Step& step) const; ///< v̂
    /// The impulse of the terms on a body whose step ended with velocity `after` [N s].
    Vec3 impulseOf(const Step& step) const;
    /// Records what the terms gave, on the way from `before` to `after`, to their accounts; returns the sum.
    LedgerEntry record(const Forces& forces, Ledger& ledger);

  private:
    Vec3 lookedAt(const Step& step, const Vec3& after) const {
        return (1 - step.weight) * step.before + step.weight * after;
    }
    void evaluate(const Forces& forces);

    Vec3 m_gravity = Vec3::Zero();
    double m_duration = 0;
    std::vector<Step> m_steps;
    std::vector<ForceSample> m_samples; // by step
    std::vector<ForceValue> m_values;   // by step
    std::vector<double> m_rates;        // by step
};

} // namespace carom
