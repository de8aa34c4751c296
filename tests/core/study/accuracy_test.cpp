// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/accuracy_studies.h"
#include "tests/support/test_class.h"
#include "tests/support/program.h"
#include "tests/support/worlds.h"

#include "core/integrators/integrator.h"
#include "core/math/rotation.h"
#include "core/simulation/build.h"
#include "core/study/accuracy_csv.h"
#include "core/study/accuracy_report.h"
#include "core/study/accuracy_run.h"
#include "core/study/benchmark.h"
#include "core/study/closed_motion.h"
#include "core/study/measures.h"
#include "core/study/run_course.h"

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
            const std::optional<double> order = orderOf(family, study);
            const double finest = family.points.back()->errors.worst();
            const QString told = QStringLiteral("%1: order %2, error %3")
                                     .arg(q(family.name))
                                     .arg(order.value_or(-1))
                                     .arg(finest);
            if (finest < exact) continue;
            const int expected =
                scene.springs.empty() ? setting.integrator->order : setting.integrator->orderOnSprings;
            QVERIFY2(order && std::abs(*order - expected) < orderTolerance, qPrintable(told));
        }
    }

  private Q_SLOTS:
    void aThrownBallShowsTheOrderOfEverySchemeOrNoErrorAtAll() {
        expectOrders(thrown(), ReferenceKind::ClosedForm);
    }

    void anOscillationShowsTheOrderOfEveryScheme() { expectOrders(oscillating(), ReferenceKind::ClosedForm); }

    void aFreelyRotatingCuboidShowsTheOrderOfEveryScheme() {
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
            const std::optional<double> order = orderOf(family, study);
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
        QVERIFY(q(yardstickOf(study).text()).contains(q(study.reference->description.text())));
    }

    void aGasIsChaoticAndItsErrorsEndAtTheHorizon() {
        const GeneratorRow& gas = *findGenerator("brownian");
        const Scene scene = build(generate(gas, requestFor(gas, 60))).pipeline->scene();
        AccuracyPlan plan = quickPlan(scene, {1}, 4);
        plan.settings.resize(1);
        const AccuracyStudy study = studied(scene, plan);
        qInfo("%s", yardstickOf(study).text().c_str());
        QVERIFY(study.reference->chaotic);
        QVERIFY(study.reference->firstHorizon > 0 && study.reference->horizon < 4);
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

    void aSettingThatLetsBodiesOverlapIsNotCheaperAtTheSameError() {
        AccuracyStudy study;
        study.measure = findMeasure("trajectory");
        const auto add = [&study](int substeps, double error, double overlap, double cost) {
            AccuracyPoint point{.setting = {&generalSolver(), &integrators()[0], substeps, 0}};
            point.status = PointStatus::Measured;
            point.errors.position = error;
            point.penetration = overlap;
            point.times = {cost};
            study.points.push_back(point);
        };
        add(4, 1e-5, 1e-6, 10);
        study.points.front().isDefault = true;
        add(2, 1e-5, 0.6, 1);  // a tenth of the cost, and bodies within each other
        add(1, 1e-6, 1e-4, 5); // overlaps more than the scene's own does, but less than the target
        QVERIFY(!isNoWorseThanOwn(study, study.points[1]));
        QVERIFY(isNoWorseThanOwn(study, study.points[2]));
        QCOMPARE(distanceFromFront(study).value_or(0), 2.0);
        QCOMPARE(recommended(study), &study.points[2]);
        const QString sentence = q(recommendation(study).text());
        QVERIFY2(
            sentence.contains(QStringLiteral("2 times cheaper and no worse by any measure. By this measure "
                                             "alone, contacts, euler, 2 substeps would do at 1 ms; by "
                                             "`overlap` it errs by 0.6.")),
            qPrintable(sentence));
        study.points.resize(2); // better than nothing, where no other is accurate enough
        study.points.front().errors.position = 0.1;
        QCOMPARE(recommended(study), &study.points[1]);
    }

    void figuresReadBackAndAreNotMeasuredAgain() {
        const Scene scene = oscillating();
        const AccuracyPlan plan = quickPlan(scene, {1, 2}, 0.25);
        AccuracyStudy first = studied(scene, plan);
        for (AccuracyPoint& point : first.points) point.times = {12345};
        const std::string csv = pointsAsCsv(first, "77", {"carom \"x\", y", "1", "a machine, fast"});
        const ReadPoints read = pointsFromCsv(csv, {"77", 0.25, "1"});
        QCOMPARE(read.objection, std::string());
        QCOMPARE(read.known.points.size(), first.points.size());
        QCOMPARE(read.known.duration, 0.25);
        const AccuracyStudy second = studied(scene, plan, read.known);
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
            const ReadPoints read = pointsFromCsv(text, origin);
            return read.known.points.empty() ? q(read.objection)
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

    void aSceneAtRestGetsASentenceAndScalesThatDoNotVanish() {
        const Scene scene = resting();
        AccuracyPlan plan = quickPlan(scene, {1, 4}, 0.5);
        std::erase_if(plan.settings, [](const AccuracySetting& s) { return s.method->name != "contacts"; });
        const AccuracyStudy study = studiedByCount(scene, plan);
        QVERIFY(nothingMoves(study));
        QVERIFY2(recommendation(study).text().starts_with(
                     "Nothing moves: every setting holds; the cheapest costs "),
                 recommendation(study).text().c_str());
        for (const AccuracyPoint& point : study.points) {
            QCOMPARE(point.status, PointStatus::Measured);
            QVERIFY(point.energy.worst < 0.01); // of a kinetic energy of nothing it was 1
            for (const MeasureRow& row : measures())
                if (const std::optional<double> value = row.value(point, study))
                    QVERIFY(std::isfinite(*value));
        }
    }

    void energiesAreRelativeToTheLargestExchangedInTheRun() {
        World world(std::make_shared<const Pipeline>(bouncing(), test::contacts("default")));
        RunCourse course(world, 1);
        constexpr double released = 9.81 * 0.9; // [J] by a fall from 1 m to a radius of .1 m
        for (int frame = 0; frame < 60; ++frame) {
            world.step();
            course.add(world);
        }
        QVERIFY(std::abs(course.energyScale() / released - 1) < 0.1);
        World still(std::make_shared<const Pipeline>(resting(), test::contacts("default")));
        RunCourse nothing(still, 2);
        QVERIFY(std::abs(nothing.energyScale() - 1e-3 * 9.81 * 2) <
                1e-9); // a thousandth of weight times size
    }

    void eachBodyHasAHorizonOfItsOwn() {
        const Scene scene = pegsAndPasser();
        AccuracyPlan plan = quickPlan(scene, {1}, 6);
        plan.settings.resize(1);
        const AccuracyStudy study = studied(scene, plan);
        const ReferenceSolution& reference = *study.reference;
        const auto alone = static_cast<BodyIndex>(scene.bodies.size() - 1), among = alone - 1;
        QCOMPARE(reference.kind, ReferenceKind::ExactEvents);
        QVERIFY(reference.chaotic);
        QVERIFY(reference.horizons[alone] >= 6 - 1e-9);
        QVERIFY(reference.horizons[among] < 5 && reference.horizons[among] > 0);
        QCOMPARE(reference.followed, std::size_t(1));
        QVERIFY(q(yardstickOf(study).text()).contains(QStringLiteral("1 of 3 to the end")));
    }

    void whereTrajectoriesMeanNothingTheFirstMeasureThatSaysSomethingTakesTheirPlace() {
        const GeneratorRow& gas = *findGenerator("brownian");
        const Scene scene = build(generate(gas, requestFor(gas, 60))).pipeline->scene();
        AccuracyPlan plan = quickPlan(scene, {1}, 5);
        plan.copies = 0;
        std::erase_if(plan.settings, [](const AccuracySetting& s) { return s.integrator == nullptr; });
        plan.settings.resize(2);
        AccuracyStudy study = studied(scene, plan);
        QVERIFY(study.measure->name != "trajectory");
        const QString why = q(reasonOf(study).text());
        QVERIFY2(why.contains(
                     QStringLiteral("`trajectory` says nothing here: half of the bodies can be followed")),
                 qPrintable(why));
        plan.measure = findMeasure("overlap");
        study = studied(scene, plan);
        QCOMPARE(study.measure->name, std::string_view("overlap"));
        QCOMPARE(reasonOf(study).text(), std::string("Measured by `overlap`, as asked for."));
    }

    // It counted as saying something, and was chosen, because it was above rounding.
    void aMeasureThatIsTheSameForAllSettingsSaysNothing() {
        const Scene scene = bouncing();
        AccuracyStudy study = studied(scene, quickPlan(scene, {1, 4}, 0.5));
        QVERIFY(study.points.size() > 2);
        const MeasureRow& overlap = *findMeasure("overlap");
        for (AccuracyPoint& point : study.points) point.penetration = 0.25;
        QCOMPARE(objectionTo(overlap, study).text(), std::string("it is 0.25 for every setting"));
        study.points.back().penetration = 0.5;
        QCOMPARE(objectionTo(overlap, study).text(), std::string());
    }

    // Only what appeared counted: a setting that lost twice what friction takes was as good as the right one.
    void energyCountsInBothDirections() {
        const Scene scene =
            parsed("gravity { accel 0, -9.81, 0 }\n"
                   "sphere bob { radius 0.1 mass 1 centre 0, 0.8, 0 }\n"
                   "spring { from world to bob fromAt 0, 2, 0 stiffness 100 length 1 damping 2 }");
        const AccuracyPlan plan = quickPlan(scene, {1, 8, 64}, 1);
        const AccuracyStudy study = studied(scene, plan);
        QVERIFY(!study.conservative);
        QCOMPARE(study.reference->kind, ReferenceKind::ConvergedRun);
        const MeasureRow& energy = *findMeasure("energy");
        double largest = 0;
        for (const AccuracyFamily& family : familiesOf(study)) {
            double coarser = HUGE_VAL;
            for (const AccuracyPoint* point : family.points) {
                const double error = energy.value(*point, study).value_or(-1);
                QVERIFY2(error >= 0 && (error < coarser || error < exact),
                         qPrintable(q(point->setting.name())));
                coarser = error;
                if (point->setting.substeps == 1 && point->setting.integrator->name == "symplectic")
                    largest = error;
            }
        }
        QVERIFY2(largest > 1e-3, qPrintable(QString::number(largest)));
    }

    // "1 times cheaper and no worse by any measure", it was said of a setting that took 0.96 of the time.
    void whatTimesDoNotTellApartIsNotCheaper() {
        const Scene scene = oscillating();
        AccuracyStudy study = studied(scene, quickPlan(scene, {1}, 0.25));
        AccuracyPoint other = *ownPoint(study);
        other.isDefault = false;
        other.setting.substeps = 2;
        study.points = {*ownPoint(study), other};
        study.points[0].times = {1};
        study.points[1].times = {0.96};
        QCOMPARE(distanceFromFront(study), std::optional<double>(1));
        QVERIFY(!q(recommendation(study).text()).contains(QStringLiteral("times cheaper")));
        study.points[1].times = {0.8};
        QCOMPARE(distanceFromFront(study), std::optional<double>(1.25));
        QVERIFY(q(recommendation(study).text()).contains(QStringLiteral("1.2 times cheaper")));
    }

    // An error 3 % beyond what nine runs differed by was to be reduced at twenty times the cost.
    void oneMoreRunMayDifferByTwiceWhatTheOthersDo() {
        AccuracyStudy study;
        study.reference.emplace();
        study.reference->energyScatter = study.reference->outcomeScatter = 0.01;
        for (const char* measure : {"energy", "rest"})
            QCOMPARE(equalErrorsOf(*findMeasure(measure), study), 0.02);
    }

    void everyMeasureIsExplainedInTheManual() {
        QFile manual(test::source("resources/help/diagrams.md"));
        QVERIFY(manual.open(QIODevice::ReadOnly));
        const QString text = QString::fromUtf8(manual.readAll());
        for (const MeasureRow& row : measures()) {
            QVERIFY(!row.help.empty() && !row.axis.empty() && !row.noun.empty());
            QVERIFY2(text.contains(QStringLiteral("| `%1` |").arg(q(std::string(row.name)))),
                     row.name.data());
        }
    }

    void whereNoRunCanBeFollowedTheStudyGoesOnWithoutAReferenceSolution() {
        const Scene scene = parsed("sphere bob { radius 0.1 mass 1 centre 0.3, 0.8, 0 }\n"
                                   "spring { from world to bob fromAt 0, 2, 0 stiffness 4e12 length 1 }");
        AccuracyPlan plan = quickPlan(scene, {1, 2}, 1);
        const AccuracyStudy study = studied(scene, plan);
        QVERIFY(study.complete);
        QVERIFY(!study.points.empty());
        QVERIFY(!recommendation(study).empty());
    }
};

} // namespace carom

CAROM_TEST_WITH(QCoreApplication, accuracy_test, carom::AccuracyTest)
#include "accuracy_test.moc"
