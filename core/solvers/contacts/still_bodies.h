// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/held_bytes.h"
#include "core/base/scratch.h"
#include "core/math/types.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// Bodies of the base path that stand still while others of their island move. In a heap of hundreds of bodies
// there is nearly always one that rolls or slips. The others need not be solved for until the forces on them
// change.
//
// A body that is calm (calm.h) at the end of a frame stands still from then on, if the forces on it balance.
// It has no velocity, and bodies that move see it as an immobile body. Contacts between bodies that stand
// still keep their forces. Forces of bodies that move are averaged over about a frame. A body stands still as
// long as
//
//     | m g + Σ F | ≤ part (m |g| + ½ Σ |F|)      | Σ r × F | ≤ part size (m |g| + ½ Σ |F|)
//
//     legend   F  forces of all contacts and springs of the body, at r from its centre
//              part  0.1 to stand still, 0.2 to go on doing so
//
// The limit grows with the load, because the error of forces found by sweeps does: no more than a fifth of a
// body's load is unbalanced. A body must have its own mass when it is struck: where an impact would give a
// body that stands still a speed that is not calm, it moves on before the impact is solved, and so do bodies
// that it would strike in turn.

namespace carom {

/// Bodies are numbered as in SteppedMotion; number 0 is the immobile body, and counts as standing still.
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

    /// Starts with number 0 only.
    void begin();
    /// Adds the next number, a body that moves.
    void add();
    /// Removes bodies whose new number is gone (stepped_islands.h); so many numbers are left.
    void leave(std::span<const std::uint32_t> newNumbers, std::size_t kept);

    bool any() const { return m_count > 0; }
    std::size_t count() const { return m_count; }
    bool is(std::uint32_t number) const { return m_is[number] != 0; }
    /// Whether it could move, too.
    bool rests(std::uint32_t number) const { return number != 0 && is(number); }
    std::span<const std::uint8_t> flags() const { return m_is; }
    void set(std::uint32_t number, bool isStill) {
        m_count = m_count + (isStill ? 1 : 0) - m_is[number];
        m_is[number] = isStill ? 1 : 0;
        note(number);
    }

    /// This body, or a pair of it, has changed: loads that depend on it must be added up again.
    void note(std::uint32_t number) { m_isChanged[number] = number != 0 ? 1 : 0; }
    void forgetChanges() { std::fill(m_isChanged.begin(), m_isChanged.end(), std::uint8_t{0}); }
    std::span<const std::uint8_t> changed() const { return m_isChanged; }

    /// Begins to add up loads: of those that have changed, and of those that touch() names. The others keep
    /// theirs.
    void beginLoads() { m_isTouched = m_isChanged; }
    void touch(std::uint32_t number) { m_isTouched[number] = number != 0 ? 1 : 0; }
    std::span<const std::uint8_t> touched() const { return m_isTouched; }
    bool isTouched(std::uint32_t number) const { return m_isTouched[number] != 0; }
    void clearLoads(std::uint32_t number) {
        m_lasting[number] = m_passing[number] = {};
        m_pressed.isKnown = false;
    }

    /// Load that does not change while the same bodies stand still: by gravity and by contacts between them.
    Load& lasting(std::uint32_t number) { return m_lasting[number]; }
    /// Load by contacts with bodies that move, averaged.
    Load& passing(std::uint32_t number) {
        m_pressed.isKnown = false;
        return m_passing[number];
    }
    /// The same in this substep alone.
    Load& sample(std::uint32_t number) {
        press(number);
        return m_sample[number];
    }
    /// Whether a body that moves presses on it, or did recently.
    bool isPressed(std::uint32_t number) const { return m_passing[number].borne > 0; }
    /// Those that stand still of which that holds, and others.
    std::span<const std::uint32_t> pressed() {
        findPressed();
        return m_pressed.list;
    }
    void beginSamples();
    /// Adds the samples to the mean.
    void takeSamples();
    /// Whether more than `part` of the load on a body of this weight [N] and size [m] is unbalanced.
    bool isUnbalanced(std::uint32_t number, double weight, double size, double part) const;
    std::size_t bytes() const { return heldBytes(m_is, m_isChanged, m_lasting, m_passing); }

  private:
    /// Bodies with a passing load or a sample; no others have either.
    struct Pressed {
        std::vector<std::uint32_t> list;
        std::vector<std::uint8_t> is; ///< by number: in the list
        bool isKnown = false;
    };
    void findPressed();
    void press(std::uint32_t number) {
        if (m_pressed.is[number] != 0) return;
        m_pressed.is[number] = 1;
        m_pressed.list.push_back(number);
    }

    std::vector<std::uint8_t> m_is, m_isChanged;
    Scratch<std::vector<std::uint8_t>> m_isTouched;
    std::vector<Load> m_lasting, m_passing;
    Scratch<std::vector<Load>> m_sample;
    Derived<Pressed> m_pressed;
    std::size_t m_count = 0; // without number 0
};

} // namespace carom
