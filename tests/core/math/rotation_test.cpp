// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/math/random.h"
#include "core/math/rotation.h"

#include <QObject>
#include <QTest>

#include <cmath>
#include <numbers>

namespace {

using carom::Quat;
using carom::Random;
using carom::Vec3;

constexpr int samples = 2000;
constexpr std::uint64_t rotationSeed = 20261121;
// A few roundings of numbers up to 1.
constexpr double roundings = 2e-15;

Vec3 direction(Random& random) {
    const double x = random.gaussian();
    const double y = random.gaussian();
    const double z = random.gaussian();
    return Vec3(x, y, z).normalized();
}

class RotationTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aRotationVectorTurnsByItsLengthAboutItself() {
        const Quat quarter = carom::fromRotationVector(Vec3(0, 0, std::numbers::pi / 2));
        QVERIFY((quarter * Vec3::UnitX() - Vec3::UnitY()).norm() <= roundings);
        QVERIFY((quarter * Vec3::UnitZ() - Vec3::UnitZ()).norm() <= roundings);
    }

    void noRotationIsExact() {
        QVERIFY(carom::fromRotationVector(Vec3::Zero()).coeffs() == Quat::Identity().coeffs());
        QVERIFY(carom::toRotationVector(Quat::Identity()) == Vec3::Zero());
    }

    void theSeriesNearZeroMeetsTheSine() {
        for (const double angle : {1e-300, 1e-12, 1e-6, 9.999e-3, 1.0001e-2, 0.1}) {
            const Quat q = carom::fromRotationVector(Vec3(angle, 0, 0));
            QVERIFY(std::abs(q.x() - std::sin(angle / 2)) <= 2e-16 * angle);
            QVERIFY(std::abs(q.norm() - 1) <= roundings);
        }
    }

    void rotationVectorsComeBackFromTheirQuaternions() {
        Random random(rotationSeed);
        for (int i = 0; i < samples; ++i) {
            const Vec3 v = direction(random) * random.uniform(0, 3.14);
            const Vec3 back = carom::toRotationVector(carom::fromRotationVector(v));
            QVERIFY2((back - v).norm() <= 4 * roundings,
                     qPrintable(QStringLiteral("seed %1, sample %2").arg(rotationSeed).arg(i)));
        }
    }

    void aQuaternionAndItsNegativeAreOneRotation() {
        Random random(rotationSeed, 1);
        for (int i = 0; i < samples; ++i) {
            const Quat q = carom::fromRotationVector(direction(random) * random.uniform(0, 3.0));
            const Quat negative(-q.w(), -q.x(), -q.y(), -q.z());
            QVERIFY((carom::toRotationVector(q) - carom::toRotationVector(negative)).norm() <= roundings);
        }
    }

    void theShortestRotationTakesOneDirectionToTheOther() {
        Random random(rotationSeed, 2);
        for (int i = 0; i < samples; ++i) {
            const Vec3 from = direction(random);
            const Vec3 to = direction(random);
            const Quat q = carom::shortestRotation(from, to);
            QVERIFY2((q * from - to).norm() <= roundings,
                     qPrintable(QStringLiteral("seed %1, sample %2").arg(rotationSeed).arg(i)));
            const double angle = carom::toRotationVector(q).norm();
            QVERIFY(std::abs(angle - std::atan2(from.cross(to).norm(), from.dot(to))) <= 4 * roundings);
        }
    }

    void nearlyOppositeDirectionsAreTurnedAsExactly() {
        // 1 + cos loses all digits here: with it the result was off by the whole deviation, 1e-8.
        Random random(rotationSeed, 3);
        for (int i = 0; i < samples; ++i) {
            const Vec3 from = direction(random);
            const double deviation = std::pow(10.0, -random.uniform(0, 17));
            const Vec3 to = (-from + deviation * carom::tangentsOf(from).first).normalized();
            const Quat q = carom::shortestRotation(from, to);
            QVERIFY2((q * from - to).norm() <= roundings,
                     qPrintable(QStringLiteral("seed %1, sample %2").arg(rotationSeed).arg(i)));
            QVERIFY(std::abs(q.norm() - 1) <= roundings);
        }
    }

    void oppositeDirectionsAreTurnedByHalfATurn() {
        for (const Vec3& from :
             {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY()), Vec3(Vec3::UnitZ()), Vec3(0.6, 0.8, 0)})
            QVERIFY((carom::shortestRotation(from, -from) * from + from).norm() <= roundings);
    }

    void tangentsMakeARightHandedFrame() {
        Random random(rotationSeed, 4);
        for (int i = 0; i < samples; ++i) {
            const Vec3 n = direction(random);
            const carom::Tangents tangents = carom::tangentsOf(n);
            QVERIFY(std::abs(n.dot(tangents.first)) <= roundings);
            QVERIFY(std::abs(tangents.first.norm() - 1) <= roundings);
            QVERIFY((n.cross(tangents.first) - tangents.second).norm() <= roundings);
        }
    }
};

} // namespace

CAROM_TEST(rotation_test, RotationTest)
#include "rotation_test.moc"
