// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/island_scheduler.h"

#include "tests/support/constants.h"
#include "tests/support/random_scene.h"
#include "tests/support/test_class.h"

#include "core/broadphase/broadphase.h"
#include "core/dynamics/contact_memory.h"
#include "core/integrators/integrator.h"
#include "core/solvers/coasting.h"

#include <QTest>

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <utility>
#include <vector>

// Islands moved side by side, against one after the other, each by a motion of its own that has moved nothing
// before: the same bits and the same report, on one thread and on several.

namespace carom {
namespace {

constexpr double schedulerSubstep = 1.0 / 240; // [s]
constexpr double schedulerMargin = 0.05;       // points up to this separation are kept [m]
constexpr double groupsApart = 20;             // of the groups [m]: none reaches another
constexpr double fewOperations = 2000;         // ends an island of several bodies early
const Vec3 schedulerGravity(0, -9.81, 0);      // [m/s²]

/// Groups of bodies on a floor: heaps that move, cubes that rest, pairs that only a spring holds.
struct SchedulerCase {
    Scene scene;
    Bodies bodies;
    State state;
    std::vector<BodyPair> links;
    ContactSet found;
    Islands islands;
    std::vector<Refinement::Choice> chosen;
};

void addGroup(std::uint64_t kind, const Vec3& place, Random& random, Scene& scene) {
    const BodyIndex first = static_cast<BodyIndex>(scene.bodies.size());
    if (kind == 0) { // rests as it stands
        scene.bodies.push_back(test::cuboid(Vec3::Ones(), 1, place + Vec3(0, 0.5, 0)));
        return;
    }
    if (kind == 1) { // held by a spring, in the air
        for (const double side : {-1.0, 1.0})
            scene.bodies.push_back(test::sphere(0.2, random.uniform(0.5, 2), place + Vec3(side, 5, 0)));
        Spring spring = test::springBetween(first, first + 1, 50);
        spring.length = 1.5;
        scene.springs.push_back(spring);
        return;
    }
    for (std::uint64_t i = 0; i < kind; ++i) { // a heap
        Body body = test::randomBody(random, 0);
        body.fixed = false;
        body.friction = random.uniform();
        body.pose.position = place + Vec3(0.3 * random.uniform(), 0.4 + 0.5 * static_cast<double>(i), 0);
        scene.bodies.push_back(body);
    }
}

SchedulerCase drawSchedulerCase(Random& random) {
    SchedulerCase drawn;
    drawn.scene = test::sceneOf({test::wall(Vec3::UnitY(), 0)}, schedulerGravity);
    drawn.scene.bodies[0].friction = 0.5;
    const std::size_t groups = 4 + random.below(20);
    for (std::size_t k = 0; k < groups; ++k)
        addGroup(random.below(6), Vec3(groupsApart * static_cast<double>(k), 0, 0), random, drawn.scene);
    drawn.bodies = bodiesOf(drawn.scene);
    if (!drawn.scene.springs.empty()) contribute(*findEffect("spring"), drawn.scene, drawn.bodies);
    drawn.state = initialStateOf(drawn.scene);
    for (const Spring& spring : drawn.scene.springs) drawn.links.push_back({spring.from, spring.to});
    for (BodyIndex a = 0; a < drawn.bodies.count(); ++a)
        for (BodyIndex b = a + 1; b < drawn.bodies.count(); ++b)
            collideInto(drawn.bodies, drawn.state, pairOf(drawn.bodies, {a, b}, schedulerMargin), {},
                        drawn.found);
    drawn.islands.find(drawn.bodies, drawn.bodies.mobileBodies, drawn.found.pairs, drawn.links);
    for (std::uint32_t island = 0; island < drawn.islands.count(); ++island) {
        if (random.below(5) == 0) continue; // it is left to the base path
        const bool isShort = random.below(4) == 0;
        drawn.chosen.push_back({island, isShort ? fewOperations : std::numeric_limits<double>::infinity()});
    }
    return drawn;
}

/// Everything that is to come of a substep.
struct SchedulerOutcome {
    State state;
    ContactSet kept;
    std::vector<std::uint32_t> still, finished;
    std::vector<IslandScheduler::Unfinished> unfinished;
    std::vector<Refinement::Choice> spent;
    MotionReport report;
    Ledger ledger;
};

SolverInput schedulerInput(const SchedulerCase& drawn, Broadphase& broadphase, Workers& workers, State& state,
                           Ledger* ledger) {
    return {.bodies = drawn.bodies,
            .motion = findIntegrator("verlet")->motion,
            .gravity = schedulerGravity,
            .substep = schedulerSubstep,
            .broadphase = broadphase,
            .workers = workers,
            .state = state,
            .ledger = ledger};
}

SchedulerOutcome moveOneByOne(const SchedulerCase& drawn, const SolverSettings& settings) {
    SchedulerOutcome outcome;
    outcome.state = drawn.state;
    const std::unique_ptr<Broadphase> broadphase = broadphases()[0].create();
    Workers workers(1);
    const SolverInput input = schedulerInput(drawn, *broadphase, workers, outcome.state, nullptr);
    std::map<std::uint32_t, std::pair<ContactPair, std::vector<ContactConstraint>>> kept;
    for (const Refinement::Choice& choice : drawn.chosen) {
        const Island island = drawn.islands[choice.island];
        Ledger ledger;
        if (island.pairs.empty()) { // the integrator moves it
            SpringNetwork::Scratch room;
            SpringNetwork network{drawn.bodies, island.bodies, island.links, schedulerGravity, room};
            moveNetwork(input, network, &ledger);
            outcome.finished.push_back(choice.island);
            outcome.spent.push_back({choice.island, 0});
            outcome.ledger.add(ledger);
            continue;
        }
        IslandMotion motion;
        const bool isStill = motion.advance({.bodies = drawn.bodies,
                                             .settings = settings,
                                             .gravity = schedulerGravity,
                                             .substep = schedulerSubstep,
                                             .state = outcome.state,
                                             .ledger = &ledger,
                                             .budget = choice.budget},
                                            island, drawn.found);
        outcome.spent.push_back({choice.island, motion.work()});
        outcome.ledger.add(ledger);
        if (isStill) outcome.still.push_back(choice.island);
        outcome.report.residual = std::max(outcome.report.residual, motion.report.residual);
        outcome.report.maxPenetration = std::max(outcome.report.maxPenetration, motion.report.maxPenetration);
        outcome.report.work.add(motion.report.work);
        if (!outcome.report.loss) outcome.report.loss = motion.report.loss;
        if (motion.left() > 0) {
            if (!motion.report.loss) outcome.unfinished.push_back({choice.island, motion.left()});
            continue;
        }
        outcome.finished.push_back(choice.island);
        const ContactSet& contacts = motion.contacts();
        for (std::size_t i = 0; i < contacts.pairs.size(); ++i) {
            const std::span<const ContactConstraint> points = contacts.pointsOf(contacts.pairs[i]);
            if (!points.empty()) kept[island.pairs[i]] = {contacts.pairs[i], {points.begin(), points.end()}};
        }
    }
    for (const auto& [place, entry] : kept) outcome.kept.append(entry.first, entry.second);
    return outcome;
}

SchedulerOutcome moveSideBySide(const SchedulerCase& drawn, const SolverSettings& settings, Workers& workers,
                                IslandScheduler& scheduler) {
    SchedulerOutcome outcome;
    outcome.state = drawn.state;
    const std::unique_ptr<Broadphase> broadphase = broadphases()[0].create();
    scheduler.move(schedulerInput(drawn, *broadphase, workers, outcome.state, &outcome.ledger), settings,
                   drawn.islands, drawn.chosen, drawn.found, outcome.kept);
    outcome.still.assign(scheduler.still().begin(), scheduler.still().end());
    outcome.finished.assign(scheduler.finished().begin(), scheduler.finished().end());
    outcome.unfinished.assign(scheduler.unfinished().begin(), scheduler.unfinished().end());
    outcome.spent.assign(scheduler.spent().begin(), scheduler.spent().end());
    outcome.report = scheduler.report();
    return outcome;
}

bool areSchedulerEqual(const State& x, const State& y) {
    bool same = x.velocity == y.velocity && x.angularVelocity == y.angularVelocity;
    for (std::size_t i = 0; i < x.pose.size(); ++i)
        same = same && x.pose[i].position == y.pose[i].position &&
               x.pose[i].orientation.coeffs() == y.pose[i].orientation.coeffs();
    return same;
}

bool areSchedulerEqual(const ContactSet& x, const ContactSet& y) {
    return std::ranges::equal(x.pairs, y.pairs, [&](const ContactPair& p, const ContactPair& q) {
        return p.a == q.a && p.b == q.b && p.friction == q.friction && p.restitution == q.restitution &&
               std::ranges::equal(x.pointsOf(p), y.pointsOf(q),
                                  [](const ContactConstraint& s, const ContactConstraint& t) {
                                      return s.frame == t.frame && s.armA == t.armA && s.armB == t.armB &&
                                             s.separation == t.separation && s.force == t.force;
                                  });
    });
}

bool areSchedulerEqual(const Ledger& x, const Ledger& y) {
    return x.lifted == y.lifted &&
           std::ranges::equal(x.entries, y.entries, [](const LedgerEntry& p, const LedgerEntry& q) {
               return p.energy == q.energy && p.momentum == q.momentum;
           });
}

} // namespace

class IslandSchedulerTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void theBitsAreThoseOfIslandsMovedOneByOne_data() {
        QTest::addColumn<int>("threads");
        QTest::newRow("one thread") << 1;
        QTest::newRow("several threads") << 4;
    }
    void theBitsAreThoseOfIslandsMovedOneByOne() {
        QFETCH(int, threads);
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 61);
        Workers workers(threads);
        IslandScheduler scheduler; // the same for all: nothing may be left of the substep before
        const SolverSettings settings;
        std::size_t still = 0, unfinished = 0, finished = 0, points = 0;
        for (int trial = 0; trial < 60; ++trial) {
            const SchedulerCase drawn = drawSchedulerCase(random);
            const SchedulerOutcome expected = moveOneByOne(drawn, settings);
            const SchedulerOutcome moved = moveSideBySide(drawn, settings, workers, scheduler);
            QVERIFY2(areSchedulerEqual(moved.state, expected.state), qPrintable(QString::number(trial)));
            QVERIFY2(areSchedulerEqual(moved.kept, expected.kept), qPrintable(QString::number(trial)));
            QVERIFY2(areSchedulerEqual(moved.ledger, expected.ledger), qPrintable(QString::number(trial)));
            QCOMPARE(moved.still, expected.still);
            QCOMPARE(moved.finished, expected.finished);
            QVERIFY(std::ranges::equal(
                moved.unfinished, expected.unfinished,
                [](const IslandScheduler::Unfinished& x, const IslandScheduler::Unfinished& y) {
                    return x.island == y.island && x.left == y.left;
                }));
            QVERIFY(std::ranges::equal(moved.spent, expected.spent,
                                       [](const Refinement::Choice& x, const Refinement::Choice& y) {
                                           return x.island == y.island && x.budget == y.budget;
                                       }));
            QCOMPARE(moved.report.residual, expected.report.residual);
            QCOMPARE(moved.report.maxPenetration, expected.report.maxPenetration);
            QCOMPARE(moved.report.work.operations, expected.report.work.operations);
            QCOMPARE(moved.report.work.pairsCollided, expected.report.work.pairsCollided);
            QVERIFY(!moved.report.loss);
            still += moved.still.size();
            unfinished += moved.unfinished.size();
            finished += moved.finished.size();
            points += moved.kept.points.size();
        }
        // Each of the ways out was taken.
        QVERIFY(still > 20 && unfinished > 20 && finished > 100 && points > 500);
    }

    void whoWasNotChosenStays() {
        Random random(test::seed, 67);
        SchedulerCase drawn = drawSchedulerCase(random);
        drawn.chosen.clear();
        Workers workers(2);
        IslandScheduler scheduler;
        const SchedulerOutcome moved = moveSideBySide(drawn, SolverSettings{}, workers, scheduler);
        QVERIFY(areSchedulerEqual(moved.state, drawn.state));
        QVERIFY(moved.kept.pairs.empty() && moved.spent.empty() && moved.finished.empty());
    }
};

} // namespace carom

CAROM_TEST(island_scheduler_test, carom::IslandSchedulerTest)
#include "island_scheduler_test.moc"
