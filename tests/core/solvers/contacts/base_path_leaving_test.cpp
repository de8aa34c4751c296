// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/core/solvers/contacts/entered.h"
#include "tests/support/constants.h"
#include "tests/support/contact_scenes.h"
#include "tests/support/random_scene.h"
#include "tests/support/scenes.h"
#include "tests/support/test_class.h"

#include "core/solvers/contacts/base_path.h"

#include <QTest>

#include <cmath>
#include <cstdint>
#include <vector>

// Islands that leave the base path one by one.

namespace carom {
namespace {

using test::Entered;

struct Clusters {
    Scene scene;
    std::vector<std::vector<BodyIndex>> lists; // of bodies, far from each other
};

/// Balls in a row or upon each other, and single cuboids.
Clusters clustersOnAFloor(Random& random, std::size_t count) {
    Clusters clusters{test::sceneOf({test::floorOf(0.5)}, test::downwards()), {}};
    for (std::size_t k = 0; k < count; ++k) {
        std::vector<BodyIndex>& list = clusters.lists.emplace_back();
        const double x = 10.0 * static_cast<double>(k);
        const bool isRow = random.below(2) == 0, isCuboid = random.below(4) == 0;
        const std::size_t bodies = isCuboid ? 1 : 1 + random.below(5);
        for (std::size_t n = 0; n < bodies; ++n) {
            const double at = (isRow ? 0.22 : 0.2) * static_cast<double>(n);
            const Vec3 place = isRow ? Vec3(x + at, 0.1, 0) : Vec3(x, 0.1 + at, 0);
            Body body = test::rough(
                isCuboid ? test::cuboid({0.2, 0.2, 0.2}, 1, place) : test::sphere(0.1, 1, place), 0.5);
            body.velocity = 0.02 * Vec3(random.uniform(-1, 1), 0, random.uniform(-1, 1));
            list.push_back(static_cast<BodyIndex>(clusters.scene.bodies.size()));
            clusters.scene.bodies.push_back(body);
        }
    }
    return clusters;
}

} // namespace

class BasePathLeavingTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    // A body that is struck comes as far as what strikes it in that substep, and then has a new reach: whom
    // it strikes in turn, in the same substep or later, is not passed.
    void whoIsStruckPassesNobody() {
        constexpr double radius = 0.1, speed = 30; // [m], [m/s]; an eighth of a metre a substep
        Scene scene = test::sceneOf({}, Vec3::Zero());
        for (const double x : {0.0, 0.27, 0.49, 1.5}) {
            scene.bodies.push_back(test::sphere(radius, 1, {x, 0, 0}));
            scene.bodies.back().elastic = 1;
        }
        scene.bodies[0].velocity.x() = speed;
        for (int k = 0; k < 4; ++k) scene.bodies.push_back(test::sphere(radius, 1, {0.4 * k, 0, 2}));
        Entered entered(scene);
        entered.enterAll();
        for (int n = 0; n < 24; ++n) {
            entered.step();
            for (BodyIndex i = 1; i < 4; ++i)
                QVERIFY(entered.state.pose[i].position.x() - entered.state.pose[i - 1].position.x() >
                        1.98 * radius);
        }
        for (BodyIndex i = 0; i < 3; ++i) QVERIFY(entered.state.velocity[i].norm() < 1e-3 * speed);
        QVERIFY(std::abs(entered.state.velocity[3].x() - speed) < 1e-3 * speed);
        for (BodyIndex i = 4; i < 8; ++i) QVERIFY(entered.state.velocity[i] == Vec3::Zero());
    }

    // Clusters that know nothing of each other: some leave and enter again, the others do not notice.
    void islandsThatLeaveChangeNothingForTheOthers() {
        Random random(test::seed, 5);
        int left = 0, stayed = 0;
        for (int trial = 0; trial < 20; ++trial) {
            const Clusters clusters = clustersOnAFloor(random, 12);
            Entered all(clusters.scene), some(clusters.scene);
            std::vector<std::uint8_t> hasLeft(clusters.lists.size(), 0);
            for (Entered* entered : {&all, &some}) entered->enterAll();
            for (int n = 0; n < 40; ++n) {
                const std::size_t which = random.below(clusters.lists.size());
                for (const BodyIndex body : clusters.lists[which]) some.path.mark(body);
                const std::vector<BodyIndex> gone = some.leaveMarked();
                QCOMPARE(gone, clusters.lists[which]);
                for (const BodyIndex body : gone) QVERIFY(!some.path.has(body));
                some.enter(gone);
                hasLeft[which] = 1;
                if (!all.renew() || !some.renew()) break;
                all.advance();
                some.advance();
                for (std::size_t k = 0; k < clusters.lists.size(); ++k) {
                    if (hasLeft[k] != 0) {
                        ++left;
                        continue;
                    }
                    ++stayed;
                    for (const BodyIndex body : clusters.lists[k]) {
                        QVERIFY(all.state.velocity[body] == some.state.velocity[body]);
                        QVERIFY(all.state.angularVelocity[body] == some.state.angularVelocity[body]);
                        QVERIFY(all.state.pose[body].position == some.state.pose[body].position);
                        QVERIFY(all.state.pose[body].orientation.coeffs() ==
                                some.state.pose[body].orientation.coeffs());
                    }
                }
            }
            QCOMPARE(some.path.islands(), all.path.islands());
            for (BodyIndex i = 1; i < all.bodies.count(); ++i) // who left has gone on nearly as the others
                QVERIFY((all.state.pose[i].position - some.state.pose[i].position).norm() < 1e-3);
        }
        qInfo("compared %d times with those that left, %d with those that stayed", left, stayed);
        QVERIFY(left > 100 && stayed > 1000);
    }

    // With each division contacts are another spring: what left goes on with the one it had, whatever its
    // contacts would ask for now.
    void islandThatLeftKeepsItsDivision() {
        const Scene scene = test::sceneOf({test::floorOf(0.5), test::cuboid({0.2, 0.2, 0.2}, 1, {0, 0.1, 0})},
                                          test::downwards());
        Entered entered(scene);
        const ContactCount few{4, false}, many{1000, false};
        const std::vector<BodyIndex> cube{1};
        const Island island{cube, {}, {}};
        const int looks = BasePath::divisionFor(few, 1).looks;
        QVERIFY(looks > BasePath::divisionFor(many, 1).looks);
        QCOMPARE(entered.path.divisionFor(island, many).looks, BasePath::divisionFor(many, 1).looks);
        entered.enterAll();
        entered.advance();
        entered.path.mark(1);
        QCOMPARE(entered.leaveMarked(), cube);
        QCOMPARE(entered.path.divisionFor(island, many).looks, looks);
    }

    // Balls roll past posts for a long time, and none leaves. Each pair that they had come to left its place
    // in a list behind.
    void pairsThatAreGoneTakeNoMemory() {
        constexpr int posts = 120, balls = 8;
        Scene scene = test::sceneOf({test::floorOf(0.5)}, test::downwards());
        for (int n = 0; n < balls; ++n) {
            Body ball = test::sphere(0.1, 1, {0.02 * n, 0.1, 1.0 * n}, {3, 0, 0});
            ball.angularVelocity = {0, 0, -30};
            scene.bodies.push_back(test::rough(ball, 0.5, 0, n % 2 == 0 ? 1e-6 : 0));
        }
        for (int n = 0; n < posts * balls; ++n) {
            Body post = test::cuboid({0.05, 0.2, 0.05}, 1, {0.3 * (n / balls), 0.1, n % balls + 0.13});
            post.fixed = true;
            scene.bodies.push_back(post);
        }
        Entered entered(scene);
        std::size_t early = 0;
        for (int n = 0; n < 2400; ++n) {
            entered.step(n % test::substeps == 0);
            if (n == 240) early = entered.path.bytes();
        }
        QCOMPARE(entered.renewals, 0);
        for (BodyIndex i = 1; i <= balls; ++i) QVERIFY(entered.state.pose[i].position.x() > 25);
        QVERIFY2(entered.path.bytes() <= early + 1000,
                 qPrintable(QStringLiteral("%1 and %2 bytes").arg(early).arg(entered.path.bytes())));
    }

    // Single balls on a floor that come and go one by one leave no empty places behind.
    void whoEntersTakesThePlaceOfWhoLeft() {
        Scene scene = test::sceneOf({test::floorOf(0.5)}, test::downwards());
        for (int n = 0; n < 50; ++n) scene.bodies.push_back(test::sphere(0.1, 1, {n * 1.0, 0.1, 0}));
        Entered entered(scene);
        entered.enterAll();
        entered.advance();
        const std::size_t bytes = entered.path.bytes();
        Random random(test::seed, 6);
        for (int n = 0; n < 500; ++n) {
            entered.path.mark(static_cast<BodyIndex>(1 + random.below(50)));
            entered.enter(entered.leaveMarked());
            QCOMPARE(entered.path.islands(), 50U);
        }
        QVERIFY(entered.path.bytes() <= bytes + 1000);
        QVERIFY(entered.renew());
        entered.advance();
        for (BodyIndex i = 1; i <= 50; ++i)
            QVERIFY(std::abs(entered.forceOf({0, i}).y() / test::gravity - 1) < 0.05);
    }
};

} // namespace carom

CAROM_TEST(base_path_leaving_test, carom::BasePathLeavingTest)
#include "base_path_leaving_test.moc"
