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
//
// Refined islands whose forces balance to the tolerance come to rest at once (IslandMotion::settle). What is
// left of the tolerance adds up along a tower: 100 cubes creep at 500 times what one does, for ever. So a
// refined island is at rest, too, whose bodies have all been slower than restSpeed for the time above. It is
// the same speed whatever the tolerance.
//
// A spring may move its bodies so slowly that this shows in no such time: a swing is slow where it turns. So
// bodies on springs must stay for as many times
//
//     τ = max( √(M/k), c/k, √(l/g) )
//
//     legend   M  mass of their island [kg]      k, c, l  stiffness, damping and length of a spring of it
//
// In five of them a swing passes through its fastest place; of a spring that its damper slows down, less than
// a hundredth of the way is left. What an undamped spring moves, and any island on springs that is refined,
// is at rest only as long as it is not faster than restSpeed.

namespace carom {

/// Bodies are slow up to this part of the speed √(size g). Their motion is taken away when they are put to
/// sleep: at twice, that is four times the energy; at half, heaps come to rest later.
inline constexpr double calmSpeed = 0.01;
/// Refined bodies are at rest up to this part of √(size g). In the time above they move by 5e-8 of their size
/// at most. At a tenth, towers of several hundred bodies creep on in accurate runs; at ten times, an unstable
/// motion that begins with that speed may be stopped after it has grown by three digits.
inline constexpr double restSpeed = 1e-8;

/// τ of these springs of the scene, in an island of this mass [s].
double slowestTime(const Bodies& bodies, const State& state, std::span<const std::uint32_t> springs,
                   double mass, const Vec3& gravity);

/// Whether a body is not faster than `part` of √(size g).
bool isSlowerThan(double part, const Bodies& bodies, const State& state, BodyIndex body, const Vec3& gravity);

class Calm {
  public:
    /// Where a body was when it last had gone too far, and how long ago [s].
    struct Stay {
        Pose from;
        double time = 0;
        double slow = 0; ///< for how long it has not been faster than restSpeed, while refined or on a spring
                         ///< [s]
    };

    explicit Calm(const Bodies& bodies);

    /// By body, not 0: a spring ends on it.
    std::span<const std::uint8_t> isOnSpring() const { return m_isOnSpring; }

    /// Takes note of another `time` [s] of bodies.
    void note(const Bodies& bodies, const State& state, std::span<const BodyIndex> list, const Vec3& gravity,
              double time);
    /// The same of refined bodies.
    void noteRefined(const Bodies& bodies, const State& state, std::span<const BodyIndex> list,
                     const Vec3& gravity, double time);
    /// Whether refined bodies that nothing but contacts, springs and gravity acts on have come to rest.
    bool areAtRest(const Bodies& bodies, std::span<const BodyIndex> list, const Vec3& gravity);
    /// Whether those on springs among them have been for long enough; `slowest` is τ of their island [s].
    bool haveRested(std::span<const BodyIndex> list, double slowest) const;
    /// Whether a body has stayed for long enough, and is slow now; never without gravity. `slowest` is τ of
    /// its island, if it is on a spring [s].
    bool isCalm(const Bodies& bodies, const State& state, BodyIndex body, const Vec3& gravity,
                double slowest = 0) const;
    /// Whether force terms could bear a body's weight, or a part of it, while it is calm: then it need not
    /// lie on anything. The terms are asked once a run; gravity is the same all the time.
    bool mayFloat(const Bodies& bodies, BodyIndex body, const Vec3& gravity);
    void forget(std::span<const BodyIndex> list) {
        for (const BodyIndex body : list) m_stays[body].time = m_stays[body].slow = 0;
    }
    const std::vector<Stay>& stays() const { return m_stays; } ///< by body
    void recall(const std::vector<Stay>& stays) { m_stays = stays; }

  private:
    enum class Floating : std::uint8_t { Unknown, No, Yes };

    std::vector<Stay> m_stays;
    std::vector<std::uint8_t> m_isOnSpring, m_isUndamped; ///< by body; the latter: one of its springs is
    std::vector<Floating> m_floating;                     ///< by body
};

/// Takes all velocity from bodies; what that costs is recorded under Rest.
void stop(const Bodies& bodies, std::span<const BodyIndex> list, State& state, Ledger* ledger);

} // namespace carom
