// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/core/solvers/contacts/two_bodies.h"
#include "tests/support/constants.h"
#include "tests/support/scenes.h"
#include "tests/support/solver_rows.h"
#include "tests/support/test_class.h"

#include "core/dynamics/contact_memory.h"
#include "core/math/random.h"
#include "core/math/rotation.h"
#include "core/narrowphase/narrowphase.h"
#include "core/solvers/contacts/manifolds.h"
#include "core/solvers/contacts/stepped_motion.h"
#include "core/narrowphase/core_direction.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

// Contacts that outlast the substep: kept while two bodies move little against each other, found anew beyond,
// with the forces they had.

namespace carom {
namespace {

using test::cuboid;
using test::cylinder;
using test::duration;
using test::fixedOne;
using test::margin;
using test::roundingOfPlaces;
using test::sphere;
using test::turnedBy;
using test::Two;
using test::uniformIn;
using test::wall;

/// Pairs whose points are carried, touching or nearly so; lengths of about 1 m.
std::vector<std::pair<Body, Body>> carriedPairs(Random& random) {
    const auto tilt = [&] { return uniformIn(random, 0.01); };
    const Body cube = cuboid({1, 1, 1}, 1, {0, 0.5, 0});
    const Body disc = cylinder(0.5, 1, 1, {0, 0.5, 0});
    const Vec3 above{random.uniform(-0.3, 0.3), 1.5, random.uniform(-0.3, 0.3)};
    return {{wall(Vec3::UnitY(), 0), turnedBy(cube, tilt())},
            {turnedBy(cube, tilt()), wall(Vec3::UnitY(), 0)},
            {wall(Vec3::UnitY(), 0), turnedBy(disc, tilt())},
            {cube, turnedBy(cuboid({1, 1, 1}, 2, above), tilt())},
            {cube, turnedBy(cylinder(0.5, 1, 2, above), tilt())},
            {fixedOne(disc), turnedBy(cuboid({1, 1, 1}, 2, above), tilt())},
            {turnedBy(cylinder(0.5, 1, 1, {0, 0.5, 0}), tilt()), cylinder(0.4, 1, 2, above)}};
}

void giveForces(PersistentManifold& manifold, Random& random) {
    for (int k = 0; k < manifold.count; ++k)
        manifold.points[static_cast<std::size_t>(k)].force = uniformIn(random, 10);
}

/// The forces of a contact with the places they act at, to be compared.
Vec3 totalForce(const PersistentManifold& manifold) {
    Vec3 sum = Vec3::Zero();
    for (int k = 0; k < manifold.count; ++k) sum += manifold.points[static_cast<std::size_t>(k)].force;
    return sum;
}

} // namespace

class ManifoldsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void pointsAreKeptWhileTheRelativePoseIsWithinLimits() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed);
        for (int trial = 0; trial < 20; ++trial)
            for (const auto& [a, b] : carriedPairs(random)) {
                Two two(a, b);
                QVERIFY(two.update());
                QVERIFY(two.manifold.count > 0);
                QVERIFY(!two.update()); // nothing has moved
                const BodyIndex mover = two.bodies.mobile[1] != 0 ? 1 : 0;
                const PersistentManifold start = two.manifold;
                const double size = two.bodies.boundingRadius[mover];

                // Within 0.3 % of the size or 0.005 rad; of what is not followed 0.02 % and 0.0002.
                const bool isFollowed = two.manifold.source.kind != DirectionSource::Kind::Other;
                const double within = isFollowed ? 0.003 : 0.0002, angle = isFollowed ? 0.005 : 0.0002;
                two.moveBy(mover, 0.5 * 0.8 * within * size * uniformDirection(random));
                QVERIFY(!two.update());
                two.moveBy(mover, Vec3::Zero(), 0.2 * angle * uniformDirection(random));
                QVERIFY(!two.update());
                QCOMPARE(two.manifold.count, start.count);
                for (int k = 0; k < start.count; ++k) {
                    const std::size_t i = static_cast<std::size_t>(k);
                    QVERIFY(two.manifold.points[i].onA == start.points[i].onA);
                    QVERIFY(two.manifold.points[i].onB == start.points[i].onB);
                }

                Two shifted(a, b);
                shifted.update();
                shifted.moveBy(mover, 1.05 * within * size * uniformDirection(random));
                QVERIFY(shifted.update());
                Two turned(a, b);
                turned.update();
                turned.moveBy(mover, Vec3::Zero(), 1.05 * angle * uniformDirection(random));
                QVERIFY(turned.update());
            }
    }

    void pairThatMovesAsOneKeepsItsPoints() {
        Random random(test::seed, 1);
        for (int trial = 0; trial < 20; ++trial)
            for (const auto& [a, b] : carriedPairs(random)) {
                Two two(a, b);
                if (two.bodies.walls.size() == 1) continue;
                two.update();
                const PlacedManifold before = two.here();
                const Quat turn = fromRotationVector(uniformDirection(random) * random.uniform(0, 3));
                const Vec3 shift = uniformIn(random, 5);
                for (Pose& pose : two.state.pose) {
                    pose.position = turn * pose.position + shift;
                    pose.orientation = turn * pose.orientation;
                }
                QVERIFY(!two.update());
                const PlacedManifold after = two.here();
                QVERIFY((after.normal - turn * before.normal).norm() < roundingOfPlaces);
                for (int k = 0; k < after.count; ++k) {
                    const std::size_t i = static_cast<std::size_t>(k);
                    QVERIFY(std::abs(after.points[i].separation - before.points[i].separation) < 1e-12);
                    QVERIFY((after.points[i].armB - turn * before.points[i].armB).norm() < 1e-12);
                }
            }
    }

    void keptPointsTellTheGapAsTheShapesDo() {
        Random random(test::seed, 2);
        for (int trial = 0; trial < 20; ++trial)
            for (const auto& [a, b] : carriedPairs(random)) {
                Two two(a, b);
                two.update();
                const BodyIndex mover = two.bodies.mobile[1] != 0 ? 1 : 0;
                two.moveBy(mover, 0.0001 * uniformDirection(random));
                QVERIFY(!two.update());
                const PlacedManifold kept = two.here();
                double deepest = kept.points[0].separation;
                for (int k = 1; k < kept.count; ++k)
                    deepest = std::min(deepest, kept.points[static_cast<std::size_t>(k)].separation);
                // Of the order of the shift times the tilt between the faces.
                QVERIFY(std::abs(deepest - two.found().deepest().separation) < 1e-5);
            }
    }

    void freshPointsAreThoseOfTheNarrowPhase() {
        Random random(test::seed, 3);
        std::size_t reduced = 0;
        for (int trial = 0; trial < 300; ++trial) {
            // A cuboid on another, turned: up to eight points.
            const Vec3 tilt = uniformIn(random, 0.01) + Vec3(0, random.uniform(0, 3), 0);
            Two two(cuboid({1, 1, 1}, 1, {0, 0.5, 0}),
                    turnedBy(cuboid({1, 1, 1}, 1, {0, random.uniform(1.49, 1.51), 0}), tilt));
            const Manifold all = two.found();
            if (all.count == 0) continue;
            two.update();
            const PlacedManifold here = two.here();
            QVERIFY(here.count <= static_cast<int>(manifoldPoints) && here.count <= all.count);
            reduced += all.count > here.count;
            if (all.count <= static_cast<int>(manifoldPoints)) QCOMPARE(here.count, all.count);
            QVERIFY((here.normal - all.normal).norm() < roundingOfPlaces);
            double deepest = margin;
            for (int k = 0; k < here.count; ++k) { // each of them is one of those found
                const PointInput& point = here.points[static_cast<std::size_t>(k)];
                deepest = std::min(deepest, point.separation);
                const Vec3 middle = two.state.pose[1].position + point.armB;
                QVERIFY(std::ranges::any_of(all, [&](const ContactPoint& one) {
                    return (0.5 * (one.onA + one.onB) - middle).norm() < roundingOfPlaces &&
                           std::abs(one.separation - point.separation) < roundingOfPlaces;
                }));
            }
            QVERIFY(std::abs(deepest - all.deepest().separation) < roundingOfPlaces);
        }
        QVERIFY(reduced > 50);
    }

    // A cube that leans on an edge of its lower face, the others of its corners apart by a few hundredths of
    // its size: both ends of the edge bear it. One of them was left out in favour of points that bore
    // nothing.
    void reducedPointsAreThoseThatBear() {
        Random random(test::seed, 5);
        int reduced = 0;
        for (int trial = 0; trial < 300; ++trial) {
            const Quat lean = fromRotationVector(Vec3(0, random.uniform(0, 3), 0)) *
                              fromRotationVector(Vec3(0, 0, random.uniform(0.02, 0.05)));
            const Vec3 shift(random.uniform(-0.3, 0.3), 1.505, random.uniform(-0.3, 0.3));
            Body above = cuboid({1, 1, 1}, 1, shift);
            above.pose.orientation = lean;
            Two two(cuboid({1, 1, 1}, 1, {0, 0.5, 0}), above);
            Manifold all = two.found();
            if (all.count <= static_cast<int>(manifoldPoints)) continue;
            std::sort(
                all.points.begin(), all.points.begin() + all.count,
                [](const ContactPoint& a, const ContactPoint& b) { return a.separation < b.separation; });
            const bool bearTwo = all.points[1].separation - all.points[0].separation < 1e-9 &&
                                 (all.points[1].onB - all.points[0].onB).norm() > 0.3;
            if (!bearTwo) continue;
            ++reduced;
            two.update();
            const PlacedManifold here = two.here();
            int bearing = 0;
            for (int k = 0; k < here.count; ++k)
                bearing +=
                    here.points[static_cast<std::size_t>(k)].separation - all.points[0].separation < 1e-9;
            QCOMPARE(bearing, 2);
        }
        QVERIFY2(reduced > 20, qPrintable(QString::number(reduced)));
    }

    void reducedPointsStillHoldTheBodyUp() {
        // Four of eight points still surround the axis of the body above.
        Random random(test::seed, 4);
        int reduced = 0;
        for (int trial = 0; trial < 100; ++trial) {
            Two two(cuboid({1, 1, 1}, 1, {0, 0.5, 0}),
                    turnedBy(cuboid({1, 1, 1}, 1, {0, 1.5, 0}), Vec3(0, random.uniform(0.2, 1.3), 0)));
            two.update();
            if (two.found().count <= two.manifold.count) continue;
            ++reduced;
            const PlacedManifold here = two.here();
            for (int heading = 0; heading < 16; ++heading) {
                const double angle = heading * std::numbers::pi / 8;
                const Vec3 towards(std::cos(angle), 0, std::sin(angle));
                double furthest = -1;
                for (int k = 0; k < here.count; ++k)
                    furthest = std::max(furthest, towards.dot(here.points[static_cast<std::size_t>(k)].armB));
                QVERIFY(furthest > 0.1);
            }
        }
        QVERIFY(reduced > 50);
    }

    void freshPointsInheritTheForcesOfOldOnes() {
        Random random(test::seed, 5);
        int compared = 0, chosen = 0, lost = 0;
        for (int trial = 0; trial < 20; ++trial) {
            int pair = -1;
            for (const auto& [a, b] : carriedPairs(random)) {
                ++pair;
                Two two(a, b);
                two.update();
                giveForces(two.manifold, random);
                const PersistentManifold old = two.manifold;
                // Far enough to be found anew, near enough for every point to be found again.
                const BodyIndex mover = two.bodies.mobile[1] != 0 ? 1 : 0;
                const Vec3 across = Vec3::UnitY().cross(uniformDirection(random)).normalized();
                two.moveBy(mover, 0.005 * across);
                QVERIFY(two.update());
                if (two.manifold.count != old.count) continue;
                // Each force is where it was, to within 5 % of the size; of more than four points others may
                // have been chosen.
                const bool isChoice = two.found().count > two.manifold.count;
                for (int k = 0; k < old.count; ++k) {
                    const PersistentManifold::Point& from = old.points[static_cast<std::size_t>(k)];
                    const bool isFound =
                        std::any_of(two.manifold.points.begin(), two.manifold.points.begin() + old.count,
                                    [&](const PersistentManifold::Point& to) {
                                        const double apart =
                                            std::min((to.onA - from.onA).norm(), (to.onB - from.onB).norm());
                                        return to.force == from.force && apart < 0.05 * 0.9;
                                    });
                    QVERIFY2(isFound || isChoice, qPrintable(QStringLiteral("pair %1").arg(pair)));
                    ++compared;
                    chosen += isChoice;
                    lost += !isFound;
                }
            }
        }
        qInfo("of %d forces %d at points chosen among more than four, of which %d lost", compared, chosen,
              lost);
        QVERIFY(compared - chosen > 100);
    }

    // Two faces cover each other in eight corners, of which four are taken; others after a little turn.
    void forcesOfPointsThatAreGoneAreSharedByTheOthers() {
        Random random(test::seed, 8);
        int changed = 0;
        double worst = 0;
        for (int trial = 0; trial < 200; ++trial) {
            Two two(cuboid({1, 1, 1}, 1, {0, 0.5, 0}),
                    turnedBy(cuboid({1, 1, 1}, 2, {0, 1.5, 0}),
                             Vec3(0, 0.7 + 0.1 * random.uniform(-1, 1), 0) + uniformIn(random, 0.001)));
            two.update();
            for (PersistentManifold::Point& point : two.manifold.points)
                point.force = Vec3(0.1, random.uniform(0.5, 2), 0.2);
            const auto momentOf = [&](const PersistentManifold& manifold) {
                Vec3 sum = Vec3::Zero();
                for (int k = 0; k < manifold.count; ++k) {
                    const PersistentManifold::Point& point = manifold.points[static_cast<std::size_t>(k)];
                    sum +=
                        two.state.pose[1].directionToWorld(point.onB).cross(point.force.y() * Vec3::UnitY());
                }
                return sum;
            };
            const PersistentManifold old = two.manifold;
            const Vec3 force = totalForce(old), moment = momentOf(old);
            two.moveBy(1, Vec3::Zero(), uniformIn(random, 0.004) + Vec3(0, 0.006, 0));
            if (!two.update() || two.manifold.count != 4) continue;
            bool isSame = true;
            for (int k = 0; k < 4; ++k) {
                const auto at = static_cast<std::size_t>(k);
                isSame = isSame && (two.manifold.points[at].onB - old.points[at].onB).norm() < 0.05;
            }
            changed += isSame ? 0 : 1;
            worst = std::max({worst, (totalForce(two.manifold) - force).norm() / force.norm(),
                              (momentOf(two.manifold) - moment).norm() / force.norm()});
        }
        qInfo("%d changed their points; force and moment by at most %.2g", changed, worst);
        QVERIFY(changed > 20);
        QVERIFY(worst < 0.02);
    }

    void pointsElsewhereBeginWithoutForce() {
        Random random(test::seed, 6);
        Two two(cuboid({1, 1, 1}, 1, {0, 0.5, 0}), cuboid({0.1, 0.1, 0.1}, 1, {-0.4, 1.05, 0}));
        two.update();
        giveForces(two.manifold, random);
        two.moveBy(1, {0.3, 0, 0}, {0, 0, std::numbers::pi}); // elsewhere, on the opposite face
        QVERIFY(two.update());
        QVERIFY(two.manifold.count > 0);
        QVERIFY(totalForce(two.manifold) == Vec3::Zero());
    }

    void contactsOfSpheresAreComputedEachTimeAndKeepTheirForce() {
        Random random(test::seed, 7);
        const Body ball = sphere(0.5, 1, {0, 0.5, 0});
        const Body others[] = {sphere(0.5, 1, {0.1, 1.49, 0}), wall(Vec3::UnitY(), 0),
                               cuboid({1, 1, 1}, 1, {0.2, 1.499, 0}), cylinder(0.5, 1, 1, {0, 1.5, 0})};
        for (const Body& other : others)
            for (const bool swap : {false, true}) {
                Two two(swap ? other : ball, swap ? ball : other);
                QVERIFY(two.update());
                QCOMPARE(two.manifold.count, 1);
                QVERIFY(two.manifold.round);
                two.manifold.points[0].force = uniformIn(random, 5);
                const Vec3 force = two.manifold.points[0].force;
                QVERIFY(two.update());
                QCOMPARE(two.manifold.points[0].force, force);
                two.moveBy(swap ? 1 : 0, {0.002, 0, 0}, {0, 0, 1}); // however far it rolled
                QVERIFY(two.update());
                QCOMPARE(two.manifold.points[0].force, force);
                const PlacedManifold here = two.here();
                const Manifold found = two.found();
                QVERIFY((here.normal - found.normal).norm() < roundingOfPlaces);
                QVERIFY(std::abs(here.points[0].separation - found.points[0].separation) < roundingOfPlaces);
            }
    }

    void bodiesOutOfReachHaveNoPoints() {
        Random random(test::seed, 11);
        Two two(cuboid({1, 1, 1}, 1, {0, 0.5, 0}), cuboid({1, 1, 1}, 1, {0, 1.54, 0}));
        two.update();
        QVERIFY(two.manifold.count > 0);
        giveForces(two.manifold, random);
        two.moveBy(1, {0, 0.02, 0});
        two.update();
        QCOMPARE(two.manifold.count, 0);
        two.moveBy(1, {0, -0.06, 0}); // touching, from one substep to the next
        QVERIFY(two.update());
        QVERIFY(two.manifold.count > 0 && !two.manifold.open);
        QVERIFY(totalForce(two.manifold) == Vec3::Zero());
    }

    void pairIsOpenOnlyIfItCannotTouchWithinTheSubstep() {
        constexpr double furthest = 0.5; // any two come nearer by less than this [m]
        Random random(test::seed, 12);
        int open = 0, touched = 0;
        for (int trial = 0; trial < 2000; ++trial) {
            const auto drawn = [&](const Vec3& centre) {
                const Vec3 turn = uniformIn(random, 3);
                const std::uint64_t kind = random.below(3);
                Body body = kind == 0   ? sphere(0.5, 1, centre)
                            : kind == 1 ? turnedBy(cylinder(0.5, 1, 1, centre), turn)
                                        : turnedBy(cuboid({1, 1, 1}, 1, centre), turn);
                body.velocity = uniformIn(random, 8);
                body.angularVelocity = uniformIn(random, 8);
                return body;
            };
            const Body first = drawn(Vec3::Zero());
            Two two(first, drawn(random.uniform(0.9, 1.6) * uniformDirection(random)));
            two.update(furthest);
            two.update(furthest); // a second time along the direction that was found
            if (!two.manifold.open) continue;
            ++open;
            // On their way through the substep, alone in the world.
            bool touch = false;
            for (int step = 0; step < 10; ++step) {
                for (const BodyIndex i : {0U, 1U})
                    two.moveBy(i, 0.1 * duration * two.state.velocity[i],
                               0.1 * duration * two.state.angularVelocity[i]);
                Manifold now;
                touch = touch || collide({&two.bodies.shape[0], &two.state.pose[0]},
                                         {&two.bodies.shape[1], &two.state.pose[1]}, 0, now);
            }
            touched += touch;
        }
        qInfo("%d pairs open, %d of them touched", open, touched);
        QVERIFY(open > 50);
        QCOMPARE(touched, 0);
    }

    // Points left out stay apart on the way of both through the substep.
    void pointsThatMayTouchAreNear() {
        Random random(test::seed, 21);
        int left = 0, kept = 0;
        for (int trial = 0; trial < 300; ++trial)
            for (auto [a, b] : carriedPairs(random)) {
                b = turnedBy(b, uniformIn(random, 0.2));
                for (Body* body : {&a, &b}) {
                    body->velocity = uniformIn(random, 2);
                    body->angularVelocity = uniformIn(random, 2);
                }
                Two two(a, b);
                two.update();
                if (two.manifold.open) continue;
                double reach = 0; // points are less than 1 m from the centres
                for (const BodyIndex i : {0U, 1U})
                    reach += duration * (two.state.velocity[i].norm() + two.state.angularVelocity[i].norm());
                const unsigned near =
                    nearPoints(two.input, two.manifold, normalOf(two.input, two.manifold), reach).bits;
                std::array<double, manifoldPoints> least{1, 1, 1, 1};
                for (int step = 0; step < 10; ++step) {
                    for (const BodyIndex i : {0U, 1U})
                        if (two.bodies.mobile[i] != 0)
                            two.moveBy(i, 0.1 * duration * two.state.velocity[i],
                                       0.1 * duration * two.state.angularVelocity[i]);
                    const PlacedManifold now = placed(two.input, two.manifold);
                    for (std::size_t k = 0; k < least.size(); ++k)
                        least[k] = std::min(least[k], now.points[k].separation);
                }
                for (unsigned k = 0; k < static_cast<unsigned>(two.manifold.count); ++k) {
                    ++((near >> k & 1U) != 0 ? kept : left);
                    QVERIFY((near >> k & 1U) != 0 || least[k] > 0);
                }
            }
        QVERIFY(left > 100 && kept > 100);
    }

    // What counts is how fast they close the gap between them, not how fast they move.
    void bodiesThatPassAlongsideEachOtherAreOpen() {
        constexpr double gap = 0.02, speed = 10; // a substep at this speed is twice the gap [m, m/s]
        for (const auto& [velocity, isOpen] :
             {std::pair(Vec3(speed, 0, 0), true), {Vec3(0, speed, 0), true}, {Vec3(0, -speed, 0), false}}) {
            Two two(cuboid({1, 1, 1}, 1, {0, 0.5, 0}), cuboid({1, 1, 1}, 1, {0, 1.5 + gap, 0}));
            two.update();
            two.state.velocity[1] = velocity;
            two.update();
            QCOMPARE(two.manifold.open, isOpen);
        }
    }

    void spheresThatPassEachOtherByAreNotStopped() {
        Random random(test::seed, 8);
        int passes = 0, head = 0;
        for (int trial = 0; trial < 5000; ++trial) {
            const double radii = 1;
            const Vec3 towards = uniformDirection(random);
            const Vec3 across = towards.cross(uniformDirection(random)).normalized();
            const double gap = random.uniform(0.0011, margin);
            // Beside each other mostly, and fast: hits and misses alike.
            const double speed = random.uniform(0, 300);
            const double slant = random.uniform(0, 0.4);
            const Vec3 velocity = speed * (across - slant * towards).normalized();
            Body b = sphere(radii / 2, random.uniform(0.1, 10), (radii + gap) * towards, velocity);
            b.elastic = random.uniform();
            Two two(sphere(radii / 2, random.uniform(0.1, 10), Vec3::Zero()), b);
            // The nearest approach within the substep, along straight lines.
            const Vec3 between = two.state.pose[1].position;
            const double time = std::clamp(-between.dot(velocity) / velocity.squaredNorm(), 0.0, duration);
            const bool passesBy = time < duration && (between + time * velocity).norm() > radii * (1 + 1e-9);
            QVERIFY(two.update());
            QCOMPARE(two.manifold.count, 1);

            Manifolds manifolds;
            const std::uint32_t place = manifolds.add(two.manifold);
            SteppedMotion motion;
            const BodyIndex list[] = {0, 1};
            const SteppedInput input{.bodies = two.bodies, .gravity = Vec3::Zero(), .state = two.state};
            motion.begin(two.bodies, {.looks = 1, .steps = 4, .passes = 2}, duration);
            motion.addIsland(input, list, {});
            motion.addPair(input, {two.manifold.pair, place, 1.0}, manifolds);
            const SteppedReport report = motion.advance(input, manifolds);
            QVERIFY(!report.loss);
            const Vec3 after = two.state.velocity[1];
            if (passesBy) {
                ++passes;
                QVERIFY(after == velocity && two.state.velocity[0] == Vec3::Zero());
                continue;
            }
            if ((between + time * velocity).norm() > 0.999 * radii)
                continue; // grazing, or not yet met: they may
            ++head;
            QVERIFY(after != velocity);
            const double left = (two.state.pose[1].position - two.state.pose[0].position).norm();
            QVERIFY2(left > radii * 0.95, qPrintable(QString::number(left)));
        }
        qInfo("%d passed by, %d met", passes, head);
        QVERIFY(passes > 500 && head > 500);
    }

    void otherFormAndBackKeepsForcesAndPlaces() {
        Random random(test::seed, 9);
        for (int trial = 0; trial < 20; ++trial) {
            std::vector<std::pair<Body, Body>> pairs = carriedPairs(random);
            pairs.emplace_back(sphere(0.5, 1, {0, 0.5, 0}), sphere(0.5, 1, {0.1, 1.49, 0}));
            pairs.emplace_back(wall(Vec3::UnitY(), 0), sphere(0.5, 1, {0, 0.499, 0}));
            pairs.emplace_back(sphere(0.5, 1, {0, 0.499, 0}), fixedOne(cuboid({1, 1, 1}, 0, {0, -0.5, 0})));
            for (const auto& [a, b] : pairs) {
                Two two(a, b);
                two.update();
                giveForces(two.manifold, random);
                const PlacedManifold before = two.here();
                const ContactPair pair = pairOf(two.bodies, {0, 1}, margin);
                ContactSet set;
                appendTo(set, two.input, pair, two.manifold);
                QCOMPARE(set.pairs.size(), 1U);
                QCOMPARE(static_cast<int>(set.pairs[0].count), before.count);
                for (int k = 0; k < before.count; ++k) {
                    const ContactConstraint& point = set.points[static_cast<std::size_t>(k)];
                    QVERIFY((point.frame.row(0).transpose() - before.normal).norm() < roundingOfPlaces);
                    QVERIFY((point.frame * point.frame.transpose() - Mat3::Identity()).norm() <
                            roundingOfPlaces);
                    QVERIFY(point.separation == before.points[static_cast<std::size_t>(k)].separation);
                }

                PersistentManifold back = manifoldOf(two.input, pair, set.points);
                QCOMPARE(back.count, before.count);
                const PlacedManifold after = placed(two.input, back);
                for (int k = 0; k < before.count; ++k) {
                    const std::size_t i = static_cast<std::size_t>(k);
                    QVERIFY((after.points[i].impulse - before.points[i].impulse).norm() < 1e-12);
                    // Spheres have an arm each to their surface, all others one point for both.
                    const double gap = back.round ? std::abs(before.points[i].separation) : 0;
                    QVERIFY((after.points[i].armA - before.points[i].armA).norm() < gap + roundingOfPlaces);
                    QVERIFY((after.points[i].armB - before.points[i].armB).norm() < gap + roundingOfPlaces);
                }
                // Its points are found anew, and take over the forces.
                const Vec3 total = totalForce(back);
                QVERIFY(updateManifold(two.input, margin, back));
                QCOMPARE(back.count, before.count);
                QVERIFY((totalForce(back) - total).norm() < 1e-12);
            }
        }
    }

    void manifoldsKeepTheirPlaceWhileTheyLive() {
        Random random(test::seed, 10);
        Manifolds manifolds;
        std::vector<Manifolds::Entry> alive;
        for (int trial = 0; trial < 2000; ++trial) {
            if (alive.empty() || random.below(5) < 3) {
                const BodyPair pair{static_cast<BodyIndex>(trial), static_cast<BodyIndex>(trial + 1)};
                const std::uint32_t place = manifolds.add(pair);
                QVERIFY(manifolds[place].count == 0); // a place that is used again keeps nothing
                manifolds[place].count = 2;
                QVERIFY(std::ranges::none_of(
                    alive, [&](const Manifolds::Entry& one) { return one.place == place; }));
                alive.push_back({pair, place});
            } else {
                const std::size_t i = random.below(alive.size());
                manifolds.remove(alive[i].place);
                alive.erase(alive.begin() + static_cast<std::ptrdiff_t>(i));
            }
            for (const Manifolds::Entry& entry : alive) QVERIFY(manifolds[entry.place].pair == entry.pair);
        }
        std::vector<Manifolds::Entry> entries = alive;
        manifolds.exchange(entries);
        QCOMPARE(manifolds.entries().size(), alive.size());
        QVERIFY(entries.empty());
    }

    // A pair that was found with a wide margin needs rows only if it may touch within the substep.
    void whatIsFoundApartIsOpen() {
        constexpr double gap = 0.02; // [m]
        for (const double closing : {0.5 * gap / test::duration, 2 * gap / test::duration}) {
            Two two(cuboid({1, 1, 1}, 1, {0, 0, 0}), cuboid({1, 1, 1}, 1, {0, 1 + gap, 0}));
            two.state.velocity[1] = Vec3(0, -closing, 0);
            QVERIFY(closeManifold(two.input, margin, two.manifold));
            QVERIFY(two.manifold.count > 0);
            openIfApart(two.input, two.manifold);
            QCOMPARE(two.manifold.open, closing * test::duration < gap);
            if (two.manifold.open) QVERIFY(std::abs(two.manifold.gap - gap) < roundingOfPlaces);
        }
    }
};

} // namespace carom

CAROM_TEST(manifolds_test, carom::ManifoldsTest)
#include "manifolds_test.moc"
