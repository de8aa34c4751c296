// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/core/solvers/contacts/two_bodies.h"
#include "tests/support/constants.h"
#include "tests/support/scenes.h"
#include "tests/support/test_class.h"

#include "core/math/random.h"
#include "core/solvers/contacts/manifold_forces.h"

#include <QTest>

#include <vector>

// Forces of a contact whose points are found anew: they stay where points stay, and what is left of them
// keeps the pair's force and moment.

namespace carom {
namespace {

using test::cuboid;
using test::Two;

/// Of force and moment, relative, after eight passes: the error of a square of points falls to a hundredth in
/// four, that of a rectangle somewhat less.
constexpr double sharedWithin = 4e-3;
constexpr double roundingOfForces = 1e-12; // [N], of some newtons

/// A cube of 1 m on another, with the points of the face between them in the frame of the upper one.
struct Stacked {
    Two two{cuboid({1, 1, 1}, 1, {0, 0.5, 0}), cuboid({1, 1, 1}, 1, {0, 1.5, 0})};
    Vec3 normal = Vec3::UnitY();

    static CarriedPoint pointAt(double x, double z, const Vec3& force = Vec3::Zero()) {
        return {.onA = Vec3(x, 0.5, z), .onB = Vec3(x, -0.5, z), .force = force};
    }
    /// The corners of a rectangle.
    static std::vector<CarriedPoint> corners(double x, double z) {
        return {pointAt(-x, -z), pointAt(x, -z), pointAt(x, z), pointAt(-x, z)};
    }
    void takeOver(const std::vector<CarriedPoint>& old, std::vector<CarriedPoint>& fresh) const {
        carom::takeOver(two.input, {0, 1}, old, normal, fresh);
    }
};

Vec3 sumOf(const std::vector<CarriedPoint>& points) {
    Vec3 sum = Vec3::Zero();
    for (const CarriedPoint& point : points) sum += point.force;
    return sum;
}

/// Of the normal forces, about the middle of B.
Vec3 momentOf(const std::vector<CarriedPoint>& points) {
    Vec3 moment = Vec3::Zero();
    for (const CarriedPoint& point : points)
        moment += point.onB.cross(point.force.y() * Vec3::UnitY().eval());
    return moment;
}

/// That push, and rub within what they push.
void giveForcesTo(std::vector<CarriedPoint>& points, Random& random) {
    for (CarriedPoint& point : points) {
        const double normal = random.uniform(0.5, 2), along = random.uniform(-0.3, 0.3);
        point.force = Vec3(along, normal, random.uniform(-0.3, 0.3));
    }
}

} // namespace

class ManifoldForcesTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aPointWithinATwentiethOfTheSizeKeepsItsForce() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 101);
        const Stacked stacked;
        for (int trial = 0; trial < 200; ++trial) {
            std::vector<CarriedPoint> old = Stacked::corners(0.5, 0.5);
            giveForcesTo(old, random);
            std::vector<CarriedPoint> fresh(old.rbegin(), old.rend()); // in another order
            for (CarriedPoint& point : fresh) {
                const double x = random.uniform(-0.03, 0.03), z = random.uniform(-0.03, 0.03);
                point.onA += Vec3(x, 0, z);
                point.onB += Vec3(x, 0, z);
                point.force.setZero();
            }
            stacked.takeOver(old, fresh);
            for (std::size_t k = 0; k < old.size(); ++k)
                QVERIFY(fresh[k].force == old[old.size() - 1 - k].force);
        }
    }

    void whatIsLeftKeepsForceAndMoment() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 102);
        const Stacked stacked;
        for (int trial = 0; trial < 200; ++trial) {
            std::vector<CarriedPoint> old = Stacked::corners(0.3, 0.3);
            giveForcesTo(old, random);
            // All of the new points lie beyond the old ones, so that there are forces for them that push.
            const double x = random.uniform(0.4, 0.5), z = random.uniform(0.4, 0.5);
            std::vector<CarriedPoint> fresh = Stacked::corners(x, z);
            stacked.takeOver(old, fresh);
            const double total = sumOf(old).norm();
            QVERIFY((sumOf(fresh) - sumOf(old)).norm() < sharedWithin * total);
            QVERIFY((momentOf(fresh) - momentOf(old)).norm() < sharedWithin * total);
            for (const CarriedPoint& point : fresh) QVERIFY(point.force.y() >= 0);
        }
    }

    void noPointPullsWhereTheForceWasOutsideTheNewOnes() {
        const Stacked stacked;
        const std::vector<CarriedPoint> old{Stacked::pointAt(0.4, 0, Vec3(0, 3, 0))};
        std::vector<CarriedPoint> fresh = Stacked::corners(0.2, 0.2);
        stacked.takeOver(old, fresh);
        for (const CarriedPoint& point : fresh) QVERIFY(point.force.y() >= 0);
        QVERIFY(fresh[1].force.y() > 1 && fresh[2].force.y() > 1); // those on that side
        QVERIFY(fresh[0].force.y() < 0.5 && fresh[3].force.y() < 0.5);
    }

    void aContactAtTheOtherEndBeginsWithoutForces() {
        const Stacked stacked;
        const Vec3 force(0.1, 2, 0);
        const std::vector<CarriedPoint> old{Stacked::pointAt(-0.4, -0.1, force),
                                            Stacked::pointAt(-0.4, 0.1, force)};
        std::vector<CarriedPoint> fresh{Stacked::pointAt(0.4, -0.1), Stacked::pointAt(0.4, 0.1)};
        stacked.takeOver(old, fresh);
        for (const CarriedPoint& point : fresh) QVERIFY(point.force == Vec3::Zero());
    }

    void thePointOfARoundBodyIsTheSameHoweverFarItHasRolled() {
        const Stacked stacked;
        const Vec3 force(0.1, 2, 0.3);
        const std::vector<CarriedPoint> old{Stacked::pointAt(-0.4, -0.1, force)};
        std::vector<CarriedPoint> fresh{Stacked::pointAt(0.4, 0.3)};
        stacked.takeOver(old, fresh);
        QVERIFY(fresh[0].force == force);
        std::vector<CarriedPoint> none{Stacked::pointAt(0.4, 0.3)};
        stacked.takeOver({}, none);
        QVERIFY(none[0].force == Vec3::Zero());
    }

    // Places are in the frames of the bodies, forces in the world.
    void sharingOutTurnsWithThePair() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 103);
        for (int trial = 0; trial < 50; ++trial) {
            std::vector<CarriedPoint> old = Stacked::corners(0.3, 0.3);
            giveForcesTo(old, random);
            std::vector<CarriedPoint> upright = Stacked::corners(0.45, 0.4), turned = upright;
            Stacked stacked;
            stacked.takeOver(old, upright);
            const Quat turn = fromRotationVector(uniformDirection(random));
            for (const BodyIndex i : {BodyIndex{0}, BodyIndex{1}}) {
                Pose& pose = stacked.two.state.pose[i];
                pose.position = turn * pose.position;
                pose.orientation = turn * pose.orientation;
            }
            stacked.normal = turn * stacked.normal;
            for (CarriedPoint& point : old) point.force = turn * point.force;
            stacked.takeOver(old, turned);
            for (std::size_t k = 0; k < turned.size(); ++k)
                QVERIFY((turned[k].force - turn * upright[k].force).norm() < roundingOfForces);
        }
    }
};

} // namespace carom

CAROM_TEST(manifold_forces_test, carom::ManifoldForcesTest)
#include "manifold_forces_test.moc"
