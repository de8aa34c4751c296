// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/island_scheduler.h"

#include "core/base/reserve.h"
#include "core/solvers/coasting.h"

#include <algorithm>

namespace carom {
namespace {

/// Pairs in contact and bodies of islands that are given to a worker together, at some us each.
constexpr std::size_t batchWeight = Workers::enoughOf(1000);

/// Springs alone hold this island together: the integrator moves it.
bool isNetwork(const SolverInput& input, const Island& island) {
    return island.pairs.empty() && input.motion.moveOnSprings != nullptr;
}

} // namespace

struct IslandScheduler::Task {
    const SolverInput& input;
    const SolverSettings& settings;
    const Islands& islands;
    const ContactSet& found;
};

void IslandScheduler::move(const SolverInput& input, const SolverSettings& settings, const Islands& islands,
                           std::span<const Refinement::Choice> chosen, const ContactSet& found,
                           ContactSet& kept) {
    share(islands, chosen);
    m_workers.resize(static_cast<std::size_t>(input.workers.threads()));
    const std::size_t points =
        std::max(found.points.size(), found.pairs.size()); // those of balls may come later
    kept.reserve(found.pairs.size(), points);
    for (Worker& worker : m_workers) {
        worker.kept.reserve(found.pairs.size(), points);
        reserveFor(found.pairs.size(), worker.places);
        worker.motion.report = {};
        worker.kept.clear();
        worker.places.clear();
    }
    const Task task{input, settings, islands, found};
    input.workers.forEach(m_batch.size() - 1, [&](std::size_t thread, std::size_t batch) {
        for (std::uint32_t work = m_batch[batch]; work < m_batch[batch + 1]; ++work)
            moveOne(task, work, m_workers[thread]);
    });
    collect(input, found.pairs.size(), kept);
}

// Small islands go together.
void IslandScheduler::share(const Islands& islands, std::span<const Refinement::Choice> chosen) {
    m_work.clear();
    m_batch.assign(1, 0);
    std::size_t weight = 0;
    for (const Refinement::Choice& choice : chosen) {
        const Island island = islands[choice.island];
        m_work.push_back(choice);
        weight += island.pairs.size() + island.bodies.size();
        if (weight < batchWeight) continue;
        m_batch.push_back(static_cast<std::uint32_t>(m_work.size()));
        weight = 0;
    }
    if (m_batch.back() < m_work.size()) m_batch.push_back(static_cast<std::uint32_t>(m_work.size()));
    m_outcomes.resize(m_work.size());
}

void IslandScheduler::moveOne(const Task& task, std::uint32_t work, Worker& worker) {
    const SolverInput& input = task.input;
    const Island island = task.islands[m_work[work].island];
    Outcome& outcome = m_outcomes[work];
    outcome = {};
    Ledger* ledger = input.ledger != nullptr ? &outcome.ledger : nullptr;
    if (isNetwork(input, island)) {
        SpringNetwork network{input.bodies, island.bodies, island.links, input.gravity, worker.room};
        moveNetwork(input, network, ledger);
        return;
    }
    const MotionInput motion{.bodies = input.bodies,
                             .settings = task.settings,
                             .gravity = input.gravity,
                             .substep = input.substep,
                             .state = input.state,
                             .ledger = ledger,
                             .budget = m_work[work].budget};
    outcome.isStill = worker.motion.advance(motion, island, task.found);
    outcome.spent = worker.motion.work();
    outcome.loss = worker.motion.report.loss;
    worker.motion.report.loss = {};
    outcome.left = worker.motion.left();
    if (outcome.left > 0) return; // its contacts are found again
    const ContactSet& left = worker.motion.contacts();
    for (std::size_t i = 0; i < left.pairs.size(); ++i) {
        const ContactPair& pair = left.pairs[i];
        if (pair.count == 0) continue;
        worker.kept.append(pair, left.pointsOf(pair));
        worker.places.push_back(island.pairs[i]);
    }
}

void IslandScheduler::collect(const SolverInput& input, std::size_t pairs, ContactSet& kept) {
    m_report = {};
    kept.clear();
    kept.pairs.resize(pairs);
    for (Worker& worker : m_workers) {
        const MotionReport& part = worker.motion.report;
        m_report.residual = std::max(m_report.residual, part.residual);
        m_report.maxPenetration = std::max(m_report.maxPenetration, part.maxPenetration);
        m_report.work.add(part.work);
        const std::uint32_t before = static_cast<std::uint32_t>(kept.points.size());
        for (std::size_t i = 0; i < worker.places.size(); ++i) {
            ContactPair& pair = kept.pairs[worker.places[i]];
            pair = worker.kept.pairs[i];
            pair.first += before;
        }
        if (before == 0)
            std::swap(kept.points, worker.kept.points);
        else
            kept.points.insert(kept.points.end(), worker.kept.points.begin(), worker.kept.points.end());
    }
    std::erase_if(kept.pairs, [](const ContactPair& pair) { return pair.count == 0; });
    m_still.clear();
    m_unfinished.clear();
    m_finished.clear();
    m_spent.clear();
    for (std::size_t work = 0; work < m_work.size(); ++work) {
        const Outcome& outcome = m_outcomes[work];
        m_spent.push_back({m_work[work].island, outcome.spent});
        if (outcome.isStill) m_still.push_back(m_work[work].island);
        if (outcome.left == 0) m_finished.push_back(m_work[work].island);
        if (outcome.left > 0 && !outcome.loss) m_unfinished.push_back({m_work[work].island, outcome.left});
        if (!m_report.loss) m_report.loss = outcome.loss;
        if (input.ledger != nullptr) input.ledger->add(outcome.ledger);
    }
}

} // namespace carom
