// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/gas.h"
#include "core/study/gas_report.h"

#include "tests/support/scenes.h"
#include "tests/support/test_class.h"
#include "tests/support/worlds.h"

#include "core/math/random.h"

#include <QTest>

#include <algorithm>
#include <cmath>

// Gases of the exact method against the kinetic theory: hard cases 46 to 49 in short. The motion is the same
// to the bit each time, so a limit of three standard errors does not fail by chance once it has held.

namespace carom {
namespace {

const GasListener alwaysOn = [](std::int64_t, std::int64_t) { return true; };

/// Balls of unit mass on a lattice in a box, with normal velocities.
Scene gas(int across, double spacing, double diameter, std::uint64_t seed, const Vec3& gravity) {
    Scene scene = test::sceneOf({}, gravity);
    const double edge = across * spacing;
    for (int axis = 0; axis < 3; ++axis) {
        scene.bodies.push_back(test::wall(Vec3::Unit(axis), 0));
        if (gravity.isZero(0) || axis != 1) scene.bodies.push_back(test::wall(-Vec3::Unit(axis), -edge));
    }
    Random random(seed);
    for (int i = 0; i < across * across * across; ++i) {
        const Vec3 cell(i % across, i / across % across, i / (across * across));
        scene.bodies.push_back(test::sphere(diameter / 2, 1, (cell + Vec3::Constant(0.5)) * spacing,
                                            {random.gaussian(), random.gaussian(), random.gaussian()}));
    }
    return scene;
}

QByteArray shown(const GasStudy& study) { return QByteArray::fromStdString(summaryOf(study)); }

} // namespace

class GasTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void theoryGivesThePublishedFigures() {
        // Hard case 48: n = 0.5, σ = m = kT = 1.
        const double packing = theory::packingOf(0.5, 1);
        QVERIFY(std::abs(theory::compressibilityOf(packing) - 3.262431) < 5e-7);
        QVERIFY(std::abs(theory::freeTimeOf(0.5, 1, 1, 1) - 0.1306) < 5e-5);
        QCOMPARE(theory::compressibilityOf(0), 1.0);
    }

    // Hard cases 46 and 48, short.
    void aDenseGasHasThePressureAndTheFreeTimeOfTheory() {
        const Pipeline pipeline(gas(9, 1.31, 1, 5, Vec3::Zero()));
        GasPlan plan;
        plan.settling = 20;
        plan.measuring = 60;
        const GasStudy study = studyGas(pipeline, plan, alwaysOn);
        QVERIFY(study.complete);
        QVERIFY(std::abs(study.energyDrift) < 1e-12);
        QVERIFY2(study.compressibility && study.wallCompressibility && study.freeTime,
                 shown(study).constData());
        for (const GasEstimate& estimate :
             {*study.compressibility, *study.wallCompressibility, *study.freeTime}) {
            QVERIFY2(std::abs(estimate.value - estimate.theory) < 1.5 * estimate.uncertainty,
                     shown(study).constData());
            QVERIFY2(estimate.uncertainty < 0.12 * estimate.theory, shown(study).constData());
        }
    }

    // Hard case 47, short: of gases that have forgotten their lattice, about one in a hundred fails.
    void speedsBecomeMaxwells() {
        constexpr int seeds = 40, failuresAtMost = 3; // of 40 · 0.01 expected
        int failures = 0;
        for (int seed = 1; seed <= seeds; ++seed) {
            GasPlan plan;
            plan.measuring = 2;
            plan.batches = 2;
            Scene scene = gas(5, 1.6, 1, static_cast<std::uint64_t>(seed), Vec3::Zero());
            for (Body& body : scene.bodies) // all equally fast: as far from Maxwell as can be
                if (body.mobile()) body.velocity.normalize();
            const GasStudy study = studyGas(Pipeline(scene), plan, alwaysOn);
            if (study.speedProbability < 0.01) {
                ++failures;
                qInfo("seed %d: p = %g", seed, study.speedProbability);
            }
        }
        QVERIFY2(failures <= failuresAtMost, qPrintable(QString::number(failures)));
    }

    void speedsThatAreNotMaxwellsAreSeen() {
        Scene scene = gas(7, 5, 0.01, 1, Vec3::Zero());
        for (Body& body : scene.bodies)
            if (body.mobile()) body.velocity.normalize();
        GasPlan plan;
        plan.settling = 0;
        plan.measuring = 0.001;
        plan.batches = 2;
        const GasStudy study = studyGas(Pipeline(scene), plan, alwaysOn);
        QVERIFY2(study.speedProbability < 1e-6, shown(study).constData());
    }

    // Hard case 49, short.
    void aThinGasUnderGravityHasTheBarometricProfile() {
        Scene scene = gas(8, 2, 0.05, 3, Vec3(0, -0.2, 0));
        GasPlan plan;
        plan.settling = 5;
        plan.measuring = 5;
        plan.batches = 10;
        const GasStudy study = studyGas(Pipeline(scene), plan, alwaysOn);
        QVERIFY2(study.heightProbability > 0.01, shown(study).constData());
        for (const HeightBin& layer : study.heights)
            QVERIFY2(std::abs(layer.temperature.value - 1) < 0.15, shown(study).constData());
    }

    void whatIsNoGasIsNamedWithItsPlace() {
        Scene scene = gas(3, 2, 1, 1, Vec3::Zero());
        QVERIFY(!gasObjection(Pipeline(scene)));
        scene.bodies.back().elastic = 0.9;
        scene.bodies.back().source.type = {77, 6};
        const std::optional<GasObjection> objection = gasObjection(Pipeline(scene));
        QVERIFY(objection && objection->place == (SourceRange{77, 6}));
        for (Body& body : scene.bodies) body.velocity = Vec3::Zero();
        QVERIFY(gasObjection(Pipeline(scene)));
    }

    void aStudyThatIsStoppedKeepsItsBatches() {
        int calls = 0;
        GasPlan plan;
        plan.settling = 2;
        const GasStudy study = studyGas(Pipeline(gas(5, 1.5, 1, 1, Vec3::Zero())), plan,
                                        [&calls](std::int64_t, std::int64_t) { return ++calls < 300; });
        QVERIFY(!study.complete);
        QVERIFY(study.batches > 0 && study.batches < plan.batches);
        QVERIFY(study.compressibility.has_value());
        QVERIFY(summaryOf(study).find("stopped early") != std::string::npos);
        const std::string csv = figuresAsCsv(study, {"carom study gas", "1", "here"});
        QVERIFY(csv.starts_with("figure,value,uncertainty,theory,unit,command,version,machine\nballs,125,"));
    }
};

} // namespace carom

CAROM_TEST(gas_test, carom::GasTest)
#include "gas_test.moc"
