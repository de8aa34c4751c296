// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/accuracy_studies.h"
#include "tests/support/test_class.h"

#include "core/study/accuracy_csv.h"
#include "core/study/accuracy_report.h"
#include "core/study/accuracy_run.h"
#include "core/study/convergence.h"

#include <QTest>

#include <algorithm>
#include <cmath>

// How an accuracy study spends its budget: what it begins with, when it ends, and what there is by then.

namespace carom {
namespace {

using namespace test;

} // namespace

class AccuracyBudgetTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aStudyToldToStopKeepsWhatItHas() {
        const Scene scene = oscillating();
        AccuracyListener listener;
        int measured = 0;
        listener.changed = [&](const AccuracyStudy& soFar) { measured += soFar.reference ? 1 : 0; };
        listener.goOn = [&](double) { return measured < 3; };
        const AccuracyStudy study = runAccuracy(scene, quickPlan(scene, {1, 2}, 0.25), listener);
        QVERIFY(!study.complete);
        QCOMPARE(study.points.size(), std::size_t(3));
        QVERIFY(q(summaryOf(study)).contains(QStringLiteral("interrupted")));
    }

    void aStudyEndsWithItsBudgetAndSaysWhatDidNotFit() {
        constexpr double budget = 4; // [s]: 4,000 steps
        const Scene scene = oscillating();
        AccuracyPlan plan = planFor(scene);
        plan.budget = budget;
        const AccuracyStudy study = studiedByCount(scene, plan);
        QVERIFY(study.complete);
        QVERIFY2(study.seconds <= budget, qPrintable(QString::number(study.seconds)));
        QVERIFY(!study.leftOut.empty());
        QCOMPARE(study.points.size() + study.leftOut.size(), plan.settings.size());
        for (const AccuracyPoint& point : study.points) QVERIFY(!point.times.empty());
        const QString omissions = q(omissionsOf(study).text());
        QVERIFY(omissions.contains(QStringLiteral("left out")));
        for (const AccuracyFamily& family : familiesOf(study)) // each once, with all its substeps
            QVERIFY2(omissions.count(q(family.name)) <= 1, qPrintable(omissions));
        QVERIFY(!q(summaryOf(study)).contains(QStringLiteral("interrupted")));
        QVERIFY(q(recommendation(study).text()).contains(QStringLiteral("per simulated second")));
    }

    void ofASceneThatIsTooLongTheFirstPartIsStudied() {
        const Scene scene = bouncing();
        AccuracyPlan plan = planFor(scene);
        plan.duration = 1000; // 60,000 frames, where a run may take 100
        plan.budget = 2;
        const AccuracyStudy study = studiedByCount(scene, plan);
        QVERIFY(study.complete && !study.points.empty());
        QVERIFY(study.duration > 0.1 && study.duration < 2);
        QVERIFY(q(omissionsOf(study).text()).startsWith(QStringLiteral("Only the first")));
        QVERIFY(study.seconds <= 2);
    }

    void aStudyIsValidWheneverItEnds() {
        const Scene scene = oscillating();
        const AccuracyPlan plan = quickPlan(scene, {1, 2, 4}, 0.25);
        for (int changes = 1; changes < 8; ++changes) {
            CountedTime time;
            AccuracyListener listener = time.listener();
            int measured = 0;
            listener.changed = [&](const AccuracyStudy& soFar) { measured += soFar.reference ? 1 : 0; };
            listener.goOn = [&](double) { return measured < changes; };
            const AccuracyStudy study = runAccuracy(scene, plan, listener);
            QCOMPARE(study.points.size(), static_cast<std::size_t>(changes));
            QVERIFY(study.points.front().isDefault); // first of all
            for (const AccuracyPoint& point : study.points) QVERIFY(!point.times.empty());
            QVERIFY(!recommendation(study).empty() && distanceFromFront(study));
        }
    }

    // Interrupted while the reference solution was computed the program crashed, and left no row behind.
    void beforeThereIsAReferenceSolutionTheOwnSettingIsTimed() {
        QVERIFY(!summaryOf(AccuracyStudy()).empty());
        const Scene scene = bouncing();
        const AccuracyPlan plan = quickPlan(scene, {1, 2}, 0.25);
        CountedTime time;
        AccuracyListener listener = time.listener();
        int changes = 0;
        listener.changed = [&](const AccuracyStudy&) { ++changes; };
        listener.goOn = [&](double) { return changes < 1; };
        const AccuracyStudy study = runAccuracy(scene, plan, listener);
        QVERIFY(!study.complete && !study.reference);
        QCOMPARE(study.points.size(), std::size_t(1));
        QVERIFY(study.points.front().isDefault && !study.points.front().times.empty());
        QVERIFY(!distanceFromFront(study));
        const QString summary = q(summaryOf(study));
        QVERIFY2(summary.contains(QStringLiteral("before it had anything to compare with")) &&
                     summary.contains(QStringLiteral("Nothing can be recommended")),
                 qPrintable(summary));

        const std::string csv = pointsAsCsv(study, "77", {"carom", "1", "a machine"});
        QVERIFY2(csv.find(",yes,timed,") != std::string::npos, csv.c_str());
        const ReadPoints read = pointsFromCsv(csv, {"77", 0.25, "1"});
        QCOMPARE(read.known.points.size(), std::size_t(1));
        const AccuracyStudy resumed = studied(scene, plan, read.known);
        QVERIFY(resumed.complete);
        for (const AccuracyPoint& point : resumed.points) QVERIFY(point.finished());
    }

    void settingsGoFromCoarseToFineThePresetsFirst() {
        const AccuracyPlan plan = planFor(resting());
        std::size_t wholePresets = 0;
        while (wholePresets < plan.settings.size() && plan.settings[wholePresets].preset != nullptr &&
               plan.settings[wholePresets].substeps !=
                   plan.settings[std::min(wholePresets + 1, plan.settings.size() - 1)].substeps)
            ++wholePresets;
        QVERIFY(wholePresets >= presets().size());
        for (std::size_t k = presets().size() + 1; k < plan.settings.size(); ++k)
            QVERIFY(plan.settings[k].substeps >= plan.settings[k - 1].substeps);
    }

    void timesOfASettingAreTakenUntilTheyAgree() {
        const Scene scene = oscillating();
        AccuracyPlan plan = quickPlan(scene, {1}, 0.25);
        plan.runs = 9;
        const AccuracyStudy study = studiedByCount(scene, plan); // where all times agree
        for (const AccuracyPoint& point : study.points) QCOMPARE(point.times.size(), std::size_t(3));
        CountedTime time;
        AccuracyListener listener = time.listener();
        std::uint32_t random = 1; // where hardly any do: from 1 to 64 ms between two readings
        listener.clock.processor = [&] {
            random = random * 1664525 + 1013904223;
            return time.processor += 1 + (random >> 26);
        };
        const AccuracyStudy restless = runAccuracy(scene, plan, listener);
        const auto repeated = std::ranges::count_if(
            restless.points, [](const AccuracyPoint& point) { return point.times.size() > 3; });
        QVERIFY(repeated > 0);
        QVERIFY(repeated <=
                std::ssize(paretoFront(restless)) + 3); // only those that nothing beats, or beat then
    }

    // A run at the most accurate setting that took too long made the study as short as it had come: .18 s of
    // 2 s of the pile.
    void howLongAFineRunTakesDoesNotShortenTheStudy() {
        constexpr double duration = 1;
        const Scene scene = resting();
        AccuracyPlan plan = quickPlan(scene, {1, 2}, duration);
        plan.budget = 4; // of 2,500 steps; a run of the most accurate setting takes 480, its copy and a
                         // finer one 1,440
        const AccuracyStudy study = studiedByCount(scene, plan);
        QVERIFY(study.complete);
        QCOMPARE(study.duration, duration);
        const std::string described = study.reference->description.text();
        QVERIFY2(described.find("preset default") != std::string::npos, described.c_str());
        QVERIFY(study.reference->outcome && !study.reference->energy.empty());
        QVERIFY(study.seconds <= plan.budget);
    }

    // The clock was read every 16 frames where the first ones were short, however long the later ones were:
    // a budget of 60 s ended after 64.8 s.
    void theClockIsReadAfterEveryFrameThatIsLong() {
        const Scene scene = oscillating();
        const AccuracyStudy study = studied(scene, quickPlan(scene, {1}, 0.25));
        double wall = 0, processor = 0;
        int asked = 0;
        const auto goOn = [&] {
            ++asked;
            wall += 10; // [ms] since it was read last
            return true;
        };
        const StudyClock clock{[&] { return wall; }, [&] { return processor += 0.01; }};
        AccuracyPoint point = study.points.front();
        point.times.clear();
        const Trajectory none;
        QVERIFY(timeOnce({scene, study, none, clock, 1, goOn}, point)); // [s]: a hundred such frames
        QVERIFY2(asked >= 90 && asked <= 110, qPrintable(QString::number(asked)));
        QCOMPARE(point.times.size(), std::size_t(1));
    }

    // A frame of .75 s began when .5 s were left: a study of 6 s ended after 6.7 s.
    void noStepBeginsThatTakesTooLongAsFarAsIsKnown() {
        const Scene scene = oscillating();
        const AccuracyStudy study = studied(scene, quickPlan(scene, {1}, 0.25));
        double wall = 0, processor = 0;
        const auto goOn = [&] {
            wall += 300; // [ms] a frame
            return true;
        };
        const StudyClock clock{[&] { return wall; }, [&] { return processor += 10; }};
        AccuracyPoint point{.setting = study.points.front().setting};
        const Trajectory none;
        QVERIFY(measure({scene, study, none, clock, 1, goOn}, point)); // [s]
        QCOMPARE(point.status, PointStatus::TimedOut);
        QVERIFY2(wall <= 1000, qPrintable(QString::number(wall)));
        wall = 0;
        QVERIFY(timeOnce({scene, study, none, clock, 1, goOn}, point));
        QVERIFY2(wall <= 1000, qPrintable(QString::number(wall)));
    }
};

} // namespace carom

CAROM_TEST_WITH(QCoreApplication, accuracy_budget_test, carom::AccuracyBudgetTest)
#include "accuracy_budget_test.moc"
