// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/scenes.h"
#include "tests/support/test_class.h"

#include "core/broadphase/broadphase.h"
#include "core/math/random.h"
#include "core/solvers/contacts/neighbours.h"

#include <QTest>

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

// The list of pairs that can meet, against all pairs, while bodies wander and a few of them leap: whether few
// or many outrun it, no pair within what was asked for is missing, and the others of a body ascend.

namespace carom {
namespace {

constexpr std::uint64_t seed = 20261123;
constexpr double stepTime = 0.01; // [s]
constexpr double side = 12;       // of the box the bodies are in [m]
constexpr int steps = 60;

class Crowd {
  public:
    Crowd(Random& random, std::size_t count) {
        Scene scene;
        scene.bodies.push_back(test::wall(Vec3::UnitY(), -side / 2));
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3 place(anywhere(random), anywhere(random), anywhere(random));
            const Vec3 velocity = Vec3(random.gaussian(), random.gaussian(), random.gaussian());
            if (i % 3 == 0)
                scene.bodies.push_back(test::cuboid(Vec3(0.2, 0.1, 0.4), 1, place));
            else
                scene.bodies.push_back(test::sphere(random.uniform(0.1, 0.4), 1, place, velocity));
        }
        bodies = bodiesOf(scene);
        state = initialStateOf(scene);
    }
    /// All bodies go on; each leaps with probability `part`, and is another way from then on.
    void wander(Random& random, double part) {
        for (const BodyIndex i : bodies.mobileBodies) {
            if (random.uniform() < part) {
                state.velocity[i] = 30 * Vec3(random.gaussian(), random.gaussian(), random.gaussian());
                state.pose[i].position += stepTime * state.velocity[i];
            }
            state.pose[i].position += stepTime * state.velocity[i];
        }
    }
    static double anywhere(Random& random) { return random.uniform(-side / 2, side / 2); }

    Bodies bodies;
    State state;
};

std::vector<BodyIndex> namesOf(const Near& list) {
    std::vector<BodyIndex> names;
    for (const BodyIndex body : list) names.push_back(body);
    return names;
}

std::vector<BodyIndex> namesOf(std::span<const Neighbour> list) {
    std::vector<BodyIndex> names;
    for (const Neighbour& neighbour : list) names.push_back(neighbour.body);
    return names;
}

/// Whether the list has every pair that is within the reach of both, as one that may meet now.
bool isComplete(const Crowd& crowd, const Neighbours& neighbours) {
    const Bodies& bodies = crowd.bodies;
    for (BodyIndex a = 0; a < bodies.count(); ++a)
        for (BodyIndex b = a + 1; b < bodies.count(); ++b) {
            if (bodies.mobile[a] == 0 && bodies.mobile[b] == 0) continue;
            double margin = 0;
            for (const BodyIndex i : {a, b})
                if (bodies.mobile[i] != 0) margin += neighbours.reach(i);
            if (!areWithin(bodies, crowd.state, {a, b}, margin)) continue;
            for (const auto& [i, k] : {BodyPair{a, b}, BodyPair{b, a}}) {
                const std::vector<BodyIndex> around = namesOf(neighbours.around(i));
                if (bodies.mobile[i] != 0 && !std::binary_search(around.begin(), around.end(), k))
                    return false;
            }
        }
    return true;
}

bool isInOrder(const Crowd& crowd, const Neighbours& neighbours) {
    const auto ascends = [](auto list) {
        return std::adjacent_find(list.begin(), list.end(), std::greater_equal<>()) == list.end();
    };
    std::size_t ends = 0;
    for (BodyIndex i = 0; i < crowd.bodies.count(); ++i) {
        const std::vector<BodyIndex> listed = namesOf(neighbours.listed(i));
        if (!ascends(listed)) return false;
        for (const BodyIndex k : listed) {
            const std::vector<BodyIndex> back = namesOf(neighbours.listed(k));
            const bool isMobile = crowd.bodies.mobile[k] != 0;
            if (isMobile && !std::binary_search(back.begin(), back.end(), i)) return false;
        }
        ends += listed.size();
    }
    return ends == neighbours.ends();
}

} // namespace

class NeighboursTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void noPairIsMissing_data() {
        QTest::addColumn<int>("bodies");
        QTest::addColumn<double>("leaping"); // part of the bodies, in a step
        QTest::newRow("few leap") << 300 << 0.01;
        QTest::newRow("many leap") << 300 << 0.9;
        QTest::newRow("nobody leaps") << 300 << 0.0;
        QTest::newRow("three bodies") << 3 << 0.1;
    }
    void noPairIsMissing() {
        QFETCH(int, bodies);
        QFETCH(double, leaping);
        Random random(seed);
        Crowd crowd(random, static_cast<std::size_t>(bodies));
        const std::unique_ptr<Broadphase> broadphase = findBroadphase("all_pairs")->create();
        Neighbours neighbours(crowd.bodies);
        for (int i = 0; i < steps; ++i) {
            neighbours.update(crowd.bodies, crowd.state,
                              {crowd.bodies.mobileBodies, crowd.bodies.mobileBodies}, Vec3::Zero(),
                              {stepTime, 4 * stepTime}, *broadphase);
            bool covered = true;
            for (const BodyIndex k : crowd.bodies.mobileBodies)
                covered = neighbours.covers(k, neighbours.reach(k)) && covered;
            if (!covered) neighbours.search(crowd.bodies, crowd.state, *broadphase);
            QVERIFY(isComplete(crowd, neighbours));
            QVERIFY(isInOrder(crowd, neighbours));
            crowd.wander(random, leaping);
            neighbours.pass(stepTime);
        }
    }

    // The broad-phase is asked where everybody has moved, not for the few that leap.
    void theFewAreFoundWithoutASearchForAll() {
        Random random(seed);
        Crowd crowd(random, 300);
        std::fill(crowd.state.velocity.begin(), crowd.state.velocity.end(), Vec3::Zero());
        const std::unique_ptr<Broadphase> broadphase = findBroadphase("all_pairs")->create();
        Neighbours neighbours(crowd.bodies);
        for (int i = 0; i < steps; ++i) {
            neighbours.update(crowd.bodies, crowd.state,
                              {crowd.bodies.mobileBodies, crowd.bodies.mobileBodies}, Vec3::Zero(),
                              {stepTime, 4 * stepTime}, *broadphase);
            const BodyIndex one = crowd.bodies.mobileBodies[random.below(300)];
            crowd.state.pose[one].position =
                Vec3(Crowd::anywhere(random), Crowd::anywhere(random), Crowd::anywhere(random));
        }
        QCOMPARE(neighbours.searches(), 1U);
    }

    // Fast bodies that go on as they did leave no list, and are in no list of those they do not come near.
    void coursesAreFollowed() {
        Scene scene;
        for (const double z : {0.0, 1.0, 2.0})
            for (int k = 0; k < 40; ++k)
                scene.bodies.push_back(
                    test::sphere(0.1, 1, Vec3(2 * k, 0, z), Vec3(z == 1.0 ? 30.0 : 0.0, 0, 0)));
        const Bodies bodies = bodiesOf(scene);
        State state = initialStateOf(scene);
        const std::unique_ptr<Broadphase> broadphase = findBroadphase("all_pairs")->create();
        Neighbours neighbours(bodies);
        for (int i = 0; i < 5; ++i) {
            neighbours.update(bodies, state, {bodies.mobileBodies, bodies.mobileBodies}, Vec3::Zero(),
                              {stepTime, 4 * stepTime}, *broadphase);
            QCOMPARE(neighbours.searches(), 1U);
            QCOMPARE(neighbours.ends(), 0U);
            for (const BodyIndex k : bodies.mobileBodies)
                state.pose[k].position += stepTime * state.velocity[k];
            neighbours.pass(stepTime);
        }
    }

    // A body that stops is followed until it is said to stay: those that fall past its course may meet it.
    void whatStaysIsOnNoCourse() {
        const Vec3 falls(0, -5, 0);
        Scene scene;
        for (const double height : {5.0, 5.5})
            scene.bodies.push_back(test::sphere(0.1, 1, Vec3(0, height, 0), falls));
        const Bodies bodies = bodiesOf(scene);
        State state = initialStateOf(scene);
        const std::unique_ptr<Broadphase> broadphase = findBroadphase("all_pairs")->create();
        Neighbours neighbours(bodies);
        const auto update = [&](std::span<const BodyIndex> list) {
            neighbours.update(bodies, state, {list, list}, Vec3::Zero(), {stepTime, 4 * stepTime},
                              *broadphase);
        };
        update(bodies.mobileBodies);
        QVERIFY(namesOf(neighbours.listed(1)).empty()); // they fall alike
        state.velocity[0] = Vec3::Zero();
        neighbours.stay(std::vector<BodyIndex>{0});
        update(std::vector<BodyIndex>{1});
        const std::vector<BodyIndex> soon = namesOf(neighbours.listed(1));
        QCOMPARE(soon, std::vector<BodyIndex>{0});
    }

    // What fell on a heap was asked for far more room than it needs when it rests, awake or asleep.
    void listsAreShortAgainWhereLittleIsAskedFor() {
        constexpr double radius = 0.1, apart = 0.3, far = 3, little = 0.001; // [m]
        constexpr BodyIndex awake = 10, asleep = 15;
        Scene scene;
        for (int i = 0; i < 20; ++i) scene.bodies.push_back(test::sphere(radius, 1, Vec3(apart * i, 0, 0)));
        const Bodies bodies = bodiesOf(scene);
        const State state = initialStateOf(scene);
        const std::unique_ptr<Broadphase> broadphase = findBroadphase("all_pairs")->create();
        Neighbours neighbours(bodies);
        std::vector<BodyIndex> followed = bodies.mobileBodies;
        const auto update = [&] {
            neighbours.update(bodies, state, {followed, followed}, Vec3::Zero(), {stepTime, 4 * stepTime},
                              *broadphase);
            neighbours.pass(stepTime);
        };
        update();
        QVERIFY(!neighbours.covers(awake, far) && !neighbours.covers(asleep, far));
        neighbours.search(bodies, state, *broadphase);
        QVERIFY(neighbours.covers(awake, far) && neighbours.listed(awake).size() > 10);
        QVERIFY(neighbours.listed(asleep).size() > 8);
        neighbours.stay(std::vector<BodyIndex>{asleep});
        followed.erase(followed.begin() + asleep);
        for (int i = 0; i < 60; ++i) {
            update();
            QVERIFY(neighbours.covers(awake, little));
        }
        QVERIFY(neighbours.listed(awake).empty());
        QVERIFY(neighbours.listed(asleep).empty());
        QVERIFY(neighbours.covers(awake, little));
    }

    // A body that has flown on its course for long is at most as far from the next one as that is long.
    void whatHasFlownForLongAsksForNoMore() {
        constexpr double frame = 4 * stepTime, fall = 0.008; // [s], [m]
        Scene scene;
        for (int i = 0; i < 40; ++i) scene.bodies.push_back(test::sphere(0.1, 1, Vec3(0.5 * i, 0, 0)));
        const Bodies bodies = bodiesOf(scene);
        const State state = initialStateOf(scene);
        const std::unique_ptr<Broadphase> broadphase = findBroadphase("all_pairs")->create();
        Neighbours neighbours(bodies);
        for (int i = 0; i < 200; ++i) {
            neighbours.update(bodies, state, {bodies.mobileBodies, bodies.mobileBodies}, Vec3::Zero(),
                              {stepTime, frame}, *broadphase);
            neighbours.pass(stepTime);
        }
        const auto flightOf = [](BodyIndex) {
            return Neighbours::Flight{.room = 0.01, .time = frame, .fall = fall};
        };
        const std::array<BodyIndex, 1> twentieth{20};
        if (!neighbours.coversFlights(bodies, state, twentieth, flightOf))
            neighbours.search(bodies, state, *broadphase);
        QVERIFY(neighbours.coversFlights(bodies, state, twentieth, flightOf));
        QVERIFY(neighbours.listed(20).size() <= 2); // (1 + 4)² falls: .2 m
    }

    // After a jump to another time even those that are not followed are somewhere else.
    void whatIsForgottenIsSearchedFor() {
        Random random(seed);
        Crowd crowd(random, 100);
        const std::unique_ptr<Broadphase> broadphase = findBroadphase("all_pairs")->create();
        Neighbours neighbours(crowd.bodies);
        const auto update = [&](std::span<const BodyIndex> list) {
            neighbours.update(crowd.bodies, crowd.state, {list, list}, Vec3::Zero(), {stepTime, 4 * stepTime},
                              *broadphase);
        };
        update(crowd.bodies.mobileBodies);
        for (const BodyIndex i : crowd.bodies.mobileBodies)
            crowd.state.pose[i].position =
                Vec3(Crowd::anywhere(random), Crowd::anywhere(random), Crowd::anywhere(random));
        neighbours.forget();
        update(std::span(crowd.bodies.mobileBodies).first(1));
        QVERIFY(isInOrder(crowd, neighbours));
        const BodyIndex first = crowd.bodies.mobileBodies.front();
        const std::vector<BodyIndex> around = namesOf(neighbours.around(first));
        for (const BodyIndex k : crowd.bodies.bounded)
            if (k != first && areWithin(crowd.bodies, crowd.state, {std::min(k, first), std::max(k, first)},
                                        neighbours.reach(first)))
                QVERIFY(std::binary_search(around.begin(), around.end(), k));
        QCOMPARE(neighbours.searches(), 2U);
    }

    // What somebody asks for beyond what he needs is there after the next search.
    void whatIsAskedForIsFound() {
        Random random(seed);
        Crowd crowd(random, 300);
        const std::unique_ptr<Broadphase> broadphase = findBroadphase("all_pairs")->create();
        Neighbours neighbours(crowd.bodies);
        neighbours.update(crowd.bodies, crowd.state, {crowd.bodies.mobileBodies, crowd.bodies.mobileBodies},
                          Vec3::Zero(), {stepTime, 4 * stepTime}, *broadphase);
        const BodyIndex asking = crowd.bodies.mobileBodies[random.below(300)];
        QVERIFY(!neighbours.covers(asking, side / 2));
        neighbours.search(crowd.bodies, crowd.state, *broadphase);
        QVERIFY(neighbours.covers(asking, side / 2));
        const std::vector<BodyIndex> around = namesOf(neighbours.around(asking));
        for (const BodyIndex k : crowd.bodies.bounded)
            if (k != asking &&
                areWithin(crowd.bodies, crowd.state, {std::min(k, asking), std::max(k, asking)}, side / 2))
                QVERIFY(std::binary_search(around.begin(), around.end(), k));
    }

    // A body that has moved away within its skin may come back: who is found anew meanwhile must be listed
    // with it.
    void whoComesBackIsListed() {
        Scene scene;
        for (const double x : {0.0, 5.0}) scene.bodies.push_back(test::sphere(0.1, 1, Vec3(x, 0, 0)));
        for (int k = 0; k < 20; ++k) scene.bodies.push_back(test::sphere(0.1, 1, Vec3(k, 50, 0)));
        const Bodies bodies = bodiesOf(scene);
        State state = initialStateOf(scene);
        const std::unique_ptr<Broadphase> broadphase = findBroadphase("all_pairs")->create();
        Neighbours neighbours(bodies);
        const auto update = [&] {
            neighbours.update(bodies, state, {bodies.mobileBodies, bodies.mobileBodies}, Vec3::Zero(),
                              {stepTime, stepTime}, *broadphase);
        };
        update();
        QVERIFY(!neighbours.covers(0, 1.0));
        neighbours.search(bodies, state, *broadphase);
        state.pose[0].position.x() = 1.9; // within what it asked for and the search has added
        update();
        state.pose[1].position.x() = -0.5;
        update();
        state.pose[0].position.x() = -0.3;
        update();
        QVERIFY(std::ranges::count(namesOf(neighbours.around(0)), BodyIndex{1}) == 1);
        QCOMPARE(neighbours.searches(), 1U);
    }

    // Whom a body passes later is listed, but not near before; nor is whom it has passed.
    void whomABodyPassesLaterIsNotNearYet() {
        const Scene scene =
            test::sceneOf({test::sphere(0.1, 1, Vec3(0, 0, 0), Vec3(20, 0, 0)),
                           test::sphere(0.1, 1, Vec3(0.6, 0, 0)), test::sphere(0.1, 1, Vec3(0, 9, 0))});
        const Bodies bodies = bodiesOf(scene);
        State state = initialStateOf(scene);
        const std::unique_ptr<Broadphase> broadphase = findBroadphase("all_pairs")->create();
        Neighbours neighbours(bodies);
        std::string near;
        for (int i = 0; i < 12; ++i) {
            neighbours.update(bodies, state, {bodies.mobileBodies, bodies.mobileBodies}, Vec3::Zero(),
                              {stepTime / 4, 2 * stepTime}, *broadphase);
            QVERIFY(std::ranges::count(namesOf(neighbours.listed(0)), BodyIndex{1}) == 1);
            QCOMPARE(namesOf(neighbours.around(0)), namesOf(neighbours.around(1)).empty()
                                                        ? std::vector<BodyIndex>{}
                                                        : std::vector<BodyIndex>{1});
            near += namesOf(neighbours.around(0)).empty() ? '-' : '+';
            if (i == 0) QVERIFY(namesOf(neighbours.around(0, 4 * stepTime)) == std::vector<BodyIndex>{1});
            state.pose[0].position += stepTime / 2 * state.velocity[0] / 2;
            neighbours.pass(stepTime / 4);
        }
        qInfo("%s", near.c_str());
        QVERIFY(near.starts_with("--"));
        QVERIFY(near.find('+') != std::string::npos);
    }
};

} // namespace carom

CAROM_TEST(neighbours_test, carom::NeighboursTest)
#include "neighbours_test.moc"
