// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/generators/generator.h"
#include "core/simulation/build.h"
#include "core/study/hard_scenes.h"
#include "core/study/stability_report.h"

#include "tests/core/study/cases/hard_cases.h"
#include "tests/support/test_class.h"

#include <QDir>
#include <QFile>
#include <QTest>

#include <cmath>
#include <set>

// The catalogue of hard cases, how they are judged, and what is written of them.

namespace carom {
namespace {

QStringList linesOf(const std::string& text) {
    return QString::fromStdString(text).split('\n', Qt::SkipEmptyParts);
}

} // namespace

class StabilityTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void everyCaseSaysWhatIsRightAndHasItsOwnNumberAndName() {
        std::set<std::string_view> names;
        int last = 0;
        for (const HardCase& row : hardCases()) {
            QVERIFY2(row.number > last, row.name.data());
            last = row.number;
            QVERIFY(names.insert(row.name).second);
            QVERIFY(!row.title.empty() && !row.answer.empty() && !row.aim.empty());
            QVERIFY(row.run != nullptr && (row.declarations != nullptr) == row.scene.empty());
            QVERIFY(row.has(StudyColumn::Default) || row.has(StudyColumn::Accurate) ||
                    row.has(StudyColumn::Exact));
            QCOMPARE(row.byDefault == "–", !row.has(StudyColumn::Default));
            QVERIFY(findHardCase(row.name) == &row);
            QVERIFY(findHardCase(std::to_string(row.number)) == &row);
        }
        QVERIFY(findHardCase("elastic_bal") == nullptr);
    }

    void everyCaseOpensAsASceneWithoutErrors() {
        for (const HardCase& row : hardCases())
            for (const StudyColumn column : studyColumns) {
                if (!row.has(column)) continue;
                const std::string text = sceneOf(row, column);
                QCOMPARE(text.find("Hard case " + std::to_string(row.number) + ": "),
                         row.scene.empty() ? 2U : 3U);
                const Build built = build(text);
                for (const Diagnostic& diagnostic : built.diagnostics)
                    QVERIFY2(diagnostic.severity() != Severity::Error, diagnostic.message.c_str());
                const std::string_view method = built.pipeline->settings().method->name;
                QCOMPARE(method == "events", column == StudyColumn::Exact);
            }
    }

    void everySceneOfTheFolderIsACaseThatNamesItsSource() {
        const QDir folder(QStringLiteral(CAROM_SOURCE_DIR "/scenes/hard"));
        const QStringList files = folder.entryList({QStringLiteral("*.sdl")}, QDir::Files, QDir::Name);
        QCOMPARE(static_cast<std::size_t>(files.size()), hardScenes().size());
        for (qsizetype i = 0; i < files.size(); ++i) {
            const HardScene& scene = hardScenes()[static_cast<std::size_t>(i)];
            QCOMPARE(files[i].toStdString(), std::string(scene.name) + ".sdl");
            QFile file(folder.filePath(files[i]));
            QVERIFY(file.open(QIODevice::ReadOnly));
            QCOMPARE(file.readAll().toStdString(), std::string(scene.text));
            QVERIFY(
                scene.text.starts_with("// Hard case " + std::to_string(files[i].left(2).toInt()) + ": "));
            QVERIFY(scene.text.find("\n// Right: ") != scene.text.npos);
            QVERIFY(scene.text.find("\n// Source: ") != scene.text.npos);
        }
    }

    // The logs that case 26 calls `made` are those of the generator, to the bit.
    void theLogPileIsTheGenerators() {
        const Scene scene = analyse(std::string(findHardCase("26")->scene)).scene;
        const std::string made = generate(*findGenerator("log_pile"), {.n = 6, .options = {}});
        std::size_t found = 0;
        for (const Body& log : analyse(made).scene.bodies) {
            if (log.fixed) continue;
            const BodyIndex same = scene.labelled("made" + std::to_string(++found));
            QVERIFY(same != noBody);
            const Body& here = scene.bodies[same];
            QVERIFY(here.pose.position == log.pose.position);
            QVERIFY(here.pose.orientation.coeffs() == log.pose.orientation.coeffs());
            QVERIFY(here.mass == log.mass && here.friction == log.friction && here.elastic == log.elastic);
        }
        QCOMPARE(found, std::size_t(6));
    }

    void whatIsAskedBesideAScenesDeclarationsIsOfACaseThatIsAScene() {
        int last = 0;
#define CAROM_HARD_MEMBERS(which, ask)                                                                       \
    QVERIFY(which > last && !findHardCase(std::to_string(which))->scene.empty());                            \
    last = which;
#include "core/study/cases/members.def"
#undef CAROM_HARD_MEMBERS
    }

    // A figure of a scene is how far an expectation is off; its verdict is the expectation's.
    void aSceneThatIsWrongFails() {
        HardCase wrong = *findHardCase("1");
        const std::string text = "sphere ball { radius 1  mass 1  centre 0, 0, 0 }\n"
                                 "expect fall { quantity y  of ball  at 1  value -4.8  within 0.05 }\n"
                                 "expect { quantity y  of ball  at 1  value -4.8  within 0.2 }\n"
                                 "expect { quantity speed  until 1  max 9 }\n";
        wrong.scene = text;
        const TrialResult result = *runTrial(wrong, StudyColumn::Default, StudyLength::Short);
        QCOMPARE(result.verdict, Verdict::Fails);
        QCOMPARE(result.figures.size(), std::size_t(3));
        QCOMPARE(result.figures[0].name, std::string("fall"));
        QVERIFY(std::abs(result.figures[0].value - 0.1) < 1e-9 && !result.figures[0].holds());
        QVERIFY(result.figures[1].holds());
        QVERIFY(std::abs(result.figures[2].value - 9.8) < 1e-9 && !result.figures[2].holds());
    }

    void everyKnownFailureIsOfACaseThatExists() {
        for (const test::KnownFailure& failure : test::knownFailures) {
            const HardCase* row = findHardCase(failure.name);
            QVERIFY2(row != nullptr && row->has(failure.column), failure.name.data());
        }
    }

    void aFigureHoldsUpToItsLimitAndNeverWhereItIsNoNumber() {
        QVERIFY(Figure({.name = "x", .value = 1, .limit = 1}).holds());
        QVERIFY(!Figure({.name = "x", .value = 1.0000001, .limit = 1}).holds());
        QVERIFY(!Figure({.name = "x", .value = std::nan(""), .limit = 1}).holds());
    }

    void theDecisiveFigureIsTheOneFurthestBeyondItsLimit() {
        TrialResult result{.figures = {{.name = "a", .value = 0.5, .limit = 1},
                                       {.name = "b", .value = 3, .limit = 2},
                                       {.name = "c", .value = 0, .limit = 0}}};
        QCOMPARE(result.decisive()->name, std::string("b"));
        result.figures[2].value = 1;
        QCOMPARE(result.decisive()->name, std::string("c"));
        QVERIFY(TrialResult{}.decisive() == nullptr);
    }

    void aStudyTellsTheColumnsApart() {
        StabilityPlan plan;
        plan.cases = {findHardCase("1"), findHardCase("7")};
        int started = 0, ended = 0;
        const StabilityStudy study =
            runStability(plan, {.goOn = {},
                                .starts = [&](const HardCase&, StudyColumn) { ++started; },
                                .ends = [&](const TrialResult&) { ++ended; }});
        QVERIFY(study.complete && study.allHold());
        QCOMPARE(started, 5); // case 7 has no exact column
        QCOMPARE(ended, 6);
        QCOMPARE(study.results.size(), std::size_t(6));
        QCOMPARE(study.count(StudyColumn::Default, Verdict::Holds), std::size_t(2));
        QCOMPARE(study.count(StudyColumn::Exact, Verdict::NotApplicable), std::size_t(1));
        QCOMPARE(tallyOf(study, StudyColumn::Exact), std::string("exact: 1 of 1 hold"));

        const QStringList rows = linesOf(figuresAsCsv(study, {"carom, quoted", "1.0", "a \"machine\""}));
        QCOMPARE(rows.front(),
                 "case,name,column,figure,value,unit,limit,verdict,wall_s,command,version,machine");
        QVERIFY(rows[1].startsWith("1,elastic_ball,default,energy,"));
        QVERIFY(rows[1].endsWith(",\"carom, quoted\",1.0,\"a \"\"machine\"\"\""));
        QVERIFY(rows.back().startsWith("7,flat_cube,exact,,,,,not applicable,"));
    }

    void aStoppedStudyKeepsWhatIsWhole() {
        StabilityPlan plan;
        plan.cases = {findHardCase("1"), findHardCase("7")};
        int frames = 0;
        const StabilityStudy study =
            runStability(plan, {.goOn = [&frames] { return ++frames <= 1300; }, .starts = {}, .ends = {}});
        QVERIFY(!study.complete);
        QCOMPARE(study.results.size(), std::size_t(1)); // case 1 has 1200 frames a column
        QCOMPARE(study.results.front().verdict, Verdict::Holds);
    }
};

} // namespace carom

CAROM_TEST_WITH(QCoreApplication, stability_test, carom::StabilityTest)
#include "stability_test.moc"
