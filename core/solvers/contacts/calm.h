// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/bodies.h"
#include "core/dynamics/ledger.h"
#include "core/dynamics/state.h"

#include <cstdint>
#include <span>
#include <vector>

// When bodies of the base path, whose forces balance less exactly than those of refined islands, are put to
// sleep: if they are slow, and have stayed within a small part of their size for some time, in units of
// √(size/g), in which they would fall about their own size. An unstable motion grows by a factor e in about
// that unit, so it would have left that distance in the last unit alone, and a steady slow motion leaves it
// soon. In a heap of hundreds of bodies one always slips a little: that does not keep the others awake.

namespace carom {

/// Bodies are slow up to this part of the speed √(size g). Their motion is taken away when they are put to
/// sleep: at twice, that is four times the energy; at half, heaps come to rest later.
inline constexpr double calmSpeed = 0.01;

class Calm {
  public:
    /// Where a body was when it last had gone too far, and how long ago [s].
    struct Stay {
        Pose from;
        double time = 0;
    };

    explicit Calm(std::size_t bodies) : m_stays(bodies), m_floating(bodies, Floating::Unknown) {}

    /// Takes note of another `time` [s] of bodies.
    void note(const Bodies& bodies, const State& state, std::span<const BodyIndex> list, double time);
    /// Whether a body has stayed for long enough, and is slow now; never without gravity.
    bool isCalm(const Bodies& bodies, const State& state, BodyIndex body, const Vec3& gravity) const;
    /// Whether force terms could bear a body's weight, or a part of it, while it is calm: then it need not
    /// lie on anything. The terms are asked once a run; gravity is the same all the time.
    bool mayFloat(const Bodies& bodies, BodyIndex body, const Vec3& gravity);
    void forget(std::span<const BodyIndex> list) {
        for (const BodyIndex body : list) m_stays[body].time = 0;
    }
    const std::vector<Stay>& stays() const { return m_stays; } ///< by body
    void recall(const std::vector<Stay>& stays) { m_stays = stays; }

  private:
    enum class Floating : std::uint8_t { Unknown, No, Yes };

    std::vector<Stay> m_stays;
    std::vector<Floating> m_floating; ///< by body
};

/// Takes all velocity from bodies; what that costs is recorded under Rest.
void stop(const Bodies& bodies, std::span<const BodyIndex> list, State& state, Ledger* ledger);

} // namespace carom
