// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/scratch.h"
#include "core/solvers/contacts/contact_rows.h"
#include "core/solvers/contacts/manifolds.h"
#include "core/solvers/contacts/pair_ends.h"
#include "core/solvers/contacts/spring_rows.h"
#include "core/solvers/contacts/stepped_input.h"
#include "core/solvers/contacts/stepped_islands.h"
#include "core/solvers/contacts/stepped_pairs.h"
#include "core/solvers/contacts/still_bodies.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// What makes bodies of a block of the base path stand still (still_bodies.h), and move on: adds up the loads
// on them from the contacts and springs that there are, and estimates what strikes them.

namespace carom {

class StandingStill {
  public:
    struct Input {
        const SteppedInput& of;
        const SteppedIslands& islands;
        SteppedPairs& pairs;
        const Manifolds& manifolds;
        std::span<const std::uint32_t> springs; ///< of the scene, that bodies hang on
        double step = 0;                        ///< [s], of which impulses are
    };

    void begin();
    /// The next number, a body that moves.
    void add() { m_still.add(); }
    void leave(std::span<const std::uint32_t> newNumbers, std::size_t kept);
    const StillBodies& bodies() const { return m_still; }
    bool is(std::uint32_t number) const { return m_still.is(number); }
    bool any() const { return m_still.any(); }

    /// There is a new pair of these two.
    void notePair(std::uint32_t a, std::uint32_t b);
    /// Whether bodies or pairs have come, gone or changed since forgetChanges().
    bool isChanged() const { return m_isChanged; }
    void forgetChanges();
    void moveOn(std::uint32_t number) { m_still.set(number, false); }
    /// Lets candidates stand still on which the forces balance, and returns these. Loads are to be added up
    /// again unless they are all.
    std::span<const std::uint32_t> hold(const Input& input, std::span<const std::uint32_t> candidates);
    /// Adds up the loads by gravity and by the present forces of all contacts, of bodies that have changed or
    /// touch one that has.
    void addUpLoads(const Input& input);
    /// Samples the forces of the last step between bodies that stand still and bodies that move.
    void sampleLoads(const ContactRows& rows, std::span<const SpringRow> springs, BallRows& balls,
                     double step);
    /// Adds the samples of the last look to the mean.
    void takeSamples() { m_still.takeSamples(); }
    /// Those whose forces are out of balance.
    std::span<const std::uint32_t> unbalanced(const SteppedInput& input, const SteppedIslands& islands);
    /// Those that a body strikes before the next look, and others that these strike in turn.
    std::span<const std::uint32_t> struck(const Input& input, const ContactRows& rows,
                                          std::span<const SolverBody> solved);
    /// Contacts of general pairs of bodies that stand still, or cannot move, and the deepest overlap [m].
    std::size_t heldContacts() const { return m_heldContacts; }
    double heldDeepest() const { return m_heldDeepest; }
    std::size_t bytes() const { return m_still.bytes(); }

  private:
    static constexpr std::uint32_t immobile = SteppedIslands::immobile;

    bool isUnbalanced(const SteppedInput& input, const SteppedIslands& islands, std::uint32_t number,
                      double part) const;
    void touchBesideChanged(const Input& input);
    void addUpLoadsOf(const Input& input, std::uint32_t pair);
    void addUpSpringLoads(const Input& input);
    bool addsLoad(std::uint32_t number) const { return m_still.rests(number) && m_still.isTouched(number); }
    /// What a contact with `other` adds to.
    StillBodies::Load& loadOf(std::uint32_t number, std::uint32_t other) {
        return m_still.is(other) ? m_still.lasting(number) : m_still.passing(number);
    }
    /// A force on B [N].
    void addLoads(std::uint32_t a, std::uint32_t b, const Vec3& armA, const Vec3& armB, const Vec3& force) {
        if (addsLoad(a)) loadOf(a, b).add(armA, -force);
        if (addsLoad(b)) loadOf(b, a).add(armB, force);
    }
    void strike(const Input& input, std::uint32_t from, std::uint32_t to, double closing, double restitution);
    void passOnStrikes(const Input& input);

    StillBodies m_still;
    bool m_isChanged = false;
    std::size_t m_heldContacts = 0;
    double m_heldDeepest = 0;
    Scratch<PairSet> m_loadPairs;                      // general pairs whose loads are added up
    Scratch<std::vector<std::uint32_t>> m_found;       // numbers
    Scratch<std::vector<double>> m_given;              // by number: speed that a strike may give it [m/s]
    Scratch<std::vector<std::uint32_t>> m_struckStill; // numbers of these
};

} // namespace carom
