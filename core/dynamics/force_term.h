// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/index.h"
#include "core/dynamics/ledger.h"
#include "core/math/pose.h"
#include "core/math/types.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

// Forces on single bodies besides gravity: what an effect contributes (effects/effect.h) and every method of
// motion takes into account, without knowing which effect it is. A term acts on the centre of a body and
// depends on the body's own pose and velocity, not on other bodies nor on time:
//
//     m v' = m g + Σ F(x, q, v, ω)
//
// Where a term acts the path between contacts is no parabola, and the motion is not ballistic: closed forms
// that rely on it ask Forces::actOn first. A term is one virtual call for an array of bodies, never one a
// body.

namespace carom {

/// Where a body is and how it moves.
struct ForceSample {
    BodyIndex body = noBody;
    Pose pose;
    Vec3 velocity = Vec3::Zero();        ///< [m/s]
    Vec3 angularVelocity = Vec3::Zero(); ///< [rad/s], world
};

struct ForceValue {
    Vec3 force = Vec3::Zero(); ///< F [N], world
    double slope = 0; ///< −∂F/∂v along the direction in which it is largest [N s/m], not negative
};

/// A bound of how much a force can accelerate a body, whatever its motion is.
struct SpeedGain {
    double acceleration = 0; ///< [m/s²]
    double speed = 0;        ///< that it never adds more than [m/s]
};

class ForceTerm {
  public:
    virtual ~ForceTerm() = default;
    ForceTerm() = default;
    ForceTerm(const ForceTerm&) = delete;
    ForceTerm& operator=(const ForceTerm&) = delete;

    /// Where its work is recorded.
    virtual LedgerAccount account() const = 0;
    virtual bool actsOn(BodyIndex body) const = 0;
    /// The parameter of a body by which it acts: what messages point to.
    virtual std::string_view parameter() const = 0;
    /// Adds the force in each of `samples` to `values`.
    virtual void add(std::span<const ForceSample> samples, std::span<ForceValue> values) const = 0;
    /// Adds to `rates` the fastest rate [1/s] at which the force makes differences of velocity decay, on any
    /// path that begins with a sample and on which other forces accelerate bodies by no more than
    /// `acceleration` [m/s²].
    virtual void addRates(std::span<const ForceSample> samples, double acceleration,
                          std::span<double> rates) const = 0;
    virtual SpeedGain gainOf(BodyIndex body) const = 0;
    /// No force on the body is larger [N] while it is no faster than `speed` [m/s].
    virtual double mostForce(BodyIndex body, double speed) const = 0;
    /// The same for bodies under new numbers (body order[k] becomes k), with coordinates from `origin` [m]
    /// on.
    virtual std::shared_ptr<const ForceTerm> renumbered(std::span<const BodyIndex> order,
                                                        const Vec3& origin) const = 0;
};

/// The terms of a scene.
struct Forces {
    std::vector<std::shared_ptr<const ForceTerm>> terms;
    std::vector<std::uint8_t> acting; ///< by body, 1: some term acts on it; empty without terms
    std::vector<SpeedGain> gain;      ///< by body, of all terms together; empty without terms

    bool empty() const { return terms.empty(); }
    /// Whether the path of a body is no parabola.
    bool actOn(BodyIndex body) const { return !terms.empty() && acting[body] != 0; }
    /// How much further than under gravity alone a body can come within `duration` [s], at most [m].
    double reach(BodyIndex body, double duration) const;
    /// No force on a body is larger [N] while it is no faster than `speed` [m/s].
    double most(BodyIndex body, double speed) const;
    /// The sum of all terms in each sample.
    void evaluate(std::span<const ForceSample> samples, std::span<ForceValue> values) const;
    void addTerm(std::shared_ptr<const ForceTerm> term, std::size_t bodies);
};

Forces renumbered(const Forces& forces, std::span<const BodyIndex> order, const Vec3& origin);

} // namespace carom
