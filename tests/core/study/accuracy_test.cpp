// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"
#include "tests/support/worlds.h"

#include "core/integrators/integrator.h"
#include "core/math/rotation.h"
#include "core/simulation/build.h"
#include "core/study/accuracy_csv.h"
#include "core/study/accuracy_report.h"
#include "core/study/benchmark.h"
#include "core/study/closed_motion.h"

#include <QTest>

#include <algorithm>
#include <cmath>

// The accuracy study: orders on scenes with a closed form, what it keeps, and what it says.

namespace carom {
namespace {

using namespace test;

/// The order measured may be off by this: the next term of the error is still there.
constexpr double orderTolerance = 0.1;
/// What remains of a scheme that is exact: rounding of some thousand steps, each 2e-16 of the scene's size.
constexpr double exact = 1e-11;

Scene parsed(const char* text) { return build(text).pipeline->scene(); }

Scene thrown() { return parsed("sphere { radius 0.1 mass 1 centre 0, 0, 0 vel 3, 4, 1 }"); }
Scene oscillating() {
    return parsed("gravity { accel 0, -9.81, 0 }\n"
                  "sphere bob { radius 0.1 mass 1 centre 0, 0.8, 0 }\n"
                  "spring { from world to bob fromAt 0, 2, 0 stiffness 100 length 1 }");
}
Scene tumbling() {
    return parsed("gravity { accel 0, 0, 0 }\n"
                  "cuboid { size 0.2, 0.4, 0.6 mass 1 centre 0, 0, 0 angvel 1, 2, 3 }");
}
Scene bouncing() {
    return parsed("wall { normal 0, 1, 0 toOrig 0 }\n"
                  "sphere { radius 0.1 mass 1 centre 0, 1, 0 vel 0.5, 0, 0 }");
}

AccuracyPlan quickPlan(const Scene& scene, std::vector<double> substeps, double duration) {
    AccuracyPlan plan = planFor(scene);
    vary(plan, substeps, {});
    plan.duration = duration;
    plan.runs = 1;
    return plan;
}

AccuracyStudy studied(const Scene& scene, const AccuracyPlan& plan,
                      const std::vector<AccuracyPoint>& known = {}) {
    AccuracyListener listener;
    listener.goOn = [](double) { return true; };
    return runAccuracy(scene, plan, listener, known);
}

QString q(const std::string& text) { return QString::fromStdString(text); }

} // namespace

class AccuracyTest : public QObject {
    Q_OBJECT

  private:
    void expectOrders(const Scene& scene, ReferenceKind kind) {
        const AccuracyStudy study = studied(scene, quickPlan(scene, {8, 16, 32, 64, 128}, 1));
        QVERIFY(study.complete);
        QCOMPARE(study.reference->kind, kind);
        for (const AccuracyFamily& family : familiesOf(study)) {
            const AccuracySetting& setting = family.points.front()->setting;
            // The reference's method leaves the inertia of free bodies out: it converges to another motion.
            if (!setting.method->abilities.gyroscopicTerm && study.points.front().energy.worst == 0) continue;
            const std::optional<double> order = orderOf(family, study.resolution());
            const double finest = family.points.back()->errors.worst();
            const QString told = QStringLiteral("%1: order %2, error %3")
                                     .arg(q(family.name))
                                     .arg(order.value_or(-1))
                                     .arg(finest);
            if (finest < exact) continue;
            QVERIFY2(order && std::abs(*order - setting.integrator->order) < orderTolerance,
                     qPrintable(told));
        }
    }

  private Q_SLOTS:
    void aThrownBallShowsTheOrderOfEverySchemeOrNoErrorAtAll() {
        expectOrders(thrown(), ReferenceKind::ClosedForm);
    }

    void anOscillationShowsTheOrderOfEveryScheme() { expectOrders(oscillating(), ReferenceKind::ClosedForm); }

    void aTumblingCuboidShowsTheOrderOfEveryScheme() {
        const Scene scene = tumbling();
        AccuracyPlan plan = quickPlan(scene, {1, 2, 4, 8}, 1);
        std::erase_if(plan.settings, [](const AccuracySetting& s) { return s.method->name != "contacts"; });
        const AccuracyStudy study = studied(scene, plan);
        int shown = 0;
        for (const AccuracyFamily& family : familiesOf(study)) {
            const AccuracySetting& setting = family.points.front()->setting;
            if (setting.method->name != "contacts" || family.points.size() < 3) continue;
            if (setting.integrator->name == "midpoint") {
                QVERIFY(family.points.back()->errors.worst() < exact);
                continue;
            }
            const std::optional<double> order = orderOf(family, study.resolution());
            QVERIFY2(order && std::abs(*order - setting.integrator->order) < orderTolerance,
                     qPrintable(q(family.name) + QString::number(order.value_or(-1))));
            ++shown;
        }
        QCOMPARE(shown, 4);
    }

    void theClosedFormOfAnOscillationIsWhatAFineRunArrivesAt() {
        constexpr double close = 1e-9; // order four at 2048 substeps
        SimulationSettings options;
        options.method = "contacts";
        options.integrator = "rk4";
        options.substeps = 256;
        const auto pipeline = std::make_shared<const Pipeline>(oscillating(), options);
        const std::optional<ClosedMotion> motion = closedMotionOf(*pipeline);
        QVERIFY(motion);
        World world(pipeline);
        test::run(world, 60);
        QVERIFY((motion->at(world.state().time)[0].position - world.state().pose[0].position).norm() < close);
        QVERIFY(!closedMotionOf(Pipeline(bouncing())));
    }

    void ballsBetweenWallsAreHeldAgainstExactEvents() {
        const Scene scene = bouncing();
        const AccuracyStudy study = studied(scene, quickPlan(scene, {1, 4}, 1));
        QCOMPARE(study.reference->kind, ReferenceKind::ExactEvents);
        for (const AccuracyPoint& point : study.points) {
            if (point.setting.method->name == "events") QVERIFY(point.errors.worst() < exact);
            if (point.setting.method->name == "microcollisions") QVERIFY(point.errors.worst() > 1e-4);
        }
        QVERIFY(study.conservative);
        QVERIFY(!recommendation(study).empty());
    }

    void whatHasNoClosedFormIsHeldAgainstAConvergedRunThatKnowsItsOwnError() {
        const Scene scene = parsed("wall { normal 0, 1, 0 toOrig 0 friction 0.5 }\n"
                                   "sphere { radius 0.1 mass 1 centre 0, 0.1, 0 vel 1, 0, 0 friction 0.5 }");
        const AccuracyStudy study = studied(scene, quickPlan(scene, {1, 2}, 0.5));
        QCOMPARE(study.reference->kind, ReferenceKind::ConvergedRun);
        QVERIFY(study.reference->error > 0 && study.reference->error < 1e-3);
        QVERIFY(q(yardstickOf(study)).contains(q(study.reference->description)));
    }

    void aGasIsChaoticAndItsErrorsEndAtTheHorizon() {
        const GeneratorRow& gas = *findGenerator("brownian");
        const Scene scene = build(generate(gas, requestFor(gas, 60))).pipeline->scene();
        AccuracyPlan plan = quickPlan(scene, {1}, 4);
        plan.settings.resize(1);
        const AccuracyStudy study = studied(scene, plan);
        qInfo("%s", yardstickOf(study).c_str());
        QVERIFY(study.reference->chaotic);
        QVERIFY(study.reference->horizon > 0 && study.reference->horizon < 4);
        QVERIFY(study.reference->growth > 0);
    }

    void whatBlowsUpStaysAmongThePoints() {
        const Scene scene = parsed("sphere bob { radius 0.1 mass 1 centre 0, 0.8, 0 }\n"
                                   "spring { from world to bob fromAt 0, 2, 0 stiffness 4000000 length 1 }");
        const AccuracyStudy study = studied(scene, quickPlan(scene, {1, 2}, 2));
        const auto bad = std::find_if(study.points.begin(), study.points.end(), [](const AccuracyPoint& p) {
            return p.setting.integrator->name == "verlet" && !p.usable();
        });
        QVERIFY(bad != study.points.end());
        QVERIFY(!bad->reason.empty());
        for (const AccuracyPoint* point : paretoFront(study)) QVERIFY(point->usable());
    }

    void theFrontHoldsWhatNothingBeats() {
        const Scene scene = oscillating();
        const AccuracyStudy study = studied(scene, quickPlan(scene, {1, 2, 4, 8}, 0.5));
        const std::vector<const AccuracyPoint*> front = paretoFront(study);
        QVERIFY(!front.empty());
        for (const AccuracyPoint* point : front)
            for (const AccuracyPoint& other : study.points)
                QVERIFY(!(other.usable() && other.errors.worst() < point->errors.worst() &&
                          other.cost() < point->cost()));
        const AccuracyPoint* cheapest = cheapestWithin(study, 1);
        QVERIFY(cheapest != nullptr);
        QVERIFY(cheapestWithin(study, 0) == nullptr);
    }

    void figuresReadBackAndAreNotMeasuredAgain() {
        const Scene scene = oscillating();
        const AccuracyPlan plan = quickPlan(scene, {1, 2}, 0.25);
        AccuracyStudy first = studied(scene, plan);
        for (AccuracyPoint& point : first.points) point.times = {12345};
        const std::string csv = pointsAsCsv(first, "77", {"carom \"x\", y", "1", "a machine, fast"});
        const KnownPoints read = pointsFromCsv(csv, {"77", 0.25, "1"});
        QCOMPARE(read.objection, std::string());
        const std::vector<AccuracyPoint>& known = read.points;
        QCOMPARE(known.size(), first.points.size());
        const AccuracyStudy second = studied(scene, plan, known);
        QCOMPARE(second.points.size(), first.points.size());
        for (std::size_t k = 0; k < second.points.size(); ++k) {
            QCOMPARE(second.points[k].times, std::vector<double>{12345});
            QCOMPARE(second.points[k].errors.position, first.points[k].errors.position);
        }
    }

    void figuresOfAnotherStudyAreRefusedAndSoAreThoseThatCannotBeRead() {
        const Scene scene = oscillating();
        const AccuracyStudy study = studied(scene, quickPlan(scene, {1, 2}, 0.25));
        const std::string csv = pointsAsCsv(study, "77", {"carom", "1", "a machine"});
        const auto objection = [](const std::string& text, const AccuracyOrigin& origin) {
            const KnownPoints known = pointsFromCsv(text, origin);
            return known.points.empty() ? q(known.objection)
                                        : QStringLiteral("points in spite of an objection");
        };
        QVERIFY(objection(csv, {"78", 0.25, "1"}).contains(QStringLiteral("another scene")));
        QCOMPARE(objection(csv, {"77", 0.5, "1"}), QStringLiteral("it is of 0.25 s, not of 0.5 s"));
        QVERIFY(objection(csv, {"77", 0.25, "2"}).contains(QStringLiteral("measured by version 1")));
        QVERIFY(objection("a,b\n1,2\n", {"77", 0.25, "1"}).contains(QStringLiteral("columns")));
        QVERIFY(objection("", {"77", 0.25, "1"}).contains(QStringLiteral("columns")));
        std::string spoilt = csv;
        spoilt.replace(csv.rfind("contacts"), 8, "comtacts");
        QVERIFY(objection(spoilt, {"77", 0.25, "1"}).contains(QStringLiteral("cannot be read")));
        QVERIFY(objection(csv + "half a li", {"77", 0.25, "1"}).contains(QStringLiteral("cannot be read")));
    }

    void aStudyToldToStopKeepsWhatItHas() {
        const Scene scene = oscillating();
        AccuracyListener listener;
        int measured = 0;
        listener.changed = [&](const AccuracyStudy&) { ++measured; };
        listener.goOn = [&](double done) { return done >= 0 && measured < 3; };
        const AccuracyStudy study = runAccuracy(scene, quickPlan(scene, {1, 2}, 0.25), listener);
        QVERIFY(!study.complete);
        QCOMPARE(study.points.size(), std::size_t(3));
        QVERIFY(q(summaryOf(study)).contains(QStringLiteral("interrupted")));
    }
};

} // namespace carom

CAROM_TEST_WITH(QCoreApplication, accuracy_test, carom::AccuracyTest)
#include "accuracy_test.moc"
