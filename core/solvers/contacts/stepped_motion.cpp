// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/stepped_motion.h"

#include "core/base/shared_loops.h"
#include "core/base/wide.h"
#include "core/dynamics/contact_memory.h"
#include "core/dynamics/free_rotation.h"
#include "core/math/rotation.h"
#include "core/solvers/contacts/contact_settings.h"
#include "core/solvers/contacts/neighbours.h"
#include "core/solvers/contacts/wide_bodies.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

namespace carom {
namespace {

/// How often a step is solved on with contacts of bodies that were struck within it. At half, an impact
/// passes on through half as many bodies that were apart; at twice, such a step costs up to twice as much.
constexpr int mostRounds = 4;
/// Further sweeps of a step whose springs would have more energy than there is. Without, a net of stiff
/// springs with a ball on it stands still; at twice or four times as many, it moves as with these.
constexpr int mostSpringSweeps = 8;
/// How often impacts of balls go through all that is active in a step. In a break of fifteen balls, of
/// restitution .95, half as often loses twice the energy it should, and twice as often changes nothing.
constexpr int mostStrikes = 4;

/// Passes go through the contacts backwards: bodies are numbered from the ground up
/// (core/dynamics/numbering.h). Why from the top: the head comment of velocity_solve.h.
constexpr bool fromTop = true;

/// Contacts of balls may be stiffer, because balls do not rock on faces (velocity_solve.h).
StepSettings forBalls(StepSettings settings) {
    settings.hardness *= 0.54 / StepSettings{}.hardness;
    settings.damping = 60;
    return settings;
}

std::uint32_t movingEnd(const SpringRow& spring, const StillBodies& still) {
    return still.is(spring.a) ? spring.b : spring.a;
}

// The first body of a list whose velocity or spin is not finite, or 0.
CAROM_WIDE std::uint32_t firstNotFinite(std::span<const SolverBody> bodies,
                                        std::span<const std::uint32_t> list) {
    for (const std::uint32_t i : list) {
        const double* record = recordOf(bodies[i]);
        const Wide motion = loadWide(record), turning = loadWide(record + 4); // masses are finite
        if (anyLane((motion - motion) + (turning - turning))) return i;
    }
    return 0;
}

std::uint32_t firstNotFinite(std::span<const SolverBody> bodies, std::span<const std::uint32_t> list,
                             Workers& workers) {
    std::atomic<bool> any = false;
    workers.forRanges(list.size(), SteppedBodies::fewAwake, [&](std::size_t begin, std::size_t end) {
        if (firstNotFinite(bodies, list.subspan(begin, end - begin)) != 0) any = true;
    });
    return any ? firstNotFinite(bodies, list) : 0;
}

} // namespace

void SteppedMotion::begin(const Bodies& bodies, const Division& division, double substep) {
    m_division = division;
    m_substep = substep;
    m_step = substep / (division.looks * division.steps);
    clear();
    m_islands.begin(bodies.count());
    m_bodies.begin();
    m_still.begin();
    m_links.clear();
    m_pairs.begin(substep);
    m_isOrderedSoon = false;
    m_rows.begin(m_islands.numbers(), immobile);
}

void SteppedMotion::addIsland(const SteppedInput& input, std::span<const BodyIndex> list,
                              std::span<const std::uint32_t> springs) {
    m_isAfterKnown = m_weight.isKnown = false;
    m_pairs.forgetEnds();
    m_bodies.forgetMoving();
    m_islands.add(list);
    for (const BodyIndex body : list) {
        m_bodies.add(input, body);
        m_still.add();
        m_bodies.setMass(input, body, m_islands.numberOf(body), false);
    }
    m_links.insert(m_links.end(), springs.begin(), springs.end());
}

void SteppedMotion::addPair(const SteppedInput& input, const Entry& entry, Manifolds& manifolds) {
    if (m_still.any()) m_still.notePair(m_islands.numberOf(entry.pair.a), m_islands.numberOf(entry.pair.b));
    m_pairs.add(input, entry, m_islands, m_bodies.solved(), m_step, manifolds);
    m_bodies.forgetMoving();
}

// Passes solve for pairs in the order of their bodies' numbers, from the top to the ground, not in that in
// which they were added: a heap whose lowest contacts are solved first does not come to rest.
void SteppedMotion::order(const SteppedInput& input) {
    const bool isUnordered = m_islands.divide(input);
    for (const std::uint32_t i : m_islands.divided()) m_bodies.noteFar(i); // rows follow suit
    if (m_pairs.order()) m_bodies.forgetMoving();
    if (isUnordered) m_pairs.orderBalls(input, m_islands);
}

SteppedReport SteppedMotion::advance(const SteppedInput& input, Manifolds& manifolds, double part) {
    m_islands.settle();
    m_movedOn.clear();
    if (std::exchange(m_isOrderedSoon, false) || input.isFirst) order(input);
    if (m_still.isChanged()) noteStill(input, manifolds);
    SteppedReport report;
    if (input.ledger != nullptr) rememberBefore(input);
    m_step = part * m_substep / (m_division.looks * m_division.steps);
    if (input.isFirst) m_rows.begin(m_islands.numbers(), immobile); // a checkpoint has none
    for (Turnable& turnable : m_bodies.turnable()) turnable.most = turnable.elsewhere;
    for (int k = 0; k < m_division.looks; ++k) {
        look(input, m_step * m_division.steps, manifolds, report);
        for (int i = 0; i < m_division.steps; ++i) {
            lookAhead(input, m_step, manifolds, report, false);
            step(input, m_step, manifolds, report);
            if (report.loss) return report;
        }
        if (m_links.empty()) m_bodies.turnBalls(input, m_islands);
        storeForces(manifolds, input.workers);
        m_still.sampleLoads(m_rows, m_springs, m_pairs.balls(), m_step);
    }
    if (m_still.any()) m_still.takeSamples();
    if (input.ledger != nullptr) recordMotion(input, part * m_substep);
    if (const std::span<const std::uint32_t> unbalanced = m_still.unbalanced(input, m_islands);
        !unbalanced.empty())
        moveOn(input, unbalanced, manifolds);
    return report;
}

// Predicts how far each body moves until the end of the step, from its pose at the look, and whether it was
// struck.
void SteppedMotion::foreseeStruck(double duration, Workers& workers) {
    workers.forRanges(m_bodies.moving().paired.size(), fewAwake, [&](std::size_t begin, std::size_t end) {
        foreseeStruck(duration, std::span(m_bodies.moving().paired).subspan(begin, end - begin));
    });
}

CAROM_WIDE void SteppedMotion::foreseeStruck(double duration, std::span<const std::uint32_t> numbers) {
    const Wide time = wideOf(duration), zero{};
    for (std::size_t k = 0; k < numbers.size(); k += wideLanes) {
        const std::array<std::uint32_t, 4> four = fourOf(numbers, k);
        Motion body;
        gatherVelocity(m_bodies.solved().data(), four, body);
        const Moved moved = gather(m_bodies.moved().data(), four);
        const Wide3 shift = moved.shift + time * body.velocity;
        const Wide turn = body.roundInverse > zero ? zero
                                                   : rootOf(dot(moved.turn, moved.turn)) +
                                                         time * rootOf(dot(body.spin, body.spin));
        std::array<Wide, 4> to{shift.x, shift.y, shift.z, turn};
        transpose(to[0], to[1], to[2], to[3]);
        for (std::size_t lane = 0; lane < wideLanes; ++lane) {
            const std::uint32_t i = four[lane];
            storeWide(m_coming[i].shift.data(), to[lane]); // and the turn
            m_coming[i].isStruck = m_bodies.isStruck(i);
        }
    }
}

// Whether a watched pair with a body that was struck may close its gap within the step.
CAROM_INLINE bool SteppedMotion::isStruck(const Watched& pair) const {
    const Coming &a = m_coming[pair.open.a], &b = m_coming[pair.open.b];
    if (!a.isStruck && !b.isStruck) return false;
    return pair.open.gap + pair.open.normal.dot(vectorOf(b.shift) - vectorOf(a.shift)) <
           pair.open.radiusA * a.turn + pair.open.radiusB * b.turn;
}

// The first of the watched pairs from `number` on that is struck, or `end`.
CAROM_WIDE std::size_t SteppedMotion::nextStruck(std::size_t number, std::size_t end) const {
    while (number < end &&
           (m_found.watched[number].entry == ContactRows::noPair || !isStruck(m_found.watched[number])))
        ++number;
    return number;
}

// Makes rows for contacts of bodies that were struck. True if there were any.
bool SteppedMotion::addStruck(const SteppedInput& input, double duration, Manifolds& manifolds,
                              SteppedReport& report) {
    bool any = m_pairs.balls().findStruck(m_bodies.solved(), m_bodies.places(), m_bodies.moved(), duration,
                                          input.gravity, input.workers);
    bool anyRow = false;
    if (!m_found.watched.empty()) foreseeStruck(duration, input.workers);
    m_struckPairs.clear();
    input.workers.forLists(
        m_found.watched.size(), fewAwake, static_cast<std::vector<std::size_t>&>(m_struckPairs),
        [&](std::size_t begin, std::size_t end, std::vector<std::size_t>& struck) {
            for (std::size_t i = nextStruck(begin, end); i < end; i = nextStruck(i + 1, end))
                struck.push_back(i);
        });
    for (const std::size_t i : std::span<const std::size_t>(m_struckPairs)) {
        auto& [entry, number, open] = m_found.watched[i];
        PersistentManifold& manifold = manifolds[m_pairs.entries()[entry].place];
        const SolverBody &bodyA = m_bodies.solved()[open.a], &bodyB = m_bodies.solved()[open.b];
        if (open.a != immobile) input.state.velocity[manifold.pair.a] = vectorOf(bodyA.velocity);
        if (open.b != immobile) input.state.velocity[manifold.pair.b] = vectorOf(bodyB.velocity);
        const ManifoldInput here{input.bodies, input.state, input.gravity, duration};
        const double speed = (vectorOf(bodyB.velocity) - vectorOf(bodyA.velocity)).norm() +
                             open.radiusA * vectorOf(bodyA.spin).norm() +
                             open.radiusB * vectorOf(bodyB.spin).norm();
        ++report.work.pairsCollided;
        if (!closeManifold(here, duration * speed, manifold)) continue;
        m_rows.add(rowOf(input.bodies, entry, placedAtLook(here, manifold)), entry, m_bodies.solved());
        m_pairs.general()[number].open.gap = 0;
        entry = ContactRows::noPair;
        anyRow = true;
    }
    if (anyRow) {
        m_rows.end(m_bodies.solved());
        updateGaps(m_rows, m_bodies.moved(), input.workers);
    }
    return any || anyRow;
}

// Passes with position feedback.
void SteppedMotion::sweep(const StepSettings& settings, Workers& workers, SteppedReport& report) {
    for (int pass = 0; pass < m_division.passes; ++pass) {
        solveSprings(m_springs, m_bodies.solved());
        m_pairs.balls().solve(m_bodies.solved(), m_bodies.moved(), forBalls(settings), fromTop, workers);
        solveVelocities(m_rows, m_bodies.solved(), settings, fromTop, workers);
        resistRolling(m_rows, m_bodies.solved());
    }
    report.work.rowsSwept += static_cast<std::size_t>(m_division.passes) * points();
}

void SteppedMotion::step(const SteppedInput& input, double duration, Manifolds& manifolds,
                         SteppedReport& report) {
    const Vec3 fall = duration * input.gravity;
    // The contact is as stiff as in a whole step. In a short step it would be much stiffer, and its forces
    // would be far too large in the next one.
    const double whole = m_substep / (m_division.looks * m_division.steps);
    const StepSettings settings{.duration = duration,
                                .hardness = StepSettings{}.hardness * duration / whole,
                                .resting = 2 * fall.norm(),
                                .yield = mostSag / mostCorrection * m_substep,
                                .fall = fall.norm()};
    const bool ballsBounce = m_pairs.balls().recordApproach(m_bodies.solved(), settings, input.workers);
    const bool bounces = recordApproach(m_rows, m_bodies.solved(), settings, input.workers) || ballsBounce;
    m_bodies.beginStep(input, m_islands, duration);
    findPulling(input.bodies);
    prepareSprings(input.bodies, input.state, m_pulling, m_islands.local(), immobile, duration,
                   m_bodies.solved(), m_springs);
    if (!m_pulling.empty()) rememberSprings(input);
    if (bounces) {
        findParts();
        m_energy.remember(m_bodies.solved(), movingParts(), parts(), input.workers);
    }
    m_pairs.balls().warmStart(m_bodies.solved(), input.workers);
    warmStart(m_rows, m_bodies.solved(), input.workers);
    sweep(settings, input.workers, report);
    for (int round = 0; round < mostRounds; ++round) {
        const bool isStruck = addStruck(input, duration, manifolds, report);
        if (!lookAhead(input, duration, manifolds, report, true) && !isStruck) break;
        sweep(settings, input.workers, report);
    }
    limitEnergy(settings, input.workers, true);
    if (!m_pulling.empty()) limitSprings(input, settings, report);
    if (const std::uint32_t lost = firstNotFinite(m_bodies.solved(), m_bodies.moving().awake, input.workers);
        lost != immobile) {
        const bool isVelocity = !vectorOf(m_bodies.solved()[lost].velocity).allFinite();
        report.loss = {m_islands.bodyOf(lost), isVelocity ? "velocity" : "angular velocity"};
        return;
    }
    if (m_bodies.move(input, m_islands, duration, !m_links.empty()))
        m_rows.renewMasses(m_bodies.solved(), m_bodies.hasTurned());
    updateGaps(m_rows, m_bodies.moved(), input.workers);
    report.work.rowsSwept += points(); // the warm start
    for (int pass = 0; pass < m_division.passes; ++pass) {
        solveSprings(m_springs, m_bodies.solved());
        const double ofBalls =
            m_pairs.balls().relax(m_bodies.solved(), m_bodies.moved(), settings, fromTop, input.workers);
        report.residual =
            std::max(ofBalls, relaxVelocities(m_rows, m_bodies.solved(), settings, fromTop, input.workers));
        resistRolling(m_rows, m_bodies.solved());
        report.work.rowsSwept += points();
        if (report.residual <= input.tolerance) break;
    }
    limitEnergy(settings, input.workers, false);
    removeAdded(false);
    if (bounces) rebound(settings, input.workers, report);
    removeAdded(true);
    if (!m_pulling.empty()) m_springLimit.keep(springIslands(input), 0, m_bodies.solved());
    m_bodies.store(input, m_islands);
}

// Takes bodies back towards the velocities that they would have without contacts, as far as these have given
// an island more energy than its bodies have at the speed of rest; impulses by the same part, so that the
// next step begins with what is left. Where an impact is over, a step begins with impulses that throw bodies
// up again, and passes hardly solve for light bodies below heavy ones.
void SteppedMotion::limitEnergy(const StepSettings& settings, Workers& workers, bool corrects) {
    findParts();
    if (!mayGainEnergy(settings, workers)) return;
    const std::span<const std::uint32_t> part = partOf();
    m_stepEnergy.remember(m_bodies.solved(), m_bodies.free(), movingParts(), parts(), workers);
    for (const std::uint32_t i : m_bodies.moving().awake)
        m_stepEnergy.allow(part[i],
                           0.5 * settings.resting * settings.resting / m_bodies.solved()[i].inverseMass);
    for (const SpringRow& spring : m_springs) // m_springLimit is theirs
        m_stepEnergy.allow(part[movingEnd(spring, m_still.bodies())],
                           std::numeric_limits<double>::infinity());
    if (corrects) {
        findCorrection(settings);
        for (std::size_t i = 1; i < m_corrected.size(); ++i) m_stepEnergy.allow(part[i], m_corrected[i]);
    }
    if (!m_stepEnergy.keep(m_bodies.free(), movingParts(), m_bodies.solved(), workers)) return;
    const auto partLeft = [&](std::uint32_t a, std::uint32_t b) {
        return m_stepEnergy.partOf(part[a == immobile || m_still.is(a) ? b : a]);
    };
    m_pairs.balls().scaleImpulses(partLeft);
    m_rows.scaleImpulses(partLeft);
}

// Whether contacts may have given some island that much energy: as if all bodies were balls.
bool SteppedMotion::mayGainEnergy(const StepSettings& settings, Workers& workers) {
    const std::span<const std::uint32_t> awake = m_bodies.moving().awake, part = partOf();
    findGains(m_bodies.solved(), m_bodies.free(), awake, settings.resting * settings.resting, m_gains,
              workers);
    m_gained.assign(parts(), 0);
    for (std::size_t k = 0; k < awake.size(); ++k) m_gained[part[awake[k]]] += m_gains[k];
    return holdsForAny(awake.size(), fewAwake, workers,
                       [&](std::size_t k) { return m_gained[part[awake[k]]] > 0; });
}

void SteppedMotion::rebound(const StepSettings& settings, Workers& workers, SteppedReport& report) {
    m_active.assign(m_islands.numbers(), 0);
    const ActiveBodies active{m_active, immobile};
    const int impacts = m_pairs.balls().activate(active) + activate(m_rows, active);
    if (impacts == 0) return;
    report.work.impacts += static_cast<std::uint64_t>(impacts);
    for (const SpringRow& spring : m_springs)
        m_energy.allow(partOf()[movingEnd(spring, m_still.bodies())], workOf(spring, m_bodies.solved()));
    copyVelocities(m_bodies.solved(), m_bodies.moving().awake, m_before, workers);
    const int passes =
        m_pairs.balls().rebound(m_bodies.solved(), m_bodies.moved(), settings, mostStrikes, active, workers);
    report.work.rowsSwept +=
        wideLanes * (static_cast<std::size_t>(passes) * m_pairs.balls().activeGroups() +
                     static_cast<std::size_t>(m_division.passes) * m_rows.points().size());
    carom::rebound(m_rows, m_bodies.solved(), settings, m_division.passes, active, workers);
    m_energy.keep(m_before, movingParts(), m_bodies.solved(), workers);
}

SpringIslands SteppedMotion::springIslands(const SteppedInput& input) const {
    return {input.bodies,      input.state,          m_pulling,
            m_islands.local(), m_islands.byNumber(), m_islands.islandNumbers()};
}

// Stores the energy that islands with springs may have when the step ends.
void SteppedMotion::rememberSprings(const SteppedInput& input) {
    m_springLimit.remember(springIslands(input), m_bodies.solved());
    for (const Entry& entry : m_pairs.entries())
        if (const auto [a, b] = m_islands.numbersOf(entry.pair); a == immobile || b == immobile)
            m_springLimit.hold(m_islands.of(entry.pair));
    for (std::uint32_t island = 0; island < m_islands.islandNumbers(); ++island)
        if (m_islands.hasStill(island)) m_springLimit.hold(island);
}

// What position correction may add to the energy of each body.
void SteppedMotion::findCorrection(const StepSettings& settings) {
    m_corrected.assign(m_islands.numbers(), 0);
    addCorrection(m_rows, settings, m_corrected);
    m_pairs.balls().addCorrection(m_bodies.moved(), forBalls(settings), m_corrected);
}

// Solves on while islands with springs have more energy than there is, and slows them down to what it allows,
// with what position correction may add to it.
void SteppedMotion::limitSprings(const SteppedInput& input, const StepSettings& settings,
                                 SteppedReport& report) {
    const SpringIslands islands = springIslands(input);
    findCorrection(settings);
    m_springLimit.allow(islands, m_corrected);
    for (int more = 0;
         more < mostSpringSweeps && m_springLimit.isExceeded(islands, settings.duration, m_bodies.solved());
         ++more)
        sweep(settings, input.workers, report);
    m_springLimit.keep(islands, settings.duration, m_bodies.solved());
}

void SteppedMotion::storeForces(Manifolds& manifolds, Workers& workers) const {
    const double perStep = 1 / m_step;
    m_rows.storeForces(m_step, workers);
    for (const RowGroup& group : m_rows.groups().subspan(m_rows.carriedGroups()))
        for (std::size_t lane = 0; lane < wideLanes; ++lane) {
            if (group.source[lane] == ContactRows::noPair) continue;
            PersistentManifold& manifold = manifolds[m_pairs.entries()[group.source[lane]].place];
            for (std::size_t k = 0; k < static_cast<std::size_t>(manifold.count); ++k)
                manifold.points[k].force = perStep * m_rows.impulseOf(group, static_cast<int>(lane), k);
        }
    for (const RollingRow& row : m_rows.rolling()) {
        const std::uint32_t source = m_rows.groups()[row.group].source[row.lane];
        if (source != ContactRows::noPair)
            manifolds[m_pairs.entries()[source].place].torque = perStep * row.torque;
    }
}

std::size_t SteppedMotion::bytes() const { return heldBytes(m_islands, m_bodies, m_still, m_links, m_pairs); }

void SteppedMotion::clear() {
    m_islands.clear();
    m_isAfterKnown = m_weight.isKnown = false;
}

} // namespace carom
