// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/scratch.h"
#include "core/dynamics/bodies.h"
#include "core/dynamics/contact_constraint.h"
#include "core/dynamics/ledger.h"

#include <span>
#include <vector>

// Bodies at rest sleep: they are not simulated until something may touch them.
//
// A refined island is put to sleep after a substep that began and ended with all its velocities zero and
// moved nothing: its forces balance, and the substeps to come would find the same. (What is slower than the
// tolerance of the contact problem has been stopped before, IslandMotion::settle.) One on the base path,
// whose forces balance less exactly, after it has been slow for so long that no unstable motion can be in it
// (contacts.cpp). An island is woken whole, with the forces it had when it fell asleep:
//
//     reach      a body that moves may touch one of it within the substep
//     velocity   one of its bodies was given a velocity: by a ball that hit it, by an edit
//
// Until then a substep skips it: its pairs are not searched, collided or solved for.

namespace carom {

class SleepingBodies {
  public:
    explicit SleepingBodies(std::size_t bodies) : m_next(bodies, noBody) {
        m_bodies.reserve(bodies);
        m_fallenAsleep.reserve(bodies);
    }

    bool isAsleep(BodyIndex body) const { return m_next[body] != noBody; }
    /// All sleeping bodies, ascending; as of the last exchange.
    std::span<const BodyIndex> bodies() const { return m_bodies; }
    /// Contacts among sleeping bodies and with immobile ones.
    const ContactSet& contacts() const { return m_contacts; }
    double deepest() const { return m_deepest; } ///< overlap of these contacts [m]
    /// Of what a copy holds.
    std::size_t bytes() const { return heldBytes(m_next, m_bodies, m_fallenAsleep, m_contacts); }

    /// Puts an island to sleep. exchange() must follow before the next substep.
    void putToSleep(std::span<const BodyIndex> island);
    /// Wakes the island of a body that sleeps and appends it to `woken`. exchange() must follow.
    void wake(BodyIndex body, std::vector<BodyIndex>& woken);
    /// Takes over the contacts of bodies that have been put to sleep, and returns those of bodies that were
    /// woken. Pairs ascend in both sets.
    void exchange(const Bodies& bodies, ContactSet& moving);

    /// Records in the audit that contact forces bear the weight of sleeping bodies over `duration` [s], but
    /// for what springs to immobile bodies and to the world bear of it.
    void record(const Bodies& bodies, const State& state, const Vec3& gravity, double duration,
                Ledger& ledger) const;

  private:
    std::vector<BodyIndex> m_next; // by body: the next one of its island, in a ring; noBody: it is awake
    std::vector<BodyIndex> m_bodies, m_fallenAsleep; // m_fallenAsleep: since the last exchange
    ContactSet m_contacts;
    Scratch<ContactSet> m_rests, m_moves; // of an exchange
    double m_deepest = 0;
    bool m_changed = false;
};

/// The pairs of two sets that have none in common, ascending.
ContactSet merged(const ContactSet& one, const ContactSet& other);

} // namespace carom
