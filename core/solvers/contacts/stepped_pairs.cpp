// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/stepped_pairs.h"

#include "core/dynamics/contact_memory.h"
#include "core/solvers/contacts/contact_settings.h"
#include "core/solvers/contacts/neighbours.h"

#include <algorithm>
#include <variant>

namespace carom {
namespace {

/// A pair is near that is nearer than this part of the smaller one's size: twice the gap at which it may
/// touch however slow it is. Half would be that gap, which a pair can close at once; twice keeps more pairs.
constexpr double nearPart = 2 * slackPart;
/// Groups of balls of which one thread looks at the pairs, at least.
constexpr std::size_t fewPlaced = Workers::enoughOf(50);
/// Pairs of which it lists the places.
constexpr std::size_t fewOrdered = Workers::enoughOf(1);

} // namespace

void SteppedPairs::begin(double substep) {
    m_substep = substep;
    m_entries.clear();
    m_general.clear();
    m_ascending = 0;
    m_balls.clear();
    m_laws.clear();
    forgetEnds();
}

void SteppedPairs::add(const SteppedInput& input, const Entry& entry, const SteppedIslands& islands,
                       std::span<const SolverBody> solved, double step, Manifolds& manifolds) {
    const auto [a, b] = entry.pair;
    m_entries.push_back(entry);
    const ContactPair laws = pairOf(input.bodies, entry.pair, 0);
    const bool areBalls = (isSphere(input.bodies, a) || isWall(input.bodies.shape[a])) &&
                          (isSphere(input.bodies, b) || isWall(input.bodies.shape[b]));
    if (areBalls && laws.rolling == 0) {
        const bool isKnown = entry.place != Manifolds::none && manifolds[entry.place].count > 0;
        addBalls(input, islands, solved, laws,
                 isKnown ? Vec3(step * manifolds[entry.place].points[0].force) : Vec3(Vec3::Zero()));
        return;
    }
    if (m_ascending == m_general.size() && (m_general.empty() || m_entries[m_general.back().entry] < entry))
        ++m_ascending;
    forgetEnds();
    m_general.push_back({.entry = static_cast<std::uint32_t>(m_entries.size() - 1), .open = {}});
    if (entry.place == Manifolds::none) m_entries.back().place = manifolds.add(entry.pair);
}

// The last entry, with an impulse on the second body of its pair.
void SteppedPairs::addBalls(const SteppedInput& input, const SteppedIslands& islands,
                            std::span<const SolverBody> solved, const ContactPair& laws,
                            const Vec3& impulse) {
    Entry& entry = m_entries.back();
    entry.isFlipped = islands.numberOf(entry.pair.b) == immobile;
    const BodyIndex a = entry.isFlipped ? entry.pair.b : entry.pair.a,
                    b = entry.isFlipped ? entry.pair.a : entry.pair.b;
    BallPair pair{.a = islands.numberOf(a),
                  .b = islands.numberOf(b),
                  .radiusB = input.bodies.boundingRadius[b],
                  .impulse = entry.isFlipped ? Vec3(-impulse) : impulse,
                  .friction = laws.friction,
                  .restitution = laws.restitution,
                  .push = mostCorrection * laws.size / m_substep};
    const Vec3& placeB = input.state.pose[b].position;
    if (const Wall* wall = std::get_if<Wall>(&input.bodies.shape[a])) {
        pair.wall = true;
        pair.normal = wall->normal;
        pair.fixed = placeB - distanceTo(*wall, placeB) * wall->normal;
    } else {
        pair.radiusA = input.bodies.boundingRadius[a];
        if (pair.a == immobile) pair.fixed = input.state.pose[a].position;
        const Vec3 between = placeB - input.state.pose[a].position;
        const double distance = between.norm();
        if (distance > 0) pair.normal = between / distance;
    }
    m_balls.add(pair, static_cast<std::uint32_t>(m_entries.size() - 1), immobile, solved);
}

const PairEnds& SteppedPairs::ends(const SteppedIslands& islands, Workers& workers) {
    const auto endsOf = [&](std::size_t number) {
        return islands.numbersOf(m_entries[m_general[number].entry].pair);
    };
    if (!m_ends.isKnown()) m_ends.make(m_general.size(), islands.numbers(), endsOf, workers);
    return m_ends;
}

const SteppedPairs::Laws& SteppedPairs::lawsOf(const Bodies& bodies, std::uint32_t entry) {
    Laws& laws = m_laws[entry];
    if (laws.push > 0) return laws;
    const ContactPair of = pairOf(bodies, m_entries[entry].pair, 0);
    return laws = {of.friction, of.restitution, of.rolling, mostCorrection * of.size / m_substep, of.size};
}

PairInput SteppedPairs::inputOf(const Bodies& bodies, const SteppedIslands& islands, std::uint32_t entry) {
    const Laws& laws = lawsOf(bodies, entry);
    const auto [a, b] = islands.numbersOf(m_entries[entry].pair);
    return {.a = a,
            .b = b,
            .friction = laws.friction,
            .restitution = laws.restitution,
            .rolling = laws.rolling,
            .push = laws.push,
            .points = {}};
}

// Makes a manifold like updateManifold() would.
PersistentManifold SteppedPairs::manifoldOf(const Bodies& bodies, const State& state, const Entry& entry,
                                            const Vec3& normal, const Vec3& force) {
    PersistentManifold manifold;
    manifold.pair = entry.pair;
    const auto [first, second] = entry.pair;
    const BodyIndex a = entry.isFlipped ? second : first, b = entry.isFlipped ? first : second;
    const Pose &poseA = state.pose[a], &poseB = state.pose[b];
    const Vec3 onB = -bodies.boundingRadius[b] * normal;
    Vec3 onA = bodies.boundingRadius[a] * normal;
    if (const Wall* wall = std::get_if<Wall>(&bodies.shape[a]))
        onA = poseB.position - distanceTo(*wall, poseB.position) * normal - poseA.position;
    manifold.count = 1;
    manifold.round = true;
    manifold.open = force == Vec3::Zero();
    manifold.normal = entry.isFlipped ? Vec3(-normal) : normal;
    manifold.gap = normal.dot(poseB.position + onB - poseA.position - onA);
    if (entry.isFlipped)
        manifold.points[0] = {onB, onA, -force};
    else
        manifold.points[0] = {onA, onB, force};
    return manifold;
}

void SteppedPairs::handOver(const SteppedInput& input, const SteppedIslands& islands, bool all, double step,
                            Manifolds& manifolds, std::vector<Entry>& entries) {
    const auto goes = [&](const Entry& entry) { return all || islands.isMarked(entry.pair); };
    m_balls.forEach([&](std::uint32_t index, const Vec3& normal, const Vec3& impulse) {
        Entry& entry = m_entries[index];
        if (!goes(entry) || (entry.place == Manifolds::none && impulse == Vec3::Zero())) return;
        if (entry.place == Manifolds::none) entry.place = manifolds.add(entry.pair);
        manifolds[entry.place] = manifoldOf(input.bodies, input.state, entry, normal, 1 / step * impulse);
    });
    for (const Entry& entry : m_entries)
        if (entry.place != Manifolds::none && goes(entry)) entries.push_back(entry);
}

void SteppedPairs::findLeaving(const SteppedIslands& islands, std::vector<std::uint32_t>& newNumbers) const {
    newNumbers.assign(m_entries.size(), 0);
    for (std::size_t i = 0; i < m_entries.size(); ++i)
        if (islands.isMarked(m_entries[i].pair)) newNumbers[i] = gone;
}

void SteppedPairs::leave(NewNumbers& numbers) {
    renumber(numbers.entries);
    for (General& pair : m_general) pair = {.entry = pair.entry, .open = {}}; // they are looked at anew
    m_balls.keep(numbers.entries, numbers.bodies, immobile);
}

// Removes entries whose new number is `gone`; the others get theirs.
void SteppedPairs::renumber(std::vector<std::uint32_t>& numbers) {
    std::uint32_t kept = 0;
    m_laws.resize(m_entries.size()); // those that came since the last look have none
    for (std::uint32_t i = 0; i < m_entries.size(); ++i) {
        if (numbers[i] == gone) continue;
        m_entries[kept] = m_entries[i];
        m_laws[kept] = m_laws[i];
        numbers[i] = kept++;
    }
    m_entries.resize(kept);
    m_laws.resize(kept);
    const auto isGone = [&](const General& pair) { return numbers[pair.entry] == gone; };
    const std::span<const General> ascending = general().first(m_ascending);
    m_ascending -= static_cast<std::size_t>(std::count_if(ascending.begin(), ascending.end(), isGone));
    std::erase_if(m_general, isGone);
    for (General& pair : m_general) pair.entry = numbers[pair.entry];
    forgetEnds();
}

// Passes solve for pairs in the order of their bodies' numbers, from the top to the ground, not in that in
// which they were added: a heap whose lowest contacts are solved first does not come to rest. Inserts the
// pairs that were added among those that are in order.
bool SteppedPairs::order() {
    if (m_ascending == m_general.size()) return false;
    forgetEnds();
    const auto isBefore = [this](const General& one, const General& other) {
        return m_entries[one.entry] < m_entries[other.entry];
    };
    auto end = m_general.begin() + static_cast<std::ptrdiff_t>(m_ascending), to = m_general.end();
    m_added.assign(end, to);
    std::sort(m_added.begin(), m_added.end(), isBefore);
    for (; !m_added.empty(); m_added.pop_back()) { // from the end on, so that each moves once
        const auto place = std::upper_bound(m_general.begin(), end, m_added.back(), isBefore);
        to = std::move_backward(place, end, to);
        end = place;
        *--to = {.entry = m_added.back().entry, .open = {}};
    }
    m_ascending = m_general.size();
    return true;
}

// In islands that are in order, which have other rows then, all stay in the order that they have, so that it
// depends on no other island.
void SteppedPairs::orderBalls(const SteppedInput& input, SteppedIslands& islands) {
    PlacedPairs& placed = m_placed;
    placed.clear();
    input.workers.forLists(
        m_balls.groups(), fewPlaced, placed,
        [&](std::size_t begin, std::size_t end, PlacedPairs& part) {
            m_balls.forEachPlace(begin, end, [&](std::uint32_t index, std::uint32_t place) {
                Entry& entry = m_entries[index];
                if (islands.isUnordered(entry.pair)) {
                    entry.isNear = isNear(input, entry.pair);
                    entry.isLate = false;
                }
                (entry.isLate   ? part.late
                 : entry.isNear ? part.near
                                : part.far)
                    .push_back({entry.pair, place});
            });
        },
        [&placed](const PlacedPairs& part) { placed.append(part); });
    islands.noteOrdered();
    std::vector<PlacedPair>& all = placed.near;
    for (std::vector<PlacedPair>* list : {&all, &placed.far})
        m_sort.sort(*list, input.bodies.count(), input.workers);
    all.insert(all.end(), placed.far.begin(), placed.far.end());
    const std::span<const SectionEnd> sections = islands.plan().sort(
        all, placed.far, [&](const PlacedPair& one) { return islands.numbersOf(one.pair); }, input.workers);
    all.insert(all.end(), placed.late.begin(), placed.late.end());
    m_order.resize(all.size());
    input.workers.forRanges(all.size(), fewOrdered, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) m_order[i] = all[i].place;
    });
    m_balls.reorder(m_order, immobile, sections, input.workers);
}

bool SteppedPairs::isNear(const SteppedInput& input, BodyPair pair) {
    const double a = input.bodies.boundingRadius[pair.a], b = input.bodies.boundingRadius[pair.b];
    if (!(a > 0 && b > 0)) // a wall has no radius
        return boundingGap(input.bodies, input.state, pair) <= nearPart * std::max(a, b);
    const double distance = (input.state.pose[pair.b].position - input.state.pose[pair.a].position).norm();
    return distance - (a + b) <= nearPart * std::min(a, b);
}

} // namespace carom
