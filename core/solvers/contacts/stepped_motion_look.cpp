// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/reserve.h"
#include "core/base/shared_loops.h"
#include "core/dynamics/contact_memory.h"
#include "core/solvers/contacts/contact_settings.h"
#include "core/solvers/contacts/stepped_motion.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

// Where the contacts of the base path are, and which of its pairs need not be looked at.

namespace carom {
namespace {

/// Frames that one thread makes at least.
constexpr std::size_t fewFrames = Workers::enoughOf(20);
/// Pairs that it lists.
constexpr std::size_t fewSeen = Workers::enoughOf(5);

/// By the bits of the points of a pair: how many there are.
constexpr std::array<std::uint8_t, 1U << mostRowPoints> countOf = [] {
    std::array<std::uint8_t, 1U << mostRowPoints> counts{};
    for (unsigned bits = 0; bits < counts.size(); ++bits)
        counts[bits] = static_cast<std::uint8_t>(std::popcount(bits));
    return counts;
}();

} // namespace

// Finds the contacts at the present poses. Within a frame, rows of pairs are kept of which neither body has
// gone far since they were made.
void SteppedMotion::look(const SteppedInput& input, double duration, Manifolds& manifolds,
                         SteppedReport& report) {
    findMoving(input.workers);
    noteTravel(input, duration);
    keepRows(input, manifolds);
    m_bodies.forgetMoved(input.workers);
    m_found.watched.clear();
    report.contacts = 0;
    findContacts(input, duration, m_bodies.moving().pairs, manifolds, report);
    if (const std::span<const std::uint32_t> struck =
            m_still.struck(stillInput(input, manifolds), m_rows, m_bodies.solved());
        !struck.empty()) {
        moveOn(input, struck, manifolds);
        if (input.ledger != nullptr)
            m_atBegin.potential += invariantsOf(input.bodies, std::span(m_movedOn).last(struck.size()),
                                                input.state, input.gravity)
                                       .potential;
        lookAgain(input, duration, struck, manifolds, report);
    }
    m_arePartsFound = false;
    report.contacts +=
        wideLanes * m_pairs.balls().activeGroups() + m_pairs.balls().heldContacts() + m_still.heldContacts();
    report.maxPenetration =
        std::max({report.maxPenetration, m_deepest, m_still.heldDeepest(), m_pairs.balls().heldDeepest()});
}

void SteppedMotion::findMoving(Workers& workers) {
    if (!m_bodies.findMoving(m_still.bodies().flags(), m_pairs.ends(m_islands, workers), m_islands, workers))
        return;
    m_part.resize(m_islands.numbers());
    std::iota(m_part.begin(), m_part.end(), 0U);
    m_travel.assign(m_islands.numbers(), {});
    m_coming.assign(m_islands.numbers(), {});
}

// Finds the contacts of balls, and of these pairs, by number in m_general.
void SteppedMotion::findContacts(const SteppedInput& input, double duration,
                                 std::span<const std::uint32_t> pairs, Manifolds& manifolds,
                                 SteppedReport& report) {
    m_pairs.balls().refresh(m_bodies.solved(), m_bodies.places(), duration, input.gravity, input.workers);
    m_deepest = std::max(m_deepest, m_pairs.balls().deepest());
    m_hasEmptyRows = false;
    m_found.touching.clear();
    m_found.parted.clear();
    reserveFor(m_pairs.general().size(), m_found.watched);
    m_frameOf.resize(m_islands.numbers(), BallRows::noPair);
    m_pairs.beginLook();
    const ManifoldInput here{input.bodies, input.state, input.gravity, duration};
    updatePairs(here, pairs, manifolds, input.workers, report);
    report.contacts += listFound(input.workers);
    for (const std::uint32_t entry : m_found.parted) m_rows.remove(oldRowsOf(entry));
    addRows(here, manifolds, input.workers);
    m_deepest = std::max(m_deepest, m_rows.end(m_bodies.solved(), m_frames, m_step, input.workers));
}

// Lists what was seen of pairs, by what follows from it. Returns how many have points.
std::size_t SteppedMotion::listFound(Workers& workers) {
    std::atomic<std::size_t> contacts = 0;
    workers.forLists(
        m_seen.size(), fewSeen, static_cast<Found&>(m_found),
        [&](std::size_t begin, std::size_t end, Found& found) {
            std::size_t count = 0;
            for (const Seen& seen : std::span<const Seen>(m_seen).subspan(begin, end - begin)) {
                count += seen.hasPoints ? 1 : 0;
                if (seen.isTouching) {
                    found.touching.push_back(seen);
                    continue;
                }
                const auto& [entry, open, heldDepth] = m_pairs.general()[seen.number];
                if (seen.isWatched) found.watched.push_back({entry, seen.number, open});
                if (m_rowState[entry] == Rows::Old) found.parted.push_back(entry);
            }
            contacts += count;
        },
        [this](const Found& part) { m_found.append(part); });
    return contacts;
}

// How much two bodies may come nearer to each other along a normal from A to B before the next look [m].
CAROM_INLINE double SteppedMotion::comesAlong(const Vec3& normal, std::uint32_t numberA,
                                              std::uint32_t numberB) const {
    const Travel &a = m_travel[numberA], &b = m_travel[numberB];
    return std::max(0.0, normal.dot(a.comes - b.comes) + a.turns + b.turns);
}

CAROM_INLINE bool SteppedMotion::staysOpen(OpenPair& pair, double fall) const {
    double& gap = pair.gap;
    if (!(gap > 0)) return false;
    const Travel &a = m_travel[pair.a], &b = m_travel[pair.b];
    gap += pair.normal.dot(b.came - a.came) - a.turned - b.turned;
    return gap > pair.slack + fall + comesAlong(pair.normal, pair.a, pair.b);
}

CAROM_INLINE SteppedMotion::Seen SteppedMotion::see(const ManifoldInput& here, std::uint32_t number,
                                                    double fall, Manifolds& manifolds,
                                                    std::size_t& collided) {
    const Entry& entry = m_pairs.entryOf(number);
    OpenPair& open = m_pairs.general()[number].open;
    if (Rows& rows = m_rowState[m_pairs.general()[number].entry]; rows == Rows::Kept) {
        if (!(open.gap > 0) || staysOpen(open, fall)) return {.number = number, .hasPoints = true};
        rows = Rows::Old;
    }
    if (entry.isFresh || open.lacksRows || !staysOpen(open, fall))
        return seeAnew(here, number, fall, manifolds, collided);
    return {.number = number, .hasPoints = open.hasPoints, .isWatched = open.gap <= entry.margin};
}

// Updates the manifold of a pair that may meet.
SteppedMotion::Seen SteppedMotion::seeAnew(const ManifoldInput& here, std::uint32_t number, double fall,
                                           Manifolds& manifolds, std::size_t& collided) {
    Entry& entry = m_pairs.entryOf(number);
    OpenPair& open = m_pairs.general()[number].open;
    PersistentManifold& manifold = manifolds[entry.place];
    if (std::exchange(entry.isFresh, false))
        openIfApart(here, manifold);
    else
        collided += updateManifold(here, entry.margin, manifold) ? 1 : 0;
    if (!(open.slack > 0)) open = openPairOf(here.bodies, entry.pair);
    const Vec3 normal = normalOf(here, manifold);
    open.normal = normal;
    open.hasPoints = manifold.count > 0;
    open.lacksRows = false;
    if (manifold.open) {
        open.gap = manifold.gap;
        return {.number = number, .hasPoints = open.hasPoints, .isWatched = open.gap <= entry.margin};
    }
    const double reach = open.slack + fall + comesAlong(normal, open.a, open.b);
    const NearPoints near = nearPoints(here, manifold, normal, reach);
    open.lacksRows = std::isfinite(near.next);
    open.gap = open.lacksRows ? near.next : 0;
    return {.number = number,
            .a = open.a,
            .b = open.b,
            .near = static_cast<std::uint8_t>(near.bits),
            .isRound = manifold.round,
            .hasPoints = open.hasPoints,
            .isTouching = open.hasPoints};
}

// Updates the manifolds of pairs that may meet before the next look. Each is written by one thread.
void SteppedMotion::updatePairs(const ManifoldInput& here, std::span<const std::uint32_t> pairs,
                                Manifolds& manifolds, Workers& workers, SteppedReport& report) {
    const double fall = here.gravity.norm() * here.duration * here.duration;
    std::atomic<std::size_t> collided = 0;
    m_seen.resize(pairs.size());
    workers.forRanges(pairs.size(), fewManifolds, [&](std::size_t begin, std::size_t end) {
        std::size_t count = 0;
        for (std::size_t i = begin; i < end; ++i) m_seen[i] = see(here, pairs[i], fall, manifolds, count);
        collided += count;
    });
    report.work.pairsCollided += collided;
}

// The place that the frame of a body will have, or that of one along the axes of the world.
CAROM_INLINE std::uint32_t SteppedMotion::frameOf(BodyIndex body, std::uint32_t number, bool turns) {
    const std::uint32_t next = static_cast<std::uint32_t>(m_framed.size());
    const bool isKept = number != immobile && turns;
    if (isKept && m_frameOf[number] != BallRows::noPair) return m_frameOf[number];
    if (isKept) m_frameOf[number] = next;
    m_framed.push_back({body, turns});
    return next;
}

// Makes rows of the pairs in contact, section by section: in the place of those that they had, or in one that
// depends on the pairs before. What they are does not.
void SteppedMotion::addRows(const ManifoldInput& here, Manifolds& manifolds, Workers& workers) {
    std::span<const SectionEnd> sections = m_islands.plan().sort(
        m_found.touching, m_sorted, [](const Seen& seen) { return std::pair(seen.a, seen.b); }, workers);
    if (!m_rows.groups().empty()) sections = {}; // they are after those that are kept
    m_placed.clear();
    m_framed.clear();
    forEachInSections(
        m_found.touching.size(), sections,
        [&](std::size_t i) {
            const Seen& seen = m_found.touching[i];
            const std::uint32_t entry = m_pairs.general()[seen.number].entry;
            const auto [a, b] = m_pairs.entries()[entry].pair;
            const std::size_t count = countOf[seen.near];
            const bool hasRows = m_rowState[entry] == Rows::Old;
            const LanePacker::Place old = hasRows ? oldRowsOf(entry) : LanePacker::Place{};
            const bool isAgain = hasRows && m_rows.placeAgain(old, count);
            if (hasRows && !isAgain) m_rows.remove(old);
            if (m_division.looks > 1) noteCap(seen, manifolds[m_pairs.entries()[entry].place]);
            m_placed.push_back({isAgain ? old : m_rows.placeCarried(seen.a, seen.b, count, entry),
                                seen.number, entry, frameOf(a, seen.a, !seen.isRound),
                                frameOf(b, seen.b, !seen.isRound), seen.near, isAgain});
        },
        [this](std::size_t phase) { m_rows.endSection(phase); });
    for (const Framed& framed : m_framed) m_frameOf[m_islands.numberOf(framed.body)] = BallRows::noPair;
    m_frames.resize(m_framed.size());
    workers.forRanges(m_framed.size(), fewFrames, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) m_frames[i] = frameOf(here, m_framed[i]);
    });
    workers.forRanges(m_placed.size(), fewManifolds, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) setRow(here, m_placed[i], manifolds);
    });
    const auto rolls = [this](const Placed& placed) { return m_pairs.lawsOf(placed.entry).rolling > 0; };
    if (!holdsForAny(m_placed.size(), fewSeen, workers, [&](std::size_t i) { return rolls(m_placed[i]); }))
        return;
    for (const Placed& placed : m_placed) {
        if (!rolls(placed)) continue;
        const PairInput pair = rowOf(here.bodies, placed, manifolds[m_pairs.entries()[placed.entry].place]);
        if (placed.isAgain)
            m_rows.turnRolling(placed.place, pair.normal, m_bodies.solved());
        else
            m_rows.addRolling(pair, placed.place, m_bodies.solved());
    }
}

// Cylinders that stand on a cap may turn less until the next look, where there are several in a substep:
// in larger islands that costs more than it gains.
void SteppedMotion::noteCap(const Seen& seen, const PersistentManifold& manifold) {
    if (manifold.count <= 2) return;
    for (const std::uint32_t number : {seen.a, seen.b})
        m_bodies.turnable()[number].most = m_bodies.turnable()[number].onCap;
}

BodyFrame SteppedMotion::frameOf(const ManifoldInput& here, const Framed& framed) const {
    const Pose& pose = here.state.pose[framed.body];
    return {framed.turns ? pose.orientation.toRotationMatrix() : Mat3(Mat3::Identity()), pose.position};
}

// The contact at the present poses, with separations as at the look: rows add the displacement since.
PlacedManifold SteppedMotion::placedAtLook(const ManifoldInput& here,
                                           const PersistentManifold& manifold) const {
    const auto [a, b] = m_islands.numbersOf(manifold.pair);
    return placedAtLook(here, manifold, {m_bodies.moved()[a], m_bodies.moved()[b]});
}

// The same where the two bodies have moved so far.
PlacedManifold SteppedMotion::placedAtLook(const ManifoldInput& here, const PersistentManifold& manifold,
                                           const std::array<Displacement, 2>& moved) {
    PlacedManifold contact = placed(here, manifold);
    const auto& [from, to] = moved;
    for (PointInput& point : contact.points)
        point.separation -= contact.normal.dot(vectorOf(to.shift) + vectorOf(to.turn).cross(point.armB) -
                                               vectorOf(from.shift) - vectorOf(from.turn).cross(point.armA));
    return contact;
}

// A pair with the points of a contact, whose impulses and torque are in [N s] and [N m s].
PairInput SteppedMotion::rowOf(const Bodies& bodies, std::uint32_t entry, const PlacedManifold& contact) {
    PairInput pair = m_pairs.inputOf(bodies, m_islands, entry);
    pair.normal = contact.normal;
    pair.torque = contact.torque;
    pair.points = std::span(contact.points).first(static_cast<std::size_t>(contact.count));
    return pair;
}

PairInput SteppedMotion::rowOf(const Bodies& bodies, const Placed& placed,
                               const PersistentManifold& manifold) {
    PairInput pair = m_pairs.inputOf(bodies, m_islands, placed.entry);
    pair.normal = m_pairs.general()[placed.number].open.normal;
    pair.torque = manifold.torque;
    return pair;
}

void SteppedMotion::setRow(const ManifoldInput& here, const Placed& placed, Manifolds& manifolds) {
    PersistentManifold& manifold = manifolds[m_pairs.entries()[placed.entry].place];
    const auto [a, b] = manifold.pair;
    const bool isBetween = here.bodies.mobile[a] != 0 && here.bodies.mobile[b] != 0 &&
                           !(isSphere(here.bodies, a) && isSphere(here.bodies, b));
    CarriedPoints points{.frameA = placed.frameA, .frameB = placed.frameB, .middle = isBetween ? 0.5 : 0};
    for (std::size_t k = 0; k < static_cast<std::size_t>(manifold.count); ++k)
        if ((placed.near >> k & 1U) != 0)
            points.points[points.count++] = &manifold.points[k];
        else
            manifold.points[k].force.setZero(); // what touches again begins without a force
    m_rows.setCarried(placed.place, rowOf(here.bodies, placed, manifold), points);
}

void SteppedMotion::noteTravel(const SteppedInput& input, double duration) {
    m_bodies.forEachOf(m_bodies.moving().paired, input.workers, [&](std::uint32_t i) {
        const BodyIndex body = m_islands.bodyOf(i);
        const SolverBody& from = m_bodies.solved()[i];
        const double radius = from.roundInverse > 0 ? 0 : input.bodies.boundingRadius[body];
        m_travel[i] = {vectorOf(m_bodies.moved()[i].shift), duration * vectorOf(from.velocity),
                       radius * m_bodies.moved()[i].angle,
                       duration * radius * vectorOf(from.spin).norm() +
                           input.bodies.forces.reach(body, duration)};
    });
}

// What is the same for a pair until bodies get other numbers.
OpenPair SteppedMotion::openPairOf(const Bodies& bodies, BodyPair pair) const {
    const auto turning = [&](BodyIndex i) {
        return bodies.mobile[i] != 0 && !isSphere(bodies, i) ? bodies.boundingRadius[i] : 0;
    };
    return {.a = m_islands.numberOf(pair.a),
            .b = m_islands.numberOf(pair.b),
            .radiusA = turning(pair.a),
            .radiusB = turning(pair.b),
            .slack = slackPart * smallerSize(bodies, pair)};
}

} // namespace carom
