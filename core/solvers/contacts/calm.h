// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/bodies.h"
#include "core/dynamics/ledger.h"
#include "core/dynamics/state.h"

#include <span>
#include <vector>

// When bodies of the base path, whose forces balance less exactly than those of refined islands, are put to
// sleep: after so long, in units of the time √(size/g) in which they would fall their own size, at no more
// than a small part of the speed √(size g) they would reach. What is unstable grows by a factor e in about
// that unit, so it would be e⁵ times as fast in the end as at the start.

namespace carom {

/// Bodies are calm up to this part of the speed √(size g).
inline constexpr double calmSpeed = 0.01;

class Calm {
  public:
    explicit Calm(std::size_t bodies) : m_times(bodies, 0.0) {}

    /// Takes note of another `time` [s] of bodies.
    void note(const Bodies& bodies, const State& state, std::span<const BodyIndex> list, const Vec3& gravity,
              double time);
    /// Whether a body has been slow for long enough; never without gravity.
    bool isCalm(const Bodies& bodies, BodyIndex body, const Vec3& gravity) const;
    void forget(std::span<const BodyIndex> list) {
        for (const BodyIndex body : list) m_times[body] = 0;
    }
    /// By body [s].
    const std::vector<double>& times() const { return m_times; }
    void recall(const std::vector<double>& times) { m_times = times; }

  private:
    std::vector<double> m_times;
};

/// Whether force terms could bear a body's weight, or a part of it, while it is calm: then it need not lie on
/// anything.
bool mayFloat(const Bodies& bodies, BodyIndex body, const Vec3& gravity);

/// Takes all velocity from bodies; what that costs is recorded under Rest.
void stop(const Bodies& bodies, std::span<const BodyIndex> list, State& state, Ledger* ledger);

} // namespace carom
