// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/core/solvers/contacts/ball_scene.h"
#include "tests/support/constants.h"
#include "tests/support/test_class.h"

#include <QTest>

// Contacts of balls, four at a time, against one pair after another, rows of any shape, and closed forms.

namespace carom {

class BallRowsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void everyPassIsThatOfOnePairAtATime() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed);
        int impacts = 0, woken = 0, idle = 0, doubtful = 0;
        double worst = 0;
        for (int trial = 0; trial < 200; ++trial) {
            BallScene scene = randomBalls(random, 2 + random.below(60));
            BallRows rows;
            scene.fill(rows);
            ObviousBalls balls(scene);
            QCOMPARE(rows.groups(), balls.groups());
            for (int frame = 0; frame < 3; ++frame) { // the next ones begin with impulses, elsewhere
                const StepSettings settings = randomSettings(random, scene.duration);
                scene.refresh(rows);
                balls.refresh();
                doubtful += balls.isDoubtful() ? 1 : 0;
                if (balls.isDoubtful()) break;
                QCOMPARE(rows.activeGroups(), balls.activeGroups());
                idle += static_cast<int>(rows.groups() - rows.activeGroups());
                QVERIFY(largestDifference(rows, balls.points()) < foreseenRounding);
                ObviousContacts expected = balls.active(scene.bodies);
                const auto agrees = [&] {
                    balls.store(expected);
                    worst = std::max({worst, test::largestDifference(scene.bodies, expected.bodies),
                                      largestDifference(rows, balls.points())});
                    return worst < rounding;
                };
                QCOMPARE(rows.recordApproach(scene.bodies, settings), expected.recordApproach(settings));
                rows.warmStart(scene.bodies);
                expected.warmStart();
                QVERIFY(agrees());
                std::vector<Displacement> moved = scene.still();
                for (int pass = 0; pass < 4; ++pass) {
                    const bool back = pass % 2 != 0;
                    rows.solve(scene.bodies, moved, settings, back);
                    expected.pass(ObviousContacts::Pass::Feedback, moved, settings, back);
                    QVERIFY(agrees());
                    if (pass == 1)
                        for (std::size_t i = 0; i + 1 < moved.size(); ++i)
                            add(moved[i].shift, test::uniformIn(random, 0.01));
                }
                const bool areStruck = balls.findStruck(scene.bodies, moved);
                woken += areStruck ? 1 : 0;
                if (balls.isDoubtful()) break;
                QCOMPARE(rows.findStruck(scene.bodies, scene.places, moved, scene.duration, scene.gravity),
                         areStruck);
                QCOMPARE(rows.activeGroups(), balls.activeGroups());
                if (areStruck) {
                    std::vector<SolverBody> bodies = expected.bodies;
                    expected = balls.active(bodies);
                    QVERIFY(agrees());
                }
                for (int pass = 0; pass < 3; ++pass) {
                    const bool back = pass % 2 != 0;
                    const double residual = rows.relax(scene.bodies, moved, settings, back);
                    const double other = expected.pass(ObviousContacts::Pass::Relax, moved, settings, back);
                    QVERIFY(std::abs(residual - other) < rounding);
                    QVERIFY(agrees());
                }
                std::vector<std::uint8_t> everybody(scene.bodies.size(), 1);
                const int struck = rows.activate({everybody, scene.immobile()});
                QCOMPARE(struck, expected.struckRows());
                impacts += struck;
                for (BodyPlace& place : scene.places)
                    if (&place != &scene.places.back()) add(place.position, test::uniformIn(random, 0.02));
            }
        }
        qInfo("largest difference %.2g, impacts %d, woken %d, idle groups %d, left out %d of 600", worst,
              impacts, woken, idle, doubtful);
        QVERIFY(impacts > 200 && woken > 50 && idle > 500 && doubtful < 60);
    }

    // Two crowds that do not meet, with their pairs one after the other's, move as each does alone.
    void whoSharesAGroupChangesNoBit() {
        Random random(test::seed, 5);
        int impacts = 0, woken = 0;
        for (int trial = 0; trial < 400; ++trial) {
            BallScene alone = randomBalls(random, 2 + random.below(20)), other = randomBalls(random, 30);
            const std::uint32_t mobile = alone.immobile();
            BallScene both = other;
            both.duration = alone.duration;
            both.bodies.insert(both.bodies.begin(), alone.bodies.begin(), alone.bodies.end() - 1);
            both.places.insert(both.places.begin(), alone.places.begin(), alone.places.end() - 1);
            both.pairs.clear();
            for (std::size_t i = 0; i < std::max(alone.pairs.size(), other.pairs.size()); ++i) {
                if (i < alone.pairs.size()) {
                    BallPair& pair = both.pairs.emplace_back(alone.pairs[i]);
                    if (pair.a == mobile) pair.a = both.immobile();
                }
                if (i < other.pairs.size()) {
                    BallPair& pair = both.pairs.emplace_back(other.pairs[i]);
                    pair.a += mobile;
                    pair.b += mobile;
                }
            }
            BallRows few, many;
            alone.fill(few);
            both.fill(many);
            const StepSettings settings = randomSettings(random, alone.duration);
            for (int frame = 0; frame < 4; ++frame) {
                alone.refresh(few);
                both.refresh(many);
                impacts += step(few, alone, settings, 4);
                step(many, both, settings, 4);
                const std::vector<Displacement> still = alone.still(), all = both.still();
                woken += few.findStruck(alone.bodies, alone.places, still, alone.duration, alone.gravity);
                many.findStruck(both.bodies, both.places, all, both.duration, both.gravity);
                few.relax(alone.bodies, still, settings, true);
                many.relax(both.bodies, all, settings, true);
                for (std::uint32_t i = 0; i < mobile; ++i) QVERIFY(sameBits(alone.bodies[i], both.bodies[i]));
            }
        }
        qInfo("impacts %d, woken %d", impacts, woken);
        QVERIFY(impacts > 200 && woken >= 5);
    }

    void theRowsOfAnyShapeMoveBallsTheSame() {
        Random random(test::seed, 1);
        int impacts = 0;
        for (int trial = 0; trial < 400; ++trial) {
            BallScene scene = randomBalls(random, 2 + random.below(60));
            std::erase_if(scene.pairs, [&](const BallPair& pair) { // those that meet: nothing is idle
                return scene.gapOf(pair) > slackPart * std::min(pair.radiusB, pair.wall ? 1 : pair.radiusA);
            });
            BallRows rows;
            scene.fill(rows);
            scene.refresh(rows);
            QCOMPARE(rows.activeGroups(), rows.groups());
            const Seen seen = seenIn(rows, scene.pairs.size());
            ContactRows general;
            general.begin(scene.bodies.size(), scene.immobile());
            for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
                const BallPair& pair = scene.pairs[i];
                const Vec3& n = seen.normals[i];
                const PointInput point{.armA = pair.radiusA * n,
                                       .armB = -pair.radiusB * n,
                                       .separation = n.dot(scene.between(pair)) - pair.radiusA - pair.radiusB,
                                       .impulse = seen.impulses[i]};
                general.add({.a = pair.a,
                             .b = pair.b,
                             .normal = n,
                             .friction = pair.friction,
                             .restitution = pair.restitution,
                             .push = pair.push,
                             .points = std::span(&point, 1)},
                            static_cast<std::uint32_t>(i), scene.bodies);
            }
            general.end(scene.bodies);
            QCOMPARE(general.groups().size(), rows.groups());
            std::vector<SolverBody> bodies = scene.bodies;
            const StepSettings settings = randomSettings(random, scene.duration);
            const auto agrees = [&] {
                double largest = test::largestDifference(scene.bodies, bodies);
                const Seen now = seenIn(rows, scene.pairs.size());
                for (const RowGroup& group : general.groups())
                    for (std::size_t lane = 0; lane < wideLanes; ++lane)
                        if (group.source[lane] != ContactRows::noPair)
                            largest = std::max(largest, (now.impulses[group.source[lane]] -
                                                         general.impulseOf(group, static_cast<int>(lane), 0))
                                                            .norm());
                return largest < 1e2 * rounding;
            };
            QVERIFY(agrees());
            QCOMPARE(rows.recordApproach(scene.bodies, settings), recordApproach(general, bodies, settings));
            rows.warmStart(scene.bodies);
            warmStart(general, bodies);
            QVERIFY(agrees());
            std::vector<Displacement> moved = scene.still();
            for (int pass = 0; pass < 4; ++pass) {
                rows.solve(scene.bodies, moved, settings, pass % 2 != 0);
                solveVelocities(general, bodies, settings, pass % 2 != 0);
                QVERIFY(agrees());
                for (std::size_t i = 0; i + 1 < moved.size(); ++i) // turning changes no gap of a ball
                    for (auto* to : {&moved[i].shift, &moved[i].turn})
                        add(*to, test::uniformIn(random, 0.002));
                updateGaps(general, moved);
            }
            for (int pass = 0; pass < 3; ++pass) {
                rows.relax(scene.bodies, moved, settings, pass % 2 != 0);
                relaxVelocities(general, bodies, settings, pass % 2 != 0);
                QVERIFY(agrees());
            }
            std::vector<std::uint8_t> ofBalls(scene.bodies.size(), 1), ofGeneral = ofBalls;
            const int struck = rows.activate({ofBalls, scene.immobile()});
            QCOMPARE(struck, activate(general, {ofGeneral, scene.immobile()}));
            impacts += struck;
        }
        qInfo("impacts %d", impacts);
        QVERIFY(impacts > 50);
    }

    // A row of equal balls that touch, the first of which comes: one impact after another hands its speed
    // on to the last. Two balls part at e times the speed they met at.
    void aRowOfBallsPassesAnImpactOn() {
        constexpr double speed = 2, radius = 0.1;
        struct Trial {
            int count;
            double elastic;
        };
        for (const auto [count, elastic] : {Trial{2, 1}, {3, 1}, {6, 1}, {20, 1}, {2, 0.9}, {2, 0.5}}) {
            BallScene scene;
            scene.gravity.setZero();
            scene.bodies.resize(1); // what cannot move
            scene.places.resize(1);
            for (int k = 0; k < count; ++k)
                scene.addBall(radius, 1, {2 * radius * k, 0, 0}, {k == 0 ? speed : 0, 0, 0});
            for (std::uint32_t k = 1; k < static_cast<std::uint32_t>(count); ++k)
                scene.addPair(k - 1, k).restitution = elastic;
            BallRows rows;
            scene.fill(rows);
            scene.refresh(rows);
            const StepSettings settings{.duration = scene.duration, .resting = 1e-3};
            QVERIFY(rows.recordApproach(scene.bodies, settings));
            const std::vector<Displacement> moved = scene.still();
            for (int pass = 0; pass < 4; ++pass) rows.relax(scene.bodies, moved, settings, false);
            std::vector<std::uint8_t> isActive(scene.bodies.size(), 0);
            const ActiveBodies active{isActive, scene.immobile()};
            QCOMPARE(rows.activate(active), 1);
            rows.rebound(scene.bodies, moved, settings, 40, active);
            const auto of = [&](int k) { return scene.bodies[static_cast<std::size_t>(k)].velocity[0]; };
            if (elastic == 1)
                for (int k = 0; k < count; ++k)
                    QVERIFY(std::abs(of(k) - (k + 1 < count ? 0 : speed)) < 1e-12);
            else
                QVERIFY(std::abs(of(1) - of(0) - elastic * speed) < 1e-12 &&
                        std::abs(of(0) + of(1) - speed) < 1e-12);
            rows.forEach([last = count - 2](std::uint32_t index, const Vec3&, const Vec3& impulse) {
                if (static_cast<int>(index) == last) QVERIFY(impulse.norm() < 1e-12); // they part
            });
        }
    }

    // Whatever meets: momentum stays where nothing is fixed, energy does not grow, and where passes suffice
    // nothing that bounces goes on closing.
    void impactsKeepMomentumAndGainNoEnergy() {
        Random random(test::seed, 9);
        int impacts = 0, finished = 0;
        for (int trial = 0; trial < 300; ++trial) {
            BallScene scene = randomBalls(random, 2 + random.below(40));
            std::erase_if(scene.pairs, [&](const BallPair& pair) { return pair.a == scene.immobile(); });
            for (BallPair& pair : scene.pairs) pair.impulse.setZero();
            BallRows rows;
            scene.fill(rows);
            scene.refresh(rows);
            const StepSettings settings = randomSettings(random, scene.duration);
            const auto momentum = [&] {
                Vec3 sum = Vec3::Zero();
                for (const SolverBody& body : scene.bodies)
                    if (body.inverseMass > 0) sum += vectorOf(body.velocity) / body.inverseMass;
                return sum;
            };
            const double before = test::energyOfAll(scene.bodies);
            const Vec3 momentumBefore = momentum();
            rows.recordApproach(scene.bodies, settings);
            const std::vector<Displacement> moved = scene.still();
            for (int pass = 0; pass < 20; ++pass) rows.relax(scene.bodies, moved, settings, false);
            std::vector<std::uint8_t> isActive(scene.bodies.size(), 0);
            const ActiveBodies active{isActive, scene.immobile()};
            impacts += rows.activate(active);
            constexpr int most = 1000;
            finished += rows.rebound(scene.bodies, moved, settings, most, active) < most ? 1 : 0;
            QVERIFY((momentum() - momentumBefore).norm() < 1e-9 * (1 + momentumBefore.norm()));
            QVERIFY(test::energyOfAll(scene.bodies) <= before * (1 + 1e-9));
        }
        qInfo("impacts %d, finished %d of 300", impacts, finished);
        QVERIFY(impacts > 50 && finished > 290);
    }

    // Two balls anywhere, that meet within the step: impulse and velocities of Newton's law along the line of
    // centres at the moment they touch.
    void theNormalIsThatOfTheMeeting() {
        Random random(test::seed, 2);
        for (int trial = 0; trial < 2000; ++trial) {
            BallScene scene = emptyScene();
            scene.gravity.setZero();
            const double radiusA = random.uniform(0.05, 0.5), radiusB = random.uniform(0.05, 0.5);
            const double massA = random.uniform(0.5, 3), massB = random.uniform(0.5, 3);
            // At the meeting the centres are along n and close; before it they are further apart.
            const Vec3 n = uniformDirection(random);
            const Vec3 along = 3 * n.cross(uniformDirection(random));
            const Vec3 closing = -random.uniform(1, 5) * n + along; // of B relative to A
            const Vec3 mean = test::uniformIn(random, 3);
            const double time = random.uniform(0.2, 0.9) * scene.duration;
            const bool isFixed = trial % 3 == 0;
            const Vec3 place = test::uniformIn(random, 2);
            const Vec3 velocityA = isFixed ? Vec3(Vec3::Zero()) : mean;
            const Vec3 placeB = place + (radiusA + radiusB) * n - time * closing;
            if (!isFixed) scene.addBall(radiusA, massA, place, velocityA);
            const std::uint32_t b = scene.addBall(radiusB, massB, placeB, velocityA + closing);
            BallPair& pair = scene.addPair(isFixed ? scene.immobile() : 0, b);
            pair.radiusA = radiusA;
            if (isFixed) pair.fixed = place;
            pair.normal = scene.between(pair).normalized();
            pair.restitution = random.uniform(0.1, 1);
            BallRows rows;
            scene.fill(rows);
            scene.refresh(rows);
            if (scene.gapOf(pair) <= openBeyond * (radiusA + radiusB)) continue;
            QCOMPARE(rows.activeGroups(), 1U);
            QVERIFY((seenIn(rows, 1).normals[0] - n).norm() < foreseenRounding);
            const StepSettings settings{.duration = scene.duration, .resting = 1e-3};
            QCOMPARE(step(rows, scene, settings, 2), 1);
            const double reduced = 1 / (scene.bodies[pair.a].inverseMass + scene.bodies[b].inverseMass);
            const Vec3 impulse = -(1 + pair.restitution) * reduced * n.dot(closing) * n;
            QVERIFY((vectorOf(scene.bodies[b].velocity) - velocityA - closing - impulse / massB).norm() <
                    1e2 * foreseenRounding);
            if (!isFixed)
                QVERIFY((vectorOf(scene.bodies[0].velocity) - velocityA + impulse / massA).norm() <
                        1e2 * foreseenRounding);
        }
    }

    void aBallOnAWallHasItsNormalAndFallsOnItInTime() {
        BallScene scene = emptyScene();
        const double radius = 0.1, h = scene.duration;
        const Vec3 normal = Vec3(1, 2, -0.5).normalized(), point(3, 1, -2);
        scene.addBall(radius, 2, Vec3::Zero(), Vec3::Zero());
        scene.addWall(normal, point, 0).restitution = 0.5;
        BallRows rows;
        const double slack = slackPart * radius + scene.gravity.norm() * h * h;
        for (const double speed : {-3.0, 0.0, 0.1, 10.0})
            for (const double gap : {-0.005, 0.0, 0.0005, 0.002, 0.02, 0.05}) {
                scene.places[0].position = arrayOf(point + (radius + gap) * normal);
                scene.bodies[0].velocity = arrayOf(-speed * normal);
                scene.fill(rows);
                scene.refresh(rows);
                const double coming = h * speed - 0.5 * h * h * normal.dot(scene.gravity);
                const bool meets = gap <= slack || gap - coming <= slack;
                QCOMPARE(rows.activeGroups(), meets ? 1U : 0U);
                QVERIFY((seenIn(rows, 1).normals[0] - normal).norm() == 0);
                QVERIFY(std::abs(rows.deepest() - std::max(0.0, -gap)) < rounding);
            }
    }

    void whoPassesByIsIdleAndCostsNothing() {
        Random random(test::seed, 3);
        for (int trial = 0; trial < 200; ++trial) {
            BallScene scene = emptyScene();
            scene.gravity.setZero();
            // Fast, with a nearest approach of more than the slack, at a time within the step.
            for (int k = 0; k < 20; ++k) {
                const Vec3 place = test::uniformIn(random, 1), n = uniformDirection(random);
                const Vec3 velocity = 100 * n.cross(uniformDirection(random)).normalized();
                const std::uint32_t a = scene.addBall(0.1, 1, place, Vec3::Zero());
                const Vec3 nearest = place + random.uniform(0.2021, 0.3) * n;
                const std::uint32_t b = scene.addBall(
                    0.1, 1, nearest - random.uniform(0, 1) * scene.duration * velocity, velocity);
                BallPair& pair = scene.addPair(a, b);
                pair.normal = n;
                pair.friction = pair.restitution = 1;
                pair.impulse = n; // it was in contact before
            }
            BallRows rows;
            scene.fill(rows);
            scene.refresh(rows);
            QCOMPARE(rows.activeGroups(), 0U);
            const std::vector<SolverBody> before = scene.bodies;
            const StepSettings settings{.duration = scene.duration};
            const std::vector<Displacement> moved = scene.still();
            QVERIFY(!rows.recordApproach(scene.bodies, settings));
            QVERIFY(!rows.findStruck(scene.bodies, scene.places, moved, scene.duration, scene.gravity));
            QCOMPARE(step(rows, scene, settings, 2), 0);
            for (std::size_t i = 0; i < before.size(); ++i) QVERIFY(sameBits(scene.bodies[i], before[i]));
            for (const Vec3& impulse : seenIn(rows, scene.pairs.size()).impulses)
                QVERIFY(impulse == Vec3::Zero());
        }
    }

    // A ball rests near another one that nothing moves; then it is struck towards it within the step.
    void anIdleGroupWakesWhenABallIsStruck() {
        BallScene scene = emptyScene();
        scene.gravity.setZero();
        scene.addBall(0.1, 1, Vec3::Zero(), Vec3::Zero());
        scene.addBall(0.1, 1, Vec3(0.21, 0, 0), Vec3::Zero());
        scene.addPair(0, 1).normal = Vec3::UnitX();
        BallRows rows;
        scene.fill(rows);
        scene.refresh(rows);
        QCOMPARE(rows.activeGroups(), 0U);
        std::vector<Displacement> moved = scene.still();
        const auto find = [&] {
            return rows.findStruck(scene.bodies, scene.places, moved, scene.duration, scene.gravity);
        };
        const StepSettings settings{.duration = scene.duration};
        scene.bodies[0].velocity[0] = 2.4; // .0096 of .01 m
        QVERIFY(!find());
        scene.bodies[0].velocity[0] = 2.6;
        QVERIFY(find());
        QCOMPARE(rows.activeGroups(), 1U);
        rows.solve(scene.bodies, moved, settings, false);
        // They come as near as to touch, and momentum is kept.
        const double closing = scene.bodies[0].velocity[0] - scene.bodies[1].velocity[0];
        QVERIFY(std::abs(closing - 0.01 / scene.duration) < rounding);
        QVERIFY(std::abs(scene.bodies[0].velocity[0] + scene.bodies[1].velocity[0] - 2.6) < rounding);

        // The same where the bodies have come some of the way since the rows were made.
        scene.bodies[0].velocity[0] = scene.bodies[1].velocity[0] = 0;
        scene.refresh(rows);
        QCOMPARE(rows.activeGroups(), 0U);
        moved[0].shift[0] = scene.places[0].position[0] = 0.006;
        scene.bodies[0].velocity[0] = 0.9; // .0036 of .004 m
        QVERIFY(!find());
        scene.bodies[0].velocity[0] = 1.1;
        QVERIFY(find());
        rows.solve(scene.bodies, moved, settings, false);
        QVERIFY(std::abs(scene.bodies[0].velocity[0] - scene.bodies[1].velocity[0] - 0.004 / scene.duration) <
                rounding);
    }

    void frictionImpulsesFollowATurningNormal() {
        Random random(test::seed, 4);
        for (int trial = 0; trial < 500; ++trial) {
            BallScene scene = emptyScene();
            scene.gravity.setZero();
            const Vec3 n = uniformDirection(random);
            scene.addBall(0.1, 1, Vec3::Zero(), Vec3::Zero());
            scene.addBall(0.2, 1, 0.2995 * n, Vec3::Zero());
            BallPair& pair = scene.addPair(0, 1);
            pair.normal = n;
            const double normal = random.uniform(0, 1);
            const Vec3 friction = 0.3 * n.cross(uniformDirection(random));
            pair.impulse = normal * n + friction;
            BallRows rows;
            scene.fill(rows);
            scene.refresh(rows);
            QVERIFY((seenIn(rows, 1).impulses[0] - pair.impulse).norm() < rounding);
            const Vec3 now = (n + test::uniformIn(random, 0.3)).normalized();
            scene.places[1].position = arrayOf(0.2995 * now);
            scene.refresh(rows);
            const Vec3 expected = normal * now + (friction - now.dot(friction) * now);
            QVERIFY((seenIn(rows, 1).normals[0] - now).norm() < rounding);
            QVERIFY((seenIn(rows, 1).impulses[0] - expected).norm() < rounding);
        }
    }

    // One ball in one lane of four; the others stand for what cannot move.
    // Two balls that have gone through each other: the force that held them would pull now.
    void anImpulseThatPullsIsForgotten() {
        BallScene scene = emptyScene();
        const std::uint32_t a = scene.addBall(0.1, 1, {0, 0, 0}, Vec3::Zero());
        const std::uint32_t b = scene.addBall(0.1, 1, {0, 0.1, 0}, Vec3::Zero());
        for (const double impulse : {0.5, -0.5}) {
            scene.pairs.clear();
            BallPair& pair = scene.addPair(a, b);
            pair.normal = Vec3::UnitY();
            pair.impulse = {0.1, impulse, 0};
            pair.friction = 1;
            BallRows rows;
            scene.fill(rows);
            const Vec3 held = seenIn(rows, 1).impulses[0];
            QVERIFY((held - (impulse > 0 ? pair.impulse : Vec3(Vec3::Zero()))).norm() < rounding);
        }
    }

    void whatCannotMoveIsNotChangedByALane() {
        Random random(test::seed, 5);
        for (int trial = 0; trial < 500; ++trial) {
            BallScene scene = randomBalls(random, 1 + random.below(3));
            for (SolverBody& body : scene.bodies)
                if (body.inverseMass > 0)
                    for (double& speed : body.velocity) speed *= trial % 3 == 0 ? 1e100 : 1;
            BallRows rows;
            scene.fill(rows);
            const SolverBody before = scene.bodies.back();
            for (int frame = 0; frame < 3; ++frame) {
                scene.refresh(rows);
                step(rows, scene, {.duration = scene.duration}, 2);
                rows.findStruck(scene.bodies, scene.places, scene.still(), scene.duration, scene.gravity);
                QVERIFY(sameBits(scene.bodies.back(), before));
            }
        }
    }

    void momentumOfBallsIsKept() {
        Random random(test::seed, 7);
        for (int trial = 0; trial < 50; ++trial) {
            BallScene scene = randomBalls(random, 2 + random.below(60));
            std::erase_if(scene.pairs, [&](const BallPair& pair) { return pair.a == scene.immobile(); });
            BallRows rows;
            scene.fill(rows);
            scene.refresh(rows);
            const auto momentum = [&] {
                Vec3 sum = Vec3::Zero();
                for (std::uint32_t i = 0; i < scene.immobile(); ++i)
                    sum += vectorOf(scene.bodies[i].velocity) / scene.bodies[i].inverseMass;
                return sum;
            };
            const Vec3 before = momentum();
            step(rows, scene, {.duration = scene.duration}, 2);
            QVERIFY((momentum() - before).norm() < 1e2 * rounding);
        }
    }
};

} // namespace carom

CAROM_TEST(ball_rows_test, carom::BallRowsTest)
#include "ball_rows_test.moc"
