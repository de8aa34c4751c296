// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/bodies.h"
#include "core/dynamics/ledger.h"
#include "core/dynamics/state.h"
#include "core/solvers/event_times.h"

#include <cstdint>
#include <span>
#include <vector>

// A platform is a heavy body nearly at rest that many light balls strike within one substep: the steps of a
// pyramid in a shower of balls. Solved for as an island, every impact would move the whole of it to the time
// of the impact and begin anew. But a light ball hardly moves what it strikes: so the ball flies on from the
// impact at once, and the platform, which goes on as it does for the rest of the substep, gets the impulse
// afterwards.
//
//        o   o  \o         normal n, from the platform to the ball; r from its centre to the point
//      ___\_/_____\___     p = (1 + e) (closing speed) / W,   W = 1/m + 1/M + (r×n)·I⁻¹(r×n)
//     |_______________|    ball: v += p n/m     platform: V −= p n/M,  Ω −= I⁻¹(r×n) p, at the substep's end
//
// Every impact conserves momentum, and loses energy as e says for the velocities that it finds. What is
// approximate is where the platform is meanwhile: its position misses the change of its velocity, at most
// (m/M) (1 + e) of the ball's, over what is left of the substep. A fixed platform misses nothing.

namespace carom {

class Platforms {
  public:
    explicit Platforms(const Bodies& bodies) : m_at(bodies.count(), none) {}

    /// Balls up to this part of its mass may strike a platform, and it takes so many of them near a body to
    /// make it one; fewer are left to the islands, which miss nothing.
    static constexpr double lightest = 0.01;
    static constexpr std::size_t fewest = 3;

    static bool isLight(const Bodies& bodies, BodyIndex ball, BodyIndex body) {
        return bodies.mobile[body] == 0 || bodies.mass[ball] <= lightest * bodies.mass[body];
    }

    void clear();
    /// Makes a platform of `body`, which moves on from `time` [s] as it does in the state.
    void add(const State& state, BodyIndex body, double time);
    void removeLast();
    bool contains(BodyIndex body) const { return m_at[body] != none; }

    /// How a ball and a platform lie to each other at a time [s].
    struct Contact {
        double gap = 0;     ///< [m]
        Vec3 normal, arm;   ///< from the platform to the ball; from its centre to its point [m]
        double closing = 0; ///< [m/s]
    };
    Contact contactAt(const Bodies& bodies, const Stamp& ball, const Vec3& acceleration, BodyIndex platform,
                      double time) const;

    /// When the ball meets the platform, from its stamp to `end` [s]; `never` if not by then.
    double timeOf(const Bodies& bodies, BodyIndex ball, const Stamp& stamp, const Vec3& acceleration,
                  BodyIndex platform, double end) const;

    /// The normal impulse [N s] on a ball of the given mass. The platform has its share from then on, and it
    /// is remembered under `log`.
    double strike(const Bodies& bodies, double mass, double restitution, const Contact& contact,
                  BodyIndex platform, std::uint32_t log);

    /// Gives the platforms what the balls gave them under those of the logs that `counts`; books it.
    template<class Counts>
    void kick(const Bodies& bodies, State& state, Ledger* ledger, const Counts& counts) const {
        for (const Kick& each : m_kicks)
            if (counts(each.log)) kick(bodies, each, state, ledger);
    }

  private:
    static constexpr std::uint32_t none = 0xffffffffU;

    struct Platform {
        BodyIndex body = noBody;
        double time = 0;                                       // [s]
        Pose pose;                                             // at that time
        Vec3 velocity = Vec3::Zero(), spin = Vec3::Zero();     // of its path
        Vec3 gained = Vec3::Zero(), gainedSpin = Vec3::Zero(); // by impacts since
    };
    struct Kick {
        std::uint32_t log = 0;
        BodyIndex body = noBody;
        Vec3 velocity, spin; // changes [m/s], [rad/s]
    };
    void kick(const Bodies& bodies, const Kick& kick, State& state, Ledger* ledger) const;

    std::vector<std::uint32_t> m_at; // by body, into m_platforms
    std::vector<Platform> m_platforms;
    std::vector<Kick> m_kicks; // in the order of the impacts
};

} // namespace carom
