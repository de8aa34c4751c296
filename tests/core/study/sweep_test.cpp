// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/csv.h"
#include "core/base/text.h"
#include "core/study/sweep_reader.h"
#include "core/study/sweep_summary.h"
#include "core/study/sweep_table.h"

#include "tests/support/test_class.h"

#include <QTest>

#include <cmath>
#include <map>
#include <set>

// What a sweep is, which runs follow from it, and that its table does not depend on who makes them.

namespace carom {
namespace {

const std::string thrownBall = "wall { normal 0, 1, 0 toOrig 0 }\n"
                               "sphere ball { radius 0.1 mass 1 centre 0, 1, 0 vel 1, 0, 0 }\n"
                               "simulation { duration 0.5 }\n";

SweepDefinition throwing(std::vector<std::string> vary) {
    return {.vary = std::move(vary), .measures = {"final x of ball"}, .frames = {}, .generate = {}};
}

std::shared_ptr<const Sweep> sweepOf(const SweepDefinition& definition,
                                     const std::string& text = thrownBall) {
    const ReadSweep read = readSweep(definition, text);
    if (!read.sweep) qFatal("%s", read.objection.c_str());
    return read.sweep;
}

/// The table, with 0 in the place of the seconds, made by so many threads in parts.
std::string tableOf(const Sweep& sweep, int threads, int shards = 1) {
    std::string table = sweepColumns(sweep);
    for (int number = 1; number <= shards; ++number) {
        const ItemRange part = stretchOf({number, shards}, sweep.weights());
        RowSorter sorter(part.first, [&](std::size_t, std::string_view line) { table += line; });
        SweepListener listener;
        listener.ended = [&](SweepResult result) {
            result.seconds = 0;
            sorter.add(result.run, sweepRow(sweep, result));
        };
        if (!runSweep(sweep, part, threads, {}, listener)) qFatal("not all runs were made");
        sorter.finish();
    }
    return table;
}

} // namespace

class SweepTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void valuesAreRangesListsAndWords_data() {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QStringList>("values");
        QTest::newRow("range") << "4:12:5" << QStringList{"4", "6", "8", "10", "12"};
        QTest::newRow("no rounding shows") << "0.1:0.5:5" << QStringList{"0.1", "0.2", "0.3", "0.4", "0.5"};
        QTest::newRow("downwards") << "-1:-2:3" << QStringList{"-1", "-1.5", "-2"};
        QTest::newRow("one") << "3:9:1" << QStringList{"3"};
        QTest::newRow("powers") << "log 1e-3:1:4" << QStringList{"0.001", "0.01", "0.1", "1"};
        QTest::newRow("list") << "0,.1,-.5,1e3" << QStringList{"0", "0.1", "-0.5", "1000"};
        QTest::newRow("words") << "contacts,events" << QStringList{"contacts", "events"};
    }
    void valuesAreRangesListsAndWords() {
        QFETCH(QString, text);
        QFETCH(QStringList, values);
        SweptParameter parameter;
        QCOMPARE(readValues(text.toStdString(), parameter), std::string());
        QStringList read;
        for (const std::string& value : parameter.values) read << QString::fromStdString(value);
        QCOMPARE(read, values);
    }

    void theLastGivenVariesFastest() {
        const auto sweep = sweepOf(throwing({"ball.vel.x=1,2", "simulation.substeps=1,4,16"}));
        QCOMPARE(sweep->runs(), std::size_t(6));
        QCOMPARE(sweep->valuesOf(0), (std::vector<std::string>{"1", "1"}));
        QCOMPARE(sweep->valuesOf(4), (std::vector<std::string>{"2", "4"}));
        const Scene scene = analyse(sweep->textOf(4).value()).scene;
        QCOMPARE(scene.bodies[1].velocity.x(), 2.0);
        QCOMPARE(scene.simulation.substeps.value(), 4);
    }

    void zippedValuesGoTogether() {
        SweepDefinition definition = throwing({"ball.vel.x=1,2,3", "ball.mass=4,5,6"});
        definition.zip = true;
        const auto sweep = sweepOf(definition);
        QCOMPARE(sweep->runs(), std::size_t(3));
        QCOMPARE(sweep->valuesOf(2), (std::vector<std::string>{"3", "6"}));
        definition.vary.back() = "ball.mass=4,5";
        QVERIFY(readSweep(definition, thrownBall).objection.find("equally many") != std::string::npos);
    }

    // 20,000 draws: mean and deviation of the laws within four standard errors.
    void drawsFollowTheirLawsAndDependOnTheirPlaceAlone() {
        SweepDefinition definition = throwing(
            {"ball.vel.x=uniform 4:12", "ball.vel.z=normal 8:0.5", "simulation.substeps=uniform 1:3"});
        definition.random = 20'000;
        const auto sweep = sweepOf(definition);
        QCOMPARE(sweep->runs(), std::size_t(20'000));
        QCOMPARE(sweep->runsOfPoint(), std::size_t(20'000));
        double sum[2] = {}, squares[2] = {};
        std::map<std::string, int> substeps;
        for (std::size_t run = 0; run < sweep->runs(); ++run) {
            const std::vector<std::string> values = sweep->valuesOf(run);
            for (std::size_t k = 0; k < 2; ++k) {
                const double value = numberIn(values[k]).value();
                sum[k] += value;
                squares[k] += value * value;
            }
            ++substeps[values[2]];
        }
        const double n = 20'000;
        const auto check = [&](std::size_t k, double mean, double deviation) {
            const double measured = sum[k] / n;
            QVERIFY(std::abs(measured - mean) < 4 * deviation / std::sqrt(n));
            QVERIFY(std::abs(std::sqrt(squares[k] / n - measured * measured) - deviation) <
                    4 * deviation / std::sqrt(n));
        };
        check(0, 8, 8 / std::sqrt(12.0));
        check(1, 8, 0.5);
        QCOMPARE(substeps.size(), std::size_t(3));
        for (const auto& [word, count] : substeps)
            QVERIFY(std::abs(count - n / 3) < 4 * std::sqrt(n * 2 / 9));
        QCOMPARE(sweepOf(definition)->valuesOf(777), sweep->valuesOf(777));
        definition.randomSeed = 2;
        QVERIFY(sweepOf(definition)->valuesOf(777) != sweep->valuesOf(777));
    }

    void seedsAreThoseOfTheGeneratedScene() {
        SweepDefinition definition{.vary = {"generate.n=5,10"},
                                   .measures = {"final centre_of_mass_y"},
                                   .seeds = 3,
                                   .frames = 2,
                                   .generate = "pile --n 8 --seed 40"};
        const auto made = sweepOf(definition, "");
        QCOMPARE(made->runs(), std::size_t(6));
        QCOMPARE(made->valuesOf(4), (std::vector<std::string>{"10", "41"}));
        QVERIFY(made->textOf(4)->find("carom generate pile --n 10 --seed 41") != std::string::npos);
        definition.generate.clear();
        definition.vary = {"generate.n=5,10"};
        const auto declared = sweepOf(definition, "generate g { scene pile n 8 seed 7 }\n");
        QCOMPARE(declared->valuesOf(5), (std::vector<std::string>{"10", "9"}));
        QCOMPARE(analyse(declared->textOf(5).value()).scene.generated->seed, 9);
        definition.vary = {};
        QVERIFY(readSweep(definition, thrownBall).objection.find("needs a generated scene") !=
                std::string::npos);
    }

    void whatCannotBeSweptIsSaid_data() {
        QTest::addColumn<QString>("vary");
        QTest::addColumn<QString>("objection");
        const auto row = [](const char* vary, const char* objection) {
            QTest::newRow(vary) << QString(vary) << QString(objection);
        };
        row("ball.vel.x", "is not of the form `cue.vel.x=4:12:17`");
        row("bal.vel.x=1,2", "did you mean `ball`?");
        row("ball.vel.x=1:2", "a range has three numbers, first:last:count");
        row("ball.vel.x=1:b:3", "`b` is no number");
        row("ball.vel.x=1:2:0", "it must be a whole number from 1 to 1000000");
        row("ball.mass=log 0:1:3", "a logarithmic range lies above 0");
        row("ball.mass=1,-1", "`mass` is -1; it must be greater than 0");
        row("ball.mass=1,,2", "a value is missing");
        row("simulation.substeps=1:4:3", "`substeps` is 2.5; it must be a whole number");
        row("simulation.method=contact", "did you mean `contacts`?");
        row("ball.mass=uniform 1:2", "a law needs a number of draws");
        row("ball.mass=uniform 1", "a uniform law has two numbers, least:most");
        row("ball.mass=normal 1:2:3", "a normal law has two numbers, mean:deviation");
        row("ball.mass=uniform 2:1", "the least is above the most");
        row("ball.mass=normal 1:-2", "the deviation is below 0");
        row("generate.n=1,2", "the text has no `generate` declaration");
        row("air.wind.x=1,2", "the first run has errors: air lacks `density`");
    }
    void whatCannotBeSweptIsSaid() {
        QFETCH(QString, vary);
        QFETCH(QString, objection);
        const ReadSweep read = readSweep(throwing({vary.toStdString()}), thrownBall);
        QVERIFY(!read.sweep);
        QVERIFY2(QString::fromStdString(read.objection).contains(objection), read.objection.c_str());
    }

    // What a definition says beyond the values of one parameter.
    void whatADefinitionCannotMeanIsSaid_data() {
        QTest::addColumn<SweepDefinition>("definition");
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("objection");
        const QString ball = QString::fromStdString(thrownBall), none;
        const auto row = [](const char* name, const SweepDefinition& definition, const QString& text,
                            const char* objection) {
            QTest::newRow(name) << definition << text << QString(objection);
        };
        const auto varying = [](std::vector<std::string> vary, const char* generator = "") {
            SweepDefinition definition;
            definition.vary = std::move(vary);
            definition.measures = {"max penetration"};
            definition.generate = generator;
            return definition;
        };
        for (const auto& [words, objection] : {
                 std::pair{"pil --n 8", "there is no generator `pil`; did you mean `pile`?"},
                 {"pile --n=eight", "`--n eight` is no option with a number"},
                 {"pile n=8", "`n 8` is no option with a number"},
                 {"pile --n", "`--n ` is no option with a number"},
                 {"pile --n 7.5", "`--n` is 7.5; it must be a whole number"},
                 {"pile --seed -1", "`--seed` is -1; it must be a whole number"},
                 {"pile --n -8", "-8"},
             })
            row(words, varying({}, words), none, objection);
        for (const auto& [vary, objection] : {
                 std::pair{"generate.n=4,5.5", "`5.5` must be a whole number"},
                 {"generate.n=4,many", "`many` is no number"},
                 {"generate.seed=1,-1", "`-1` must be a whole number"},
                 {"generate.cuboid=0,1", "`heap` has no option `cuboid`; did you mean `cuboids`?"},
                 {"generate.n.x=1,2", "options of a generator have no components"},
             })
            row(vary, varying({vary}, "heap --n 8"), none, objection);
        SweepDefinition seeds = varying({"generate.seed=1,2"}, "pile --n 8");
        seeds.seeds = 3;
        row("seeds twice", seeds, none, "`generate.seed` is varied, and `seeds` would vary it again");
        SweepDefinition draws = varying({"ball.mass=1,2"});
        draws.random = 10;
        row("draws without a law", draws, ball, "`random` needs a law to draw from");
        SweepDefinition twice = varying({"ball.mass=1,2"});
        twice.measures.push_back(twice.measures.front());
        row("measured twice", twice, ball, "`max penetration` is measured twice");
        row("varied twice", varying({"ball.mass=1,2", "ball.mass=3,4"}), ball, "it is varied twice");
        row("too many runs", varying({"ball.mass=1:2:100000", "ball.vel.x=1:2:100000"}), ball,
            "more than 100000000 runs");
        row("an error in the scene", varying({"ball.mass=1,2"}), ball + "sphere { radius 1 }",
            "the scene has errors: ");
    }
    void whatADefinitionCannotMeanIsSaid() {
        QFETCH(SweepDefinition, definition);
        QFETCH(QString, text);
        QFETCH(QString, objection);
        const ReadSweep read = readSweep(definition, text.toStdString());
        QVERIFY(!read.sweep);
        QVERIFY2(QString::fromStdString(read.objection).contains(objection), read.objection.c_str());
    }

    void aDeclarationSaysTheSameAsACommandLine() {
        const std::string text = thrownBall +
                                 "sweep { vary \"ball.vel.x=1,2\" vary \"ball.mass=3,4\" zip yes\n"
                                 "measure \"final x of ball\" measure \"max speed\" frames 12 }\n";
        const Analysis analysis = analyse(text);
        QVERIFY(analysis.diagnostics.empty());
        const SweepDefinition definition = definitionOf(analysis.scene.sweep.value());
        const auto sweep = sweepOf(definition, text);
        QCOMPARE(sweep->runs(), std::size_t(2));
        QCOMPARE(sweep->measures().size(), std::size_t(2));
        QCOMPARE(definition.frames.value(), 12);
        const SweepResult result = runOf(*sweep, 1, {}).value();
        QVERIFY(std::abs(result.figures[0] - 2 * 12.0 / 60) < 1e-9);
    }

    // x after 0.5 s is v/2: figures stand behind the values they belong to, in the order of the runs.
    void aTableHasARowARunWithItsFigures() {
        const auto sweep = sweepOf(throwing({"ball.vel.x=0:4:5"}));
        const std::string table = tableOf(*sweep, 1);
        const std::vector<std::string_view> lines = csvSplit(table, '\n');
        QCOMPARE(lines[0],
                 std::string_view("run,ball.vel.x,final x of ball,outcome,frames,state_hash,work,seconds"));
        std::set<std::uint64_t> hashes;
        for (std::size_t run = 0; run < 5; ++run) {
            const SweepResult result = resultOfRow(*sweep, lines[run + 1]).value();
            QCOMPARE(result.run, run);
            QVERIFY(std::abs(result.figures[0] - 0.5 * static_cast<double>(run)) < 1e-9);
            QCOMPARE(result.frames, 30);
            QVERIFY(result.work >= 30);
            hashes.insert(result.stateHash);
        }
        QCOMPARE(hashes.size(), std::size_t(5));
    }

    void threadsAndShardsDoNotShow() {
        const auto sweep = sweepOf(throwing({"ball.vel.x=0:4:7", "simulation.substeps=1,2,8"}));
        const std::string table = tableOf(*sweep, 1);
        QCOMPARE(tableOf(*sweep, 2), table);
        QCOMPARE(tableOf(*sweep, 5, 3), table);
        QCOMPARE(tableOf(*sweep, 1, 8), table);
    }

    // 8 substeps are eight times the work of one: the heavy runs fill more shards than the light ones.
    void shardsAreCutByWork() {
        const auto sweep = sweepOf(
            throwing({"simulation.method=contacts", "simulation.substeps=1,8", "ball.vel.x=0:1:100"}));
        const std::vector<double> weights = sweep->weights();
        QVERIFY(std::abs(weights[150] / weights[50] - 8) < 1e-9);
        const ItemRange first = stretchOf({1, 3}, weights);
        QCOMPARE(first.first, std::size_t(0));
        QVERIFY2(first.end > 120 && first.end < 130, qPrintable(QString::number(first.end)));
    }

    void anEndedSweepMakesNoMoreRuns() {
        const auto sweep = sweepOf(throwing({"ball.vel.x=0:4:50"}));
        std::set<std::size_t> seen;
        SweepListener listener;
        listener.goOn = [&] { return seen.size() < 10; };
        listener.ended = [&](const SweepResult& result) { seen.insert(result.run); };
        QVERIFY(!runSweep(*sweep, {0, 50}, 1, {}, listener));
        QCOMPARE(seen.size(), std::size_t(10));
        // The others, once each.
        const std::set<std::size_t> known = seen;
        std::size_t again = 0;
        listener.goOn = {};
        listener.ended = [&](const SweepResult& result) { again += seen.insert(result.run).second ? 0 : 1; };
        QVERIFY(runSweep(
            *sweep, {0, 50}, 2, [&](std::size_t run) { return known.contains(run); }, listener));
        QCOMPARE(seen.size(), std::size_t(50));
        QCOMPARE(again, std::size_t(0));
    }

    void whatAListenerThrowsEndsTheSweep() {
        const auto sweep = sweepOf(throwing({"ball.vel.x=0:4:50"}));
        SweepListener listener;
        int ended = 0;
        listener.ended = [&](const SweepResult&) {
            if (++ended == 3) throw std::runtime_error("full");
        };
        QVERIFY_EXCEPTION_THROWN(runSweep(*sweep, {0, 50}, 2, {}, listener), std::runtime_error);
        QCOMPARE(ended, 3);
    }

    // A draw below 0 is no mass: its run is faulty, the others are not.
    void aFaultyDrawIsNoFigure() {
        SweepDefinition definition = throwing({"ball.mass=normal 0:1"});
        definition.random = 20;
        definition.vary.push_back("ball.vel.x=1,2");
        ReadSweep read;
        for (definition.randomSeed = 1; !read.sweep; ++definition.randomSeed) // the first draw must be a mass
            read = readSweep(definition, thrownBall);
        const Sweep& sweep = *read.sweep;
        std::vector<SweepPoint> points;
        SweepSummary summary(sweep, [&](const SweepPoint& point) { points.push_back(point); });
        for (std::size_t run = 0; run < sweep.runs(); ++run) {
            const SweepResult result = runOf(sweep, run, {}).value();
            const bool isMass = numberIn(sweep.valuesOf(run)[0]).value() > 0;
            QCOMPARE(nameOf(result.outcome), isMass ? std::string_view("done") : std::string_view("faulty"));
            QCOMPARE(std::isnan(result.figures[0]), !isMass);
            summary.add(result);
        }
        summary.finish();
        QCOMPARE(points.size(), std::size_t(2));
        QVERIFY(points[0].faulty > 0 && points[0].faulty < 20);
        QCOMPARE(points[0].spreads[0].runs, 20 - points[0].faulty);
        QVERIFY(std::abs(points[1].spreads[0].mean - 1) < 1e-9);
    }

    // 1 to 9: mean 5, deviation √7.5, and t = 2.306 of 8 degrees of freedom.
    void aSpreadHasMeanIntervalAndQuantiles() {
        const FigureSpread spread = spreadOf({9, 8, 7, 6, 5, 4, 3, 2, 1, std::nan("")});
        QCOMPARE(spread.runs, std::size_t(9));
        QCOMPARE(spread.mean, 5.0);
        QVERIFY(std::abs(spread.deviation - std::sqrt(7.5)) < 1e-12);
        QVERIFY(std::abs(spread.meanAt95.high - (5 + 2.306 * std::sqrt(7.5) / 3)) < 2e-3);
        QCOMPARE(spread.median, 5.0);
        QCOMPARE(spread.q25, 3.0);
        QCOMPARE(spread.q75, 7.0);
        QCOMPARE(spread.least, 1.0);
        QCOMPARE(spread.most, 9.0);
        QVERIFY(std::isnan(spreadOf({4}).deviation));
        QVERIFY(std::isnan(spreadOf({}).mean));
    }

    void rowsThatComeInAnyOrderLeaveInThatOfTheRuns() {
        std::string out;
        RowSorter sorter(
            2, [&](std::size_t run, std::string_view line) { out += std::to_string(run).append(line); });
        for (const std::size_t run : {4U, 3U, 2U, 3U, 7U, 5U, 1U}) sorter.add(run, "a ");
        QCOMPARE(out, std::string("2a 3a 4a 5a "));
        QCOMPARE(sorter.next(), std::size_t(6));
        sorter.finish();
        QCOMPARE(out, std::string("2a 3a 4a 5a 7a "));
    }

    void aRecordSaysWhatTheFolderIsOf() {
        SweepDefinition definition = throwing({"ball.vel.x=1,2", "ball.mass=uniform 1:2"});
        definition.random = 3;
        definition.randomSeed = 9;
        definition.frames = 12;
        const auto sweep = sweepOf(definition);
        QCOMPARE(definitionInRecord(sweepRecord(*sweep, "1")).value(), definition);
        QVERIFY(sweepRecord(*sweepOf(definition, thrownBall + " "), "1") != sweepRecord(*sweep, "1"));
        QVERIFY(!definitionInRecord("vary a.b=1\n"));
    }
};

} // namespace carom

CAROM_TEST(sweep_test, carom::SweepTest)
#include "sweep_test.moc"
