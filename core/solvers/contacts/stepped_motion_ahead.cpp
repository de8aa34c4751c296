// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/wide.h"
#include "core/math/rotation.h"
#include "core/solvers/contacts/stepped_motion.h"
#include "core/solvers/contacts/wide_bodies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

// Contacts of the base path that are found anew within a look, because a body turns far.
//
// Rows foresee that points of a body move along lines. A rod that turns round within a step passes over the
// point that its row holds, and sinks in beside it. So the contacts of such bodies are found where they are
// nearest in the step, at the rate at which they turn; there the row's points move along the surface. Where
// the solve changes that rate, they are found once more, and the solve continues.

namespace carom {
namespace {

/// Angles between the times at which it is seen where a pair is nearest [rad], and so many times at most. At
/// half the angle thin rods in a bin overlap by a tenth less, at twice by a sixth more; half or twice as many
/// times change nothing that their number does not.
constexpr double turnBetween = 0.25;
constexpr double mostTimes = 16;

/// Bodies that would overlap by more than this part of half the thickness of the thinner one are moved apart
/// before their contact is found. At half, stones of a wall gain 1e-5 of the energy of a blow that breaks it;
/// at twice, one more of 3,600 thin bodies passes through a plate that it strikes.
constexpr double mostSunk = 0.25;

/// Groups of rows whose contacts one thread finds ahead, at least.
constexpr std::size_t fewAhead = Workers::enoughOf(2000);
/// And that it looks through for these.
constexpr std::size_t fewGroups = Workers::enoughOf(10);

bool beginsImpact(const RowPoint& row, std::size_t lane) { return row.approach[lane] > 0; }
bool tookImpact(const RowPoint& row, std::size_t lane) {
    return row.approach[lane] > 0 && row.normal[lane] > 0;
}

/// Whether is(row, lane) holds for any point of a pair.
template<class Is>
bool holdsForAny(const ContactRows& rows, const LanePacker::Place& place, const Is& is) {
    const RowGroup& group = rows.groups()[place.group];
    const std::span<const RowPoint> points = rows.points().subspan(group.firstPoint, group.points);
    return std::any_of(points.begin(), points.end(),
                       [&](const RowPoint& row) { return is(row, place.lane); });
}

/// Stores the closing speeds of a pair that is found late in a step, from the velocities before its impulses.
void recordLate(ContactRows& rows, const LanePacker::Place& place, std::span<const BodyVelocity> before,
                double resting) {
    RowGroup& group = rows.groups()[place.group];
    const std::size_t lane = place.lane;
    if (!(group.restitution[lane] > 0)) return;
    const BodyVelocity &a = before[group.a[lane]], &b = before[group.b[lane]];
    for (RowPoint& row : rows.points().subspan(group.firstPoint, group.points)) {
        const Vec3 velocityA = vectorOf(a.velocity) + vectorOf(a.spin).cross(laneOf(row.armA, lane));
        const Vec3 velocityB = vectorOf(b.velocity) + vectorOf(b.spin).cross(laneOf(row.armB, lane));
        const double closing = laneOf(group.normal, lane).dot(velocityA - velocityB);
        if (!(row.massNormal[lane] > 0) || !(closing > resting)) continue;
        row.approach[lane] = closing;
        group.approaches = true;
    }
}

} // namespace

// Marks the bodies that will have turned, at the end of a step, so far since their contacts were found that
// these are elsewhere. Where a cylinder turns about its axis, its surface stays where it is.
void SteppedMotion::foreseeTurned(const SteppedInput& input, double duration) {
    m_foreseen.clear();
    const std::span<const std::uint32_t> list = m_bodies.moving().paired;
    input.workers.forLists(list.size(), fewAwake, static_cast<std::vector<Foreseen>&>(m_foreseen),
                           [&](std::size_t begin, std::size_t end, std::vector<Foreseen>& foreseen) {
                               foreseeTurned(input, duration, list.subspan(begin, end - begin), foreseen);
                           });
    m_hasTurned.assign(m_islands.numbers(), 0);
    for (const Foreseen& body : m_foreseen) {
        m_hasTurned[body.number] = 1;
        m_bodies.noteFar(body.number);
    }
}

CAROM_WIDE void SteppedMotion::foreseeTurned(const SteppedInput& input, double duration,
                                             std::span<const std::uint32_t> list,
                                             std::vector<Foreseen>& foreseen) {
    const Wide time = wideOf(duration);
    for (std::size_t i = 0; i < list.size(); i += wideLanes) {
        const std::array<std::uint32_t, 4> four = fourOf(list, i);
        const Wide3 spin = gatherThree<SolverBody>(m_bodies.solved()[0].spin.data(), four),
                    moved = gatherThree<Displacement>(m_bodies.moved()[0].turn.data(), four),
                    seen = gatherThree<SeenTurn>(m_bodies.seenTurn()[0].turn.data(), four);
        const Wide3 since = moved + time * spin - seen;
        const Wide most{m_bodies.turnable()[four[0]].most, m_bodies.turnable()[four[1]].most,
                        m_bodies.turnable()[four[2]].most, m_bodies.turnable()[four[3]].most};
        if (!anyLane(dot(since, since) > most)) continue;
        for (std::size_t lane = i; lane < std::min(i + wideLanes, list.size()); ++lane)
            foreseeTurned(input, duration, list[lane], foreseen);
    }
}

void SteppedMotion::foreseeTurned(const SteppedInput& input, double duration, std::uint32_t number,
                                  std::vector<Foreseen>& foreseen) {
    const Vec3 turn = duration * vectorOf(m_bodies.solved()[number].spin);
    Vec3 since = vectorOf(m_bodies.moved()[number].turn) + turn - vectorOf(m_bodies.seenTurn()[number].turn);
    if (!(since.squaredNorm() > m_bodies.turnable()[number].most)) return;
    const Pose& pose = input.state.pose[m_islands.bodyOf(number)];
    if (m_bodies.turnable()[number].hasAxis) {
        const Vec3 axis = pose.orientation * Vec3::UnitY();
        since -= axis.dot(since) * axis;
        if (!(since.squaredNorm() > m_bodies.turnable()[number].most)) return;
    }
    foreseen.push_back({number, pose, m_bodies.moved()[number],
                        duration * vectorOf(m_bodies.solved()[number].velocity), turn});
    m_bodies.seenTurn()[number].turn = arrayOf(vectorOf(m_bodies.moved()[number].turn) + turn);
}

// Where a body will be after part of the step.
void SteppedMotion::moveAhead(const Foreseen& body, double part, Pose& pose, Displacement& moved) {
    pose.position = body.pose.position + part * body.shift;
    pose.orientation = (fromRotationVector(part * body.turn) * body.pose.orientation).normalized();
    moved = body.moved;
    add(moved.shift, part * body.shift);
    add(moved.turn, part * body.turn);
}

// Once a step is solved, such contacts are added to the others for the rest of it. Of impacts, too: what one
// side of a thin body strikes stops its other side, which would pass through. Where such a contact takes a
// part of the impact it rebounds as the others do; the rest of these are gone by then, because what rebounds
// turns once more.
bool SteppedMotion::lookAhead(const SteppedInput& input, double duration, Manifolds& manifolds,
                              SteppedReport& report, bool isSolved) {
    foreseeTurned(input, duration);
    if (m_foreseen.empty() && !m_hasEmptyRows) return false;
    const std::size_t groups = m_rows.groups().size();
    listAhead(isSolved, input.workers);
    const ManifoldInput there{input.bodies, input.state, input.gravity, duration};
    // Rows of one group are written by one thread; few scenes have rolling resistance.
    Workers& workers = m_rows.rolling().empty() ? input.workers : Workers::alone();
    const std::span<AheadFinds> parts = workers.forKeptLists(
        m_ahead.groups.size(), fewAhead, static_cast<std::vector<AheadFinds>&>(m_aheadFinds),
        [&](std::size_t begin, std::size_t end, AheadFinds& finds) {
            const auto taskOf = [&](std::size_t group) {
                return group < m_ahead.groups.size() ? m_ahead.groups[group] : m_ahead.tasks.size();
            };
            for (std::size_t i = taskOf(begin); i < taskOf(end); ++i)
                findAnew(there, m_ahead.tasks[i], manifolds, finds);
        });
    std::size_t collided = 0;
    for (const AheadFinds& finds : parts) {
        collided += finds.collided;
        m_hasEmptyRows = m_hasEmptyRows || finds.anyEmpty;
        for (const AheadContact& contact : finds.toAdd) addAhead(there, contact);
    }
    report.work.pairsCollided += collided;
    if (m_rows.groups().size() > groups) m_rows.end(m_bodies.solved());
    for (std::size_t group = groups; group < m_rows.groups().size(); ++group)
        m_ahead.changed.push_back(static_cast<std::uint32_t>(group));
    updateGaps(m_rows, m_ahead.changed, m_bodies.moved());
    return collided > 0;
}

// Lists the pairs with rows to be found anew: those of bodies that turn, and those without points.
CAROM_INLINE void SteppedMotion::listAhead(bool isSolved, std::uint32_t group, AheadList& ahead) const {
    const RowGroup& of = m_rows.groups()[group];
    const std::size_t first = ahead.tasks.size();
    bool changes = false;
    for (std::uint32_t lane = 0; lane < wideLanes; ++lane) {
        const bool turns = (m_hasTurned[of.a[lane]] | m_hasTurned[of.b[lane]]) != 0;
        if (of.source[lane] == ContactRows::noPair) continue;
        const bool isEmpty = m_rows.points()[of.firstPoint].massNormal[lane] == 0;
        if (!isEmpty && !turns) continue;
        const bool adds = isSolved && !isEmpty;
        changes = changes || !adds;
        ahead.tasks.push_back({{.group = group, .lane = lane}, adds});
    }
    if (ahead.tasks.size() > first) ahead.groups.push_back(first);
    if (changes) ahead.changed.push_back(group);
}

void SteppedMotion::listAhead(bool isSolved, Workers& workers) {
    m_ahead.clear();
    workers.forLists(
        m_rows.groups().size(), fewGroups, static_cast<AheadList&>(m_ahead),
        [&](std::size_t begin, std::size_t end, AheadList& ahead) {
            for (std::size_t group = begin; group < end; ++group)
                listAhead(isSolved, static_cast<std::uint32_t>(group), ahead);
        },
        [this](const AheadList& part) { m_ahead.append(part); });
}

// Moves both bodies of a pair to where they are nearest along this normal, within the step. False if they
// cannot touch in it.
bool SteppedMotion::moveToNearest(const ManifoldInput& there, const std::array<std::uint32_t, 2>& numbers,
                                  const Vec3& normal, AheadPair& ahead) const {
    const BodyPair pair = ahead.at.pair;
    std::array<const Foreseen*, 2> turning{};
    double most = 0;
    for (std::size_t side = 0; side < 2; ++side) {
        ahead.at.poses[side] = there.state.pose[side == 0 ? pair.a : pair.b];
        ahead.moved[side] = m_bodies.moved()[numbers[side]];
        if (m_hasTurned[numbers[side]] == 0) continue;
        turning[side] = &*std::lower_bound(
            m_foreseen.begin(), m_foreseen.end(), numbers[side],
            [](const Foreseen& body, std::uint32_t number) { return body.number < number; });
        most = std::max(most, turning[side]->turn.norm());
    }
    const auto gapAt = [&](double part) {
        for (std::size_t side = 0; side < 2; ++side)
            if (turning[side] != nullptr)
                moveAhead(*turning[side], part, ahead.at.poses[side], ahead.moved[side]);
        return gapAlong(there, pair, normal);
    };
    const double start = gapAt(0);
    const SolverBody &a = m_bodies.solved()[numbers[0]], &b = m_bodies.solved()[numbers[1]];
    const double closing = normal.dot(vectorOf(a.velocity) - vectorOf(b.velocity)) +
                           surfaceSpeed(there.bodies, numbers[0]) + surfaceSpeed(there.bodies, numbers[1]);
    if (!canMeetAlong(there, pair, start, closing)) return false;
    const double times = std::clamp(std::ceil(most / turnBetween), 1.0, mostTimes);
    double nearest = std::numeric_limits<double>::infinity(), at = 1;
    for (double k = 1; times > 1 && k <= times; ++k)
        if (const double gap = gapAt(k / times); gap < nearest) {
            nearest = gap;
            at = k / times;
        }
    // Deep in a thin body its other side is nearer, and a contact with that pushes bodies through. So those
    // that would overlap by more than a part of its half thickness are moved apart along the normal of their
    // contact, until they do not.
    const auto halfOf = [&](BodyIndex body) {
        const Shape& shape = there.bodies.shape[body];
        return isWall(shape) ? std::numeric_limits<double>::infinity() : halfThicknessOf(shape);
    };
    const double overlap = std::max(0.0, -gapAt(at) - mostSunk * std::min(halfOf(pair.a), halfOf(pair.b)));
    if (turning[0] == nullptr && turning[1] == nullptr) return true;
    const std::size_t side = turning[1] != nullptr ? 1 : 0;
    const Vec3 shift = (side == 1 ? overlap : -overlap) * normal;
    ahead.at.poses[side].position += shift;
    add(ahead.moved[side].shift, shift);
    return true;
}

/// How fast the surface of a body comes nearer to others at most because it turns [m/s].
double SteppedMotion::surfaceSpeed(const Bodies& bodies, std::uint32_t number) const {
    if (number == immobile || isSphere(bodies, m_islands.bodyOf(number))) return 0;
    return bodies.boundingRadius[m_islands.bodyOf(number)] * vectorOf(m_bodies.solved()[number].spin).norm();
}

// Finds the contact of a pair with rows anew, which keeps its forces unless it is added to them. If the two
// cannot touch within the step, the rows have no points until they can.
void SteppedMotion::findAnew(const ManifoldInput& here, const AheadTask& task, Manifolds& manifolds,
                             AheadFinds& finds) {
    const std::uint32_t group = task.place.group, lane = task.place.lane;
    const RowGroup& of = m_rows.groups()[group];
    const std::uint32_t entry = of.source[lane];
    const double margin = m_pairs.entries()[entry].margin;
    PersistentManifold& manifold = manifolds[m_pairs.entries()[entry].place];
    const Vec3 normal = laneOf(of.normal, lane);
    AheadPair ahead;
    ahead.at.pair = manifold.pair;
    ManifoldInput there = here;
    there.elsewhere = &ahead.at;
    if (!moveToNearest(there, {{of.a[lane], of.b[lane]}}, normal, ahead)) {
        if (task.adds) return;
        finds.anyEmpty = true;
        if (m_rows.points()[of.firstPoint].massNormal[lane] == 0) return; // they have none already
        PairInput none = m_pairs.inputOf(there.bodies, m_islands, entry);
        none.normal = normal;
        return m_rows.replace(group, lane, none, m_bodies.solved());
    }
    if (task.adds) {
        PersistentManifold also = manifold;
        also.count = 0;
        also.torque.setZero(); // the rows that are there have it
        if (!closeManifold(there, margin, also)) return;
        ++finds.collided;
        return finds.toAdd.push_back({task, placedAtLook(there, also, ahead.moved)});
    }
    const auto points = [&] {
        return std::span(manifold.points).first(static_cast<std::size_t>(manifold.count));
    };
    if (!m_rows.storeForces(group, lane, m_step))
        for (std::size_t k = 0; k < points().size(); ++k)
            points()[k].force = m_rows.impulseOf(of, static_cast<int>(lane), k) / m_step;
    manifold.torque = m_rows.torqueOf(group, lane) / m_step;
    closeManifold(there, margin, manifold);
    ++finds.collided;
    PlacedManifold contact = placedAtLook(there, manifold, ahead.moved);
    for (PointInput& point : contact.points) point.impulse *= m_step; // from forces
    contact.torque *= m_step;
    const PairInput pair = rowOf(there.bodies, entry, contact);
    if (pair.points.size() > of.points) return finds.toAdd.push_back({task, contact});
    m_rows.replace(group, lane, pair, m_bodies.solved());
    m_rows.carry(group, lane, points());
}

// Makes rows of a contact found ahead: beside those that the pair has, or in their place, where they have too
// few points.
void SteppedMotion::addAhead(const ManifoldInput& there, const AheadContact& ahead) {
    const auto [task, contact] = ahead;
    const std::uint32_t entry = m_rows.groups()[task.place.group].source[task.place.lane];
    const bool isStruck = task.adds && holdsForAny(m_rows, task.place, &beginsImpact);
    if (!task.adds) m_rows.remove(task.place);
    const LanePacker::Place place = m_rows.add(rowOf(there.bodies, entry, contact), entry, m_bodies.solved());
    if (!task.adds) return;
    m_addedRows.push_back(place);
    if (isStruck) recordLate(m_rows, place, m_bodies.free(), 2 * there.duration * there.gravity.norm());
}

// When the step is solved; those that rebound, when they have.
void SteppedMotion::removeAdded(bool hasRebounded) {
    std::erase_if(m_addedRows, [&](const LanePacker::Place& place) {
        if (!hasRebounded && holdsForAny(m_rows, place, &tookImpact)) return false;
        m_rows.remove(place);
        return true;
    });
}

} // namespace carom
