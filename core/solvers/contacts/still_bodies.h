// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/held_bytes.h"
#include "core/base/scratch.h"
#include "core/math/types.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// Bodies of the base path that stand still while others of their island move. In a heap of hundreds there is
// nearly always one that rolls or slips; the others need not be solved for until it changes what acts on
// them.
//
// A body stands still from the end of a frame on in which it is calm (calm.h), if the forces on it balance.
// It has no velocity then and takes none: for what moves it is as what cannot move. Contacts between bodies
// that stand still keep the forces they had. The forces of others are followed, as their mean over about a
// frame:
//
//     | m g + Σ F | ≤ part (m |g| + ½ Σ |F|)      | Σ r × F | ≤ part size (m |g| + ½ Σ |F|)
//
//     legend   F  forces of all contacts of the body, at r from its centre     part  0.1 to stand still,
//              0.2 to go on doing so
//
// What lies under others bears their weight, and forces of sweeps are exact to a part of what is borne. So no
// force is missing that is more than a fifth of what a body bears. And what strikes must find what it strikes
// as heavy as it is: where an impact would give a body that stands still a speed that is not calm, it moves
// on before it is solved for, and so does in turn what it would give such a speed.

namespace carom {

/// By number, as the bodies of SteppedMotion are; number 0 cannot move, and counts as one that stands still.
class StillBodies {
  public:
    /// `part` above. At half of both, two or three times as many bodies of a heap move on each frame; at
    /// twice as much, what moves on does so with a jerk, and overlaps are a third deeper.
    static constexpr double toStand = 0.1, toMoveOn = 0.2;
    /// Speed that an impact may give, in units of √(size |g|): three times what counts as calm. At half,
    /// bodies wake that would be calm again soon; at twice, what strikes finds a body that cannot move up to
    /// twice that speed.
    static constexpr double struckSpeed = 0.03;

    /// Force [N] and torque about the centre [N m].
    struct Load {
        Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
        double borne = 0; ///< sum of the sizes of the forces of contacts [N]
        void add(const Vec3& arm, const Vec3& more) {
            force += more;
            borne += more.norm();
            torque += arm.cross(more);
        }
    };

    /// Nobody but number 0.
    void begin();
    /// The next number: of a body that moves.
    void add();
    void renumber(std::size_t from, std::size_t to);
    void resize(std::size_t count);

    bool any() const { return m_count > 0; }
    std::size_t count() const { return m_count; }
    bool is(std::uint32_t number) const { return m_is[number] != 0; }
    std::span<const std::uint8_t> flags() const { return m_is; }
    void set(std::uint32_t number, bool isStill) {
        m_count = m_count + (isStill ? 1 : 0) - m_is[number];
        m_is[number] = isStill ? 1 : 0;
    }

    /// Of what does not change while the set is the same: gravity and contacts with others that stand still.
    Load& lasting(std::uint32_t number) { return m_lasting[number]; }
    /// Of contacts with what moves.
    Load& passing(std::uint32_t number) { return m_passing[number]; }
    /// Of contacts with what moves, in this substep.
    Load& sample(std::uint32_t number) { return m_sample[number]; }
    /// Whether what moves presses on it, or did of late.
    bool isPressed(std::uint32_t number) const { return m_passing[number].borne > 0; }
    void beginLoads();
    void beginSamples();
    /// The samples are part of the mean.
    void takeSamples();
    /// Whether more than `part` of the load on a body of so much weight [N] and size [m] is unbalanced.
    bool isUnbalanced(std::uint32_t number, double weight, double size, double part) const;
    std::size_t bytes() const { return heldBytes(m_is, m_lasting, m_passing); }

  private:
    std::vector<std::uint8_t> m_is;
    std::vector<Load> m_lasting, m_passing;
    Scratch<std::vector<Load>> m_sample;
    std::size_t m_count = 0; // without number 0
};

} // namespace carom
