// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/test_class.h"

#include "core/math/random.h"
#include "core/solvers/joint_impulses.h"

#include <QTest>

// The impulses of contacts that act together: W p = c, refused where they would pull or W tells nothing.

namespace carom {
namespace {

/// Of p, relative, with responses whose condition is below a few thousand.
constexpr double rounding = 1e-12;

/// Positive definite: of contacts that share bodies with each other, each with some mass of its own.
JointResponse anyResponse(Random& random, int contacts) {
    JointResponse root(contacts, contacts);
    for (double& entry : root.reshaped()) entry = random.uniform(-1, 1);
    JointResponse response = root * root.transpose();
    response.diagonal().array() += 0.1;
    return response;
}

JointValues anyImpulses(Random& random, int contacts) {
    JointValues impulses(contacts);
    for (double& impulse : impulses) impulse = random.uniform(0.1, 2);
    return impulses;
}

} // namespace

class JointImpulsesTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void oneContactTakesItsChangeOverItsResponse() {
        JointValues impulses;
        QVERIFY(jointImpulses(JointResponse::Constant(1, 1, 4), JointValues::Constant(1, 3), impulses));
        QCOMPARE(impulses.size(), Eigen::Index{1});
        QCOMPARE(impulses[0], 0.75);
        QVERIFY(!jointImpulses(JointResponse::Constant(1, 1, 4), JointValues::Constant(1, -3), impulses));
    }

    void impulsesMakeTheWantedChanges() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 61);
        for (int contacts = 2; contacts <= mostJointContacts; ++contacts)
            for (int trial = 0; trial < 50; ++trial) {
                const JointResponse response = anyResponse(random, contacts);
                const JointValues wanted = anyImpulses(random, contacts);
                JointValues impulses;
                QVERIFY(jointImpulses(response, response * wanted, impulses));
                QVERIFY((impulses - wanted).norm() <= rounding * wanted.norm());
            }
    }

    void mirrorImagesHaveMirroredBits() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 62);
        for (int trial = 0; trial < 200; ++trial) {
            const int contacts = 2 + static_cast<int>(random.below(mostJointContacts - 1));
            const JointResponse response = anyResponse(random, contacts);
            const JointValues changes = response * anyImpulses(random, contacts);
            JointValues impulses, mirrored;
            QVERIFY(jointImpulses(response, changes, impulses));
            QVERIFY(jointImpulses(response.reverse(), changes.reverse(), mirrored));
            QVERIFY(mirrored.reverse() == impulses);
        }
    }

    void whatWouldPullIsRefused() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 63);
        for (int trial = 0; trial < 200; ++trial) {
            const int contacts = 2 + static_cast<int>(random.below(mostJointContacts - 1));
            const JointResponse response = anyResponse(random, contacts);
            JointValues wanted = anyImpulses(random, contacts), impulses;
            wanted[static_cast<Eigen::Index>(random.below(static_cast<std::uint64_t>(contacts)))] *= -0.1;
            QVERIFY(!jointImpulses(response, response * wanted, impulses));
        }
    }

    // A contact that is there twice: its pivot is 0, or what rounding leaves.
    void whatIsNotDeterminedIsRefused() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 64);
        for (int trial = 0; trial < 200; ++trial) {
            const int contacts = 2 + static_cast<int>(random.below(mostJointContacts - 1));
            JointResponse response = anyResponse(random, contacts);
            response.row(contacts - 1) = response.row(0).eval();
            response.col(contacts - 1) = response.col(0).eval();
            JointValues impulses;
            QVERIFY(!jointImpulses(response, response * anyImpulses(random, contacts), impulses));
        }
    }
};

} // namespace carom

CAROM_TEST(joint_impulses_test, carom::JointImpulsesTest)
#include "joint_impulses_test.moc"
