// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/refinement.h"

#include "core/solvers/contacts/calm.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace carom {
namespace {

/// Operations that an island takes that is solved already: for each body, and each pair in contact. At twice,
/// half as many islands find room in the budget; at half, frames take up to twice their income.
constexpr double perBody = 300, perPair = 1500;
/// Finding the forces of an island takes so many times that where none are known; towers of 50 to 320 bricks
/// took 30 to 70. At half, more attempts fail when a run begins; at twice, towers of half as many bricks are
/// left to the base path, on which they sink in.
constexpr double firstTime = 60;
/// An island that is nearly at rest may use so many times that of what is saved: one that takes more is not
/// at rest yet. At half, the hard cases hold as well; at twice, a heap of 400 cuboids has frames with a fifth
/// more work.
constexpr double timesForRest = 2;
/// Islands with springs may take so many times more: the base path takes energy out of springs, refinement
/// does not. At half, smaller networks in contact lose energy; at twice, a frame with springs may cost twice
/// as much.
constexpr double forSprings = 20;
/// An island waits 2ᶠ − 1 substeps after f failed attempts in a row, f at most this: 63 substeps. With one
/// more it waits up to 127, and what has come to rest is refined later; with one less, failed attempts cost
/// twice as much.
constexpr std::uint8_t mostFailures = 6;
/// What is saved when a run begins is for bodies that the scene puts down then: this part of it is left after
/// a frame, 1/e after two or three. At half, scenes of large piles may use little of it; where nearly all of
/// it is left, a later collapse may draw on it.
constexpr double startFades = 0.66;
/// An island is nearly at rest that is no faster than so many times the speed that gravity gives in a frame,
/// and of which nothing comes further in one than its own size. At half, heaps are refined later; at twice,
/// what is saved is spent on islands that still move.
constexpr double nearlyResting = 2.5;
/// Part of what is saved for islands of any kind that one frame may take. At a third, accurate runs of 6 in
/// 100 scenes drawn at random had a frame of more than a second; at a sixth, a card house that stands has
/// moved by 3.5 mm.
constexpr double mostOfReserve = 1.0 / 4;
/// What one attempt counts among all that is learned of islands that move, and what a frame forgets of it. At
/// half of the first, more attempts fail when bodies begin to collide; at twice, a single island decides for
/// many. At half of the second, fewer islands are tried after that has ended; at twice, more fail.
constexpr double learning = 1.0 / 8, forgetting = 1.0 / 16;

} // namespace

RefinementBudget budgetOf(double effort, double reserve) {
    RefinementBudget budget;
    for (double* each : {&budget.floor, &budget.perItem}) *each *= effort;
    for (double* each : {&budget.start, &budget.saved, &budget.forRest, &budget.burst})
        *each *= std::min(1.0, effort);
    budget.saved *= reserve;
    budget.start = std::max(budget.start, budget.saved);
    budget.burst += mostOfReserve * std::max(0.0, budget.saved - budget.forRest);
    return budget;
}

bool Refinement::nearlyRests(const RefinementInput& input, const Island& island) const {
    const double frame = input.substep * input.parts;
    const double byGravity = nearlyResting * frame * input.gravity.norm();
    return std::all_of(island.bodies.begin(), island.bodies.end(), [&](BodyIndex i) {
        const double radius = input.bodies.boundingRadius[i];
        const double most = std::min(byGravity, radius / frame);
        return input.state.velocity[i].squaredNorm() <= most * most &&
               radius * radius * input.state.angularVelocity[i].squaredNorm() <= most * most;
    });
}

bool Refinement::isSlow(const RefinementInput& input, const Island& island) const {
    return std::all_of(island.bodies.begin(), island.bodies.end(), [&](BodyIndex i) {
        return isSlowerThan(calmSpeed, input.bodies, input.state, i, input.gravity);
    });
}

double Refinement::movingWork(const RefinementInput& input, const Island& island, double expected) const {
    if (!island.links.empty() || nearlyRests(input, island)) return 0;
    return expected * static_cast<double>(island.pairs.size());
}

double Refinement::wholeWork(const Island& island, double expected) const {
    const bool isSolved = std::all_of(island.bodies.begin(), island.bodies.end(),
                                      [&](BodyIndex body) { return m_solved[body] != 0; });
    return isSolved ? expected : firstTime * expected;
}

double Refinement::openTo(const RefinementInput& input, const RefinementBudget& budget, const Island& island,
                          double expected) const {
    const double forAll = std::min(m_saved, budget.saved) - budget.forRest;
    const double open = nearlyRests(input, island) ? m_saved : forAll;
    std::uint8_t failures = 0;
    for (const BodyIndex body : island.bodies) failures = std::max(failures, m_failures[body]);
    const double most =
        forAll > 0 ? budget.burst : std::min(budget.burst, timesForRest * firstTime * expected);
    const double burst = most + m_fromStart;
    return std::ldexp(std::max(0.0, std::min(open, burst - m_spent)), -failures);
}

void Refinement::pay(double refined, double base) {
    const double left = std::max(0.0, m_saved - refined - base);
    m_saved = left < m_most ? std::min(m_most, left + m_income) : m_most + m_fades * (left - m_most);
}

void Refinement::choose(const RefinementInput& input, const RefinementBudget& budget) {
    m_refined.clear();
    m_base.clear();
    m_lone.clear();
    const double items = findExpected(input);
    m_income = (budget.floor + budget.perItem * items) / input.parts;
    m_most = budget.saved;
    m_fades = std::pow(startFades, 1.0 / input.parts);
    if (m_saved < 0) m_saved = budget.start;
    if (input.part == 0) {
        std::fill(m_used.begin(), m_used.end(), 0.0);
        m_spent = 0;
        m_fromStart = std::max(0.0, m_saved - budget.saved);
    }
    shareOut(input, budget);
    m_learned *= 1 - forgetting / input.parts;
    std::sort(m_refined.begin(), m_refined.end(),
              [](const Choice& one, const Choice& other) { return one.island < other.island; });
    std::sort(m_base.begin(), m_base.end());
    for (const BodyIndex body : input.members)
        if (std::exchange(m_isLone[body], std::uint8_t{0}) != 0) m_lone.push_back(body);
    for (const std::uint32_t island : m_base)
        for (const BodyIndex body : input.islands[island].bodies) {
            m_stepped[body] = 1;
            m_solved[body] = 0;
        }
}

// Finds the islands that may be refined, those first that are expected to cost least, and what becomes of the
// others. Returns how many bodies and pairs the budget grows with.
double Refinement::findExpected(const RefinementInput& input) {
    const Islands& islands = input.islands;
    m_expected.clear();
    m_isTriedSoon.assign(islands.count(), 0);
    m_backOff.assign(islands.count(), (1 << mostFailures) - 1);
    double items = 0;
    for (std::uint32_t i = 0; i < islands.count(); ++i) {
        const Island island = islands[i];
        for (const BodyIndex body : island.bodies) m_stepped[body] = 0;
        if (input.joins[i] != 0) {
            m_base.push_back(i);
            continue;
        }
        if (input.closed[i] != 0) continue;
        const bool meets = std::any_of(island.pairs.begin(), island.pairs.end(),
                                       [&](std::uint32_t pair) { return input.canMeet[pair] != 0; });
        if (!meets && island.links.empty()) {
            for (const BodyIndex body : island.bodies) m_isLone[body] = 1;
            continue;
        }
        if (island.pairs.empty()) { // springs alone
            m_moving[island.bodies.front()] = 0;
            m_refined.push_back({i, std::numeric_limits<double>::infinity()});
            continue;
        }
        items += static_cast<double>(island.bodies.size() + island.pairs.size());
        std::uint8_t wait = 0;
        for (const BodyIndex body : island.bodies) wait = std::max(wait, m_wait[body]);
        if (wait > 0) {
            m_isTriedSoon[i] = wait < input.parts - input.part ? 1 : 0;
            m_backOff[i] = wait;
            m_base.push_back(i);
            continue;
        }
        m_expected.push_back({perBody * static_cast<double>(island.bodies.size()) +
                                  perPair * static_cast<double>(island.pairs.size() + island.links.size()),
                              i});
    }
    std::sort(m_expected.begin(), m_expected.end(), [](const Expected& one, const Expected& other) {
        return one.work != other.work ? one.work < other.work : one.island < other.island;
    });
    return items;
}

// Gives these islands their shares of the substep's income and of what is saved, as long as the income lasts.
void Refinement::shareOut(const RefinementInput& input, const RefinementBudget& budget) {
    double left = m_income, squares = 0;
    for (Expected& expected : m_expected) {
        expected.open = openTo(input, budget, input.islands[expected.island], expected.work);
        if (expected.open > 0) squares += expected.work * expected.work;
    }
    const double part = std::min(1.0, (mostShares - mostFloors) /
                                          std::max<double>(1, static_cast<double>(m_expected.size())));
    for (const Expected& expected : m_expected) {
        const Island island = input.islands[expected.island];
        double used = 0;
        for (const BodyIndex body : island.bodies) used = std::max(used, m_used[body]);
        const double times = island.links.empty() ? 1 : forSprings;
        const double floor = times * budget.floor;
        const double share = part * std::min(floor, std::max(0.0, mostFloors * floor - m_spent));
        const double drawn = expected.open > 0 ? expected.open * expected.work * expected.work / squares : 0;
        const bool fits = expected.work <= left;
        const double most =
            fits ? drawn + std::max(share - used, times * mostOverrun * expected.work) : drawn;
        const double moving = movingWork(input, island, expected.work);
        const bool willEnd = part == 1 || m_learned * moving <= most;
        const bool isPaid = fits || (wholeWork(island, expected.work) <= drawn && isSlow(input, island));
        if (!willEnd || !isPaid) {
            m_base.push_back(expected.island);
            continue;
        }
        if (fits) left -= expected.work;
        m_moving[island.bodies.front()] = moving;
        m_refined.push_back({expected.island, most});
    }
}

void Refinement::spend(const Island& island, double operations) {
    m_spent += operations;
    const double moving = m_moving[island.bodies.front()];
    if (moving > 0) m_learned += learning * (operations / moving - m_learned);
    double used = operations;
    for (const BodyIndex body : island.bodies) used = std::max(used, m_used[body] + operations);
    for (const BodyIndex body : island.bodies) m_used[body] = used;
}

void Refinement::setBack(const Island& island) {
    std::uint8_t failures = 0;
    for (const BodyIndex body : island.bodies) failures = std::max(failures, m_failures[body]);
    failures = std::min<std::uint8_t>(static_cast<std::uint8_t>(failures + 1), mostFailures);
    for (const BodyIndex body : island.bodies) {
        m_failures[body] = failures;
        m_wait[body] = static_cast<std::uint8_t>((1 << failures) - 1);
        m_stepped[body] = 1;
        m_solved[body] = 0;
    }
}

} // namespace carom
