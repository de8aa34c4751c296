// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/pipeline.h"

#include "core/base/index.h"
#include "core/dynamics/state.h"
#include "core/narrowphase/narrowphase.h"

#include <optional>
#include <vector>

// The impulses between bodies in one frame, computed from the states before and after it, so by the same rule
// for every method. The frame changed velocities by more than gravity and the force terms do:
//
//     Δv_i = v2 − v1 − h (g + F_i/m_i)        h the frame, F the mean of air and the like      [m/s]
//
// Each body moved on the parabola of its start until its velocity jumped, and on that of its end from then
// on; they meet at t_i, except for a misfit where it was struck more than once or supported by a floor.
// Bodies that touch on these paths at the beginning, the end, t_A or t_B may have touched, and only they can
// have given each other impulses:
//
//     λ_k >= 0, |τ_k| <= μ_k λ_k               along the normal n of pair k, and across it      [N s]
//     least  Σ_i m_i |Δv_i − Σ_k ±(λ_k n_k + τ_k)/m_i|²
//
//     (cue) -->  (1)(2)(3)   before        Δv = −v, 0, 0, v:  λ = m v between each two neighbours, although
//           (cue)(1)(2)  (3) after         1 and 2 are at rest before and after
//
// Bodies that rest on each other need impulses, too: those of the same pairs that would have kept every body
// at rest, Δv_i = −h (g + F_i/m_i). A pair was struck where its impulse is more than twice that of rest (one
// time holds the weight, the other is for slopes) and than what gravity gives a body in two frames.
//
// Limits: impulses act at the centres, so what turns a body goes unseen; a pair is seen with one normal;
// several impacts of a pair in a frame are one; where bodies that may have touched form loops the impulses
// need not be unique, and the search gives those that it comes to from none at all. Springs give momentum as
// well, so where there are any no pair counts as struck.

namespace carom {

/// What is known of the start of a frame.
struct FrameStart {
    const std::vector<Pose>& pose;
    const std::vector<Vec3>& velocity; ///< [m/s]
};

class FrameImpulses {
  public:
    /// Of the frame that led to `state`; all must outlive it.
    FrameImpulses(const Pipeline& pipeline, const FrameStart& start, const State& state);

    /// Whether the paths of the two bodies touch.
    bool mayHaveTouched(BodyIndex a, BodyIndex b) const { return contactOf(a, b).has_value(); }
    /// The pairs that were struck, ascending.
    std::vector<BodyPair> struckPairs() const;
    /// When a struck body was, or one of two (noBody: of one) [s] after the start of the frame: when its
    /// velocity jumped, or, where it passed on all that it got, that of the nearest body that it was struck
    /// through.
    double timeStruck(BodyIndex a, BodyIndex b) const;

  private:
    struct Near;

    std::optional<Proximity> contactOf(BodyIndex a, BodyIndex b) const;
    bool anyGiven() const;
    double reachOf(BodyIndex i) const;
    double sizeOf(BodyIndex i, BodyIndex other) const;
    Vec3 placeAt(BodyIndex i, double time) const;
    Pose poseAt(BodyIndex i, double time) const;
    void findJump(BodyIndex i);
    std::vector<Near> nearPairs() const;
    std::vector<double> impulsesFor(const std::vector<Near>& pairs, std::vector<Vec3> left) const;

    const Pipeline& m_pipeline;
    const Bodies& m_bodies;
    FrameStart m_start;
    const State& m_state;
    double m_step;                        ///< [s]
    double m_least = 0;                   ///< change of velocity that is an impact [m/s]
    std::vector<Vec3> m_given, m_atRest;  ///< Δv, see above, by body [m/s]
    std::vector<double> m_jump, m_misfit; ///< when each velocity jumped [s], and how far its paths miss [m]
};

} // namespace carom
