// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/program.h"
#include "tests/support/test_class.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QRegularExpression>
#include <QTest>

#include <signal.h>

#include <algorithm>

using namespace carom;

namespace {

const char* const traceColumns = "frame,time,body,label,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz";
const char* const statsColumns = "frame,time,simulate_ms,integrate_ms,broadphase_ms,narrowphase_ms,respond_"
                                 "ms,pairs,contacts,swaps,kinetic,"
                                 "potential,momentum_x,momentum_y,momentum_z,max_penetration,"
                                 "events,axes_tried,axes_spared,energy_by_gravity,energy_by_restitution,"
                                 "energy_by_contact,energy_by_friction,energy_by_rolling,energy_by_spring,"
                                 "energy_by_rotation,energy_by_parting,energy_by_rest,energy_unexplained,"
                                 "momentum_unexplained,residual,resting,"
                                 "pairs_collided,rows_swept,factorisations,impacts,searches,islands,"
                                 "islands_unfinished,energy_by_drag";

/// Two spheres without gravity: one at rest, one that moves exactly 1/8 m a frame.
const QByteArray glide = "gravity { accel 0, 0, 0 }\nsimulation { step 0.125  method contacts }\n"
                         "wall { normal 0, 1, 0  toOrig 100 }\n"
                         "sphere { radius 0.25  mass 2  centre 0, 0, 0  vel 1, 0, 0 }\n"
                         "sphere still { radius 0.25  mass 1  centre 0, 5, 0 }\n";

QStringList fieldsOf(const QString& row) { return row.split(','); }

/// That runs with these options end well, and with the same bits.
void haveOneHash(const QString& scene, const QString& frames, const QList<QStringList>& options,
                 const QByteArray& text = {}) {
    QSet<QString> hashes;
    for (const QStringList& option : options) {
        const test::Ended ended =
            test::carom(QStringList{"run", scene, "-n", frames, "--json"} + option, text);
        QCOMPARE(ended.exitCode, 0); // 99 where a sanitizer found something
        hashes.insert(QJsonDocument::fromJson(ended.out.toUtf8()).object()["state_hash"].toString());
    }
    QCOMPARE(hashes.size(), 1);
    QVERIFY(!hashes.contains(QString()));
}

} // namespace

class RunTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void theJsonSummaryHasEveryFieldInOrder();
    void theTextSummarySaysTheSame();
    void aTraceHoldsEveryMobileBodyEveryKthFrame();
    void statisticsHoldARowAFrame();
    void figuresReadBackExactly();
    void summaryAndStatisticsAgree();
    void zeroFramesIsTheSceneAsWritten();
    void framesComeFromTheDurationElseSixHundred();
    void optionsWinOverTheScene();
    void threadsAndBroadphasesChangeNoBit();
    void threadsShareWhatTurns();
    void faultyDeclarationsAreLeftOutUnlessStrict();
    void aLostStateEndsWithFourAndSaysWhere();
    void aFrameOfTooMuchWorkEndsWithFourAndSaysWhy();
    void energyFromNowhereEndsWithFour();
    void whatCannotBeWrittenEndsWithThree();
    void tracesGoToStandardOutputAndTheSummaryAside();
    void anInterruptedRunWritesWhatItComputed();
    void aReaderThatClosesThePipeIsNoError();

  private:
    static QJsonObject summary(const QStringList& words, const QByteArray& input) {
        const test::Ended ended = test::carom(QStringList{"run", "-", "--json"} + words, input);
        return QJsonDocument::fromJson(ended.out.toUtf8()).object();
    }
    QTemporaryDir m_folder;
    QString path(const char* name) const { return m_folder.filePath(QString::fromLatin1(name)); }
};

void RunTest::theJsonSummaryHasEveryFieldInOrder() {
    const QString text = test::carom({"run", "-", "-n", "4", "--json"}, glide).out;
    qsizetype at = 0;
    for (const char* field : {"{\"scene\":\"<stdin>\"",
                              ",\"frames\":4",
                              ",\"bodies\":3",
                              ",\"mobile\":2",
                              ",\"diagnostics\":0",
                              ",\"method\":\"contacts\"",
                              ",\"integrator\":\"midpoint\"",
                              ",\"broadphase\":\"all_pairs\"",
                              ",\"step\":0.125",
                              ",\"substeps\":4",
                              ",\"threads\":1",
                              ",\"time_ms\":{\"first\":",
                              ",\"mean\":",
                              ",\"median\":",
                              ",\"p95\":",
                              ",\"p99\":",
                              ",\"max\":",
                              ",\"total\":",
                              "},\"realtime_factor\":",
                              ",\"energy\":{\"initial\":1,\"final\":1,\"relative_drift\":0}",
                              ",\"momentum\":{\"initial\":[2,0,0],\"final\":[2,0,0]}",
                              ",\"penetration\":{\"max\":0,\"mean\":0}",
                              ",\"residual_max\":0",
                              ",\"pairs_mean\":0",
                              ",\"contacts_mean\":0",
                              ",\"ledger\":{\"gravity\":0,\"restitution\":0,\"contact\":0,",
                              "\"unexplained_max\":0}",
                              ",\"effects\":[",
                              "],\"state_hash\":\""}) {
        const qsizetype found = text.indexOf(QLatin1String(field), at);
        QVERIFY2(found >= at, field);
        at = found;
    }
    QVERIFY(text.endsWith("\"}\n") && text.count('\n') == 1);
    QVERIFY(QJsonDocument::fromJson(text.toUtf8()).isObject());
    QCOMPARE(summary({"-n", "4"}, glide)["state_hash"].toString().size(), 16);
}

void RunTest::theTextSummarySaysTheSame() {
    const test::Ended ended = test::carom({"run", "-", "-n", "4"}, glide);
    QCOMPARE(ended.exitCode, 0);
    QCOMPARE(ended.err, QString());
    for (const char* part : {"<stdin>: 3 bodies, 2 mobile; 0 diagnostics", "contacts, midpoint, all_pairs",
                             "4 of 0.125 s in 4 substeps", "initial 1 J, final 1 J, relative drift 0",
                             "at most 0 J a frame unexplained", "initial (2, 0, 0), final (2, 0, 0) kg m/s",
                             "max 0 m, mean 0 m", "max 0 m/s of the contact problem"})
        QVERIFY2(ended.out.contains(QLatin1String(part)), part);
    QVERIFY(ended.out.contains(summary({"-n", "4"}, glide)["state_hash"].toString()));
}

void RunTest::aTraceHoldsEveryMobileBodyEveryKthFrame() {
    const QString file = path("trace.csv");
    QCOMPARE(test::carom({"run", "-", "-n", "5", "--trace", file, "--every", "2"}, glide).exitCode, 0);
    const QStringList rows = test::linesOf(test::readFile(file));
    QCOMPARE(rows.first(), QString(traceColumns));
    QCOMPARE(rows.size(), 1 + 3 * 2); // frames 0, 2 and 4 of two mobile bodies; the wall is body 0
    QCOMPARE(rows[1], QString("0,0,1,,0,0,0,1,0,0,0,1,0,0,0,0,0"));
    QCOMPARE(rows[2], QString("0,0,2,still,0,5,0,1,0,0,0,0,0,0,0,0,0"));
    QCOMPARE(rows[5], QString("4,0.5,1,,0.5,0,0,1,0,0,0,1,0,0,0,0,0"));
}

void RunTest::statisticsHoldARowAFrame() {
    const QString file = path("stats.csv");
    QCOMPARE(test::carom({"run", "-", "-n", "3", "--stats", file}, glide).exitCode, 0);
    const QStringList rows = test::linesOf(test::readFile(file));
    QCOMPARE(rows.size(), 4);
    QCOMPARE(rows.first(), QString(statsColumns));
    for (int frame = 1; frame <= 3; ++frame) {
        const QStringList fields = fieldsOf(rows[frame]);
        QCOMPARE(fields.size(), 40);
        QCOMPARE(fields[0].toInt(), frame);
        QCOMPARE(fields[1].toDouble(), 0.125 * frame);
        for (int i = 2; i <= 6; ++i) QVERIFY(fields[i].toDouble() >= 0);
        QCOMPARE(fields.mid(7, 12),
                 QStringList({"0", "0", "0", "1", "0", "2", "0", "0", "0", "0", "0", "0"}));
        for (const QString& audited : fields.mid(19, 13)) QCOMPARE(audited, QString("0"));
        // Nothing is compared, swept, factored or struck; the pairs are searched for once.
        for (const QString& work : fields.mid(32, 4)) QCOMPARE(work, QString("0"));
        QVERIFY(fields[36].toInt() <= 1);
        QVERIFY(fields[37].toInt() >= 1);
        QCOMPARE(fields[38], QString("0"));
    }
}

void RunTest::figuresReadBackExactly() {
    // Shortest round trip: printing what was read gives the same text again.
    const QString file = path("exact.csv");
    QCOMPARE(test::carom({"run", test::source("scenes/spinning_cylinder.sdl"), "-n", "60", "--trace", file})
                 .exitCode,
             0);
    const QStringList rows = test::linesOf(test::readFile(file));
    QCOMPARE(rows.size(), 1 + 61 * 3);
    for (const QString& row : rows.mid(1)) {
        const QStringList fields = fieldsOf(row);
        for (int i = 4; i < fields.size(); ++i) {
            bool isNumber = false;
            const double value = fields[i].toDouble(&isNumber);
            QVERIFY(isNumber);
            QCOMPARE(QString::number(value, 'g', QLocale::FloatingPointShortest).toDouble(), value);
            QVERIFY(fields[i].size() <= 24);
        }
    }
}

void RunTest::summaryAndStatisticsAgree() {
    const QString file = path("agree.csv");
    const test::Ended ended =
        test::carom({"run", test::source("scenes/pool_break.sdl"), "-n", "60", "--method", "microcollisions",
                     "--json", "--stats", file}); // a method that lets bodies overlap
    const QJsonObject run = QJsonDocument::fromJson(ended.out.toUtf8()).object();
    double total = 0, deepest = 0, residual = 0, pairs = 0, contacts = 0;
    QStringList last;
    const QStringList rows = test::linesOf(test::readFile(file)).mid(1);
    for (const QString& row : rows) {
        last = fieldsOf(row);
        total += last[2].toDouble();
        deepest = std::max(deepest, last[15].toDouble());
        residual = std::max(residual, last.back().toDouble());
        pairs += last[7].toDouble();
        contacts += last[8].toDouble();
    }
    QCOMPARE(rows.size(), 60);
    QCOMPARE(run["time_ms"]["first"].toDouble(), fieldsOf(rows.first())[2].toDouble());
    QCOMPARE(run["time_ms"]["total"].toDouble(), total);
    QCOMPARE(run["realtime_factor"].toDouble(), 1000 * last[1].toDouble() / total);
    QCOMPARE(run["energy"]["final"].toDouble(), last[10].toDouble() + last[11].toDouble());
    QCOMPARE(run["momentum"]["final"][2].toDouble(), last[14].toDouble());
    QCOMPARE(run["penetration"]["max"].toDouble(), deepest);
    QCOMPARE(run["residual_max"].toDouble(), residual);
    QCOMPARE(run["pairs_mean"].toDouble(), pairs / 60);
    QCOMPARE(run["contacts_mean"].toDouble(), contacts / 60);
    QVERIFY(deepest > 0 && contacts > 0);
}

void RunTest::zeroFramesIsTheSceneAsWritten() {
    const QJsonObject run = summary({"-n", "0"}, glide);
    QCOMPARE(run["frames"].toInt(), 0);
    QVERIFY(run["realtime_factor"].isNull());
    QCOMPARE(run["energy"]["final"].toDouble(), 1.0);
}

void RunTest::framesComeFromTheDurationElseSixHundred() {
    QCOMPARE(summary({}, glide)["frames"].toInt(), 600);
    QCOMPARE(summary({"--duration", "1"}, glide)["frames"].toInt(), 8);
    QCOMPARE(summary({"--duration", "0.3"}, glide)["frames"].toInt(), 3); // begun frames count
    QCOMPARE(summary({"--duration", "0.3", "--step", "0.1"}, glide)["frames"].toInt(), 3);
    QCOMPARE(summary({"--duration", "1", "-n", "2"}, glide)["frames"].toInt(), 2);
    QCOMPARE(summary({}, glide + "simulation { duration 2 }").value("frames").toInt(),
             600); // given twice: left out
}

void RunTest::optionsWinOverTheScene() {
    const QJsonObject run = summary({"-n", "1", "--step", "0.5", "--substeps", "3", "--broadphase",
                                     "sweep_and_sort", "--integrator", "euler", "--threads", "2"},
                                    glide);
    QCOMPARE(run["step"].toDouble(), 0.5);
    QCOMPARE(run["substeps"].toInt(), 3);
    QCOMPARE(run["broadphase"].toString(), QString("sweep_and_sort"));
    QCOMPARE(run["threads"].toInt(), 2);
}

void RunTest::threadsAndBroadphasesChangeNoBit() {
    haveOneHash(test::source("scenes/pyramid.sdl"), "60",
                {{"--threads", "1"},
                 {"--threads", "2"},
                 {"--broadphase", "all_pairs"},
                 {"--broadphase", "sweep_and_sort"}});
}

// Cylinders that fall on each other turn so far that their contacts are found within a step.
void RunTest::threadsShareWhatTurns() {
    const QByteArray heap = test::carom({"generate", "heap", "--n", "400", "--cuboids", "0"}).out.toUtf8();
    haveOneHash("-", "25", {{"--threads", "1"}, {"--threads", "2"}}, heap);
}

void RunTest::faultyDeclarationsAreLeftOutUnlessStrict() {
    const QByteArray faulty = glide + "sphere { radius -1  mass 1  centre 9, 9, 9 }\n";
    const test::Ended lenient = test::carom({"run", "-", "-n", "1", "--json"}, faulty);
    QCOMPARE(lenient.exitCode, 0);
    QVERIFY(lenient.err.startsWith("<stdin>:6:17: error: "));
    QCOMPARE(QJsonDocument::fromJson(lenient.out.toUtf8()).object()["bodies"].toInt(), 3);
    const test::Ended strict = test::carom({"run", "-", "-n", "1", "--strict"}, faulty);
    QCOMPARE(strict.exitCode, 1);
    QCOMPARE(strict.out, QString());
    QCOMPARE(test::carom({"run", "-", "-n", "1", "--strict"}, glide).exitCode, 0);
}

void RunTest::aLostStateEndsWithFourAndSaysWhere() {
    const QByteArray runaway = "gravity { accel 0, -1e308, 0 }\nsimulation { step 1 }\n"
                               "sphere rocket { radius 1  mass 1  centre 0, 0, 0 }\n";
    const QString file = path("lost.csv");
    const test::Ended ended = test::carom({"run", "-", "--json", "--trace", file}, runaway);
    QCOMPARE(ended.exitCode, 4);
    QVERIFY2(ended.err.contains(
                 QRegularExpression("^carom run: the (position|velocity) of `rocket` \\(body "
                                    "0\\) is not finite, or too large to follow, in frame \\d+; the run "
                                    "stops there\n$")),
             qPrintable(ended.err));
    // What was computed before is there, and finite.
    const int frames = QJsonDocument::fromJson(ended.out.toUtf8()).object()["frames"].toInt(-1);
    QVERIFY(frames >= 0 && frames < 10);
    const QString trace = test::readFile(file);
    QCOMPARE(test::linesOf(trace).size(), 1 + 1 + frames);
    QVERIFY(!trace.contains("inf") && !trace.contains("nan"));
}

void RunTest::aFrameOfTooMuchWorkEndsWithFourAndSaysWhy() {
    // Where no impact loses energy no other method may take over.
    const test::Ended ended =
        test::carom({"run", "-", "--method", "events"},
                    "sphere { radius 0.5  mass 1  centre 0, 0, 0  vel 1, 0, 1e11  elastic 1 }\n"
                    "sphere { radius 0.5  mass 1  centre 9, 0, 0  elastic 1 }\n");
    QCOMPARE(ended.exitCode, 4);
    QCOMPARE(ended.err, QString("carom run: the velocity of sphere 0 (body 0) is not finite, or too large to "
                                "follow, in frame 1; the run stops there\n"));
}

void RunTest::energyFromNowhereEndsWithFour() {
    const QByteArray swings = "simulation { method contacts  integrator euler }\ngravity { accel 0, 0, 0 }\n"
                              "sphere bob { radius 0.1  mass 1  centre 1.1, 0, 0 }\n"
                              "spring { from world  to bob  stiffness 1000  length 1 }\n";
    const QString file = path("rising.csv");
    const test::Ended ended = test::carom({"run", "-", "-n", "60", "--json", "--stats", file}, swings);
    QCOMPARE(ended.exitCode, 4);
    const QRegularExpression says("carom run: the scene gained [0-9.e+]+ J by frame (\\d+), where it had "
                                  "[0-9.]+ J to spend; most of it by spring");
    QVERIFY2(ended.err.contains(says), qPrintable(ended.err));
    // The frame that shows it is the last one written.
    const int frame = says.match(ended.err).captured(1).toInt();
    QCOMPARE(QJsonDocument::fromJson(ended.out.toUtf8()).object()["frames"].toInt(-1), frame);
    QCOMPARE(test::linesOf(test::readFile(file)).size(), 1 + frame);

    const test::Ended whole = test::carom({"run", "-", "-n", "60", "--json", "--keep-going"}, swings);
    QCOMPARE(whole.exitCode, 0);
    QVERIFY2(whole.err.contains(says) && whole.err.contains("not to be believed"), qPrintable(whole.err));
    QCOMPARE(QJsonDocument::fromJson(whole.out.toUtf8()).object()["frames"].toInt(-1), 60);
}

void RunTest::whatCannotBeWrittenEndsWithThree() {
    const QString scene = test::source("scenes/table.sdl");
    for (const QString& file : {QString("/dev/full"), QString("/nowhere/at/all.csv"), QString("/")})
        for (const char* option : {"--trace", "--stats"}) {
            const test::Ended ended = test::carom({"run", scene, "-n", "3", option, file});
            QCOMPARE(ended.exitCode, 3);
            QVERIFY2(ended.err.startsWith("carom run: cannot write `" + file + "`: "), qPrintable(ended.err));
        }
    const test::Ended full = test::shell("$carom run " + scene + " -n 3 > /dev/full");
    QCOMPARE(full.exitCode, 3);
    QCOMPARE(full.err, QString("carom run: cannot write standard output: No space left on device\n"));
    QCOMPARE(test::carom({"run", "/nowhere/at/all.sdl"}).exitCode, 3);
}

void RunTest::tracesGoToStandardOutputAndTheSummaryAside() {
    const test::Ended ended = test::carom({"run", "-", "-n", "2", "--stats", "-"}, glide);
    QCOMPARE(ended.exitCode, 0);
    QCOMPARE(test::linesOf(ended.out).size(), 3);
    QVERIFY(ended.out.startsWith(statsColumns));
    QVERIFY(ended.err.contains("state hash"));
}

void RunTest::anInterruptedRunWritesWhatItComputed() {
    const QString file = path("interrupted.csv");
    test::writeFile(path("glide.sdl"), glide);
    QProcess process;
    process.start(CAROM_PROGRAM, {"run", path("glide.sdl"), "-n", "1000000000", "--json", "--stats", file});
    // It runs once its file grows; then the signal cannot come too early.
    QTRY_VERIFY_WITH_TIMEOUT(QFileInfo(file).size() > 1000, test::longestWait);
    ::kill(static_cast<pid_t>(process.processId()), SIGINT);
    const test::Ended ended = test::finish(process);
    QCOMPARE(ended.exitCode, 130);
    const QJsonObject run = QJsonDocument::fromJson(ended.out.toUtf8()).object();
    QVERIFY(run["frames"].toInt() > 0);
    const QByteArray stats = test::readFile(file);
    QVERIFY(stats.endsWith('\n'));
    QCOMPARE(stats.count('\n'), 1 + run["frames"].toInt());
}

void RunTest::aReaderThatClosesThePipeIsNoError() {
    const test::Ended ended = test::shell("{ $carom run " + test::source("scenes/pyramid.sdl") +
                                          " -n 20 --trace -; echo \"code $?\" >&2; } | head -c 10");
    QCOMPARE(ended.out, QString("frame,time"));
    QCOMPARE(ended.err, QString("code 3\n"));
}

CAROM_TEST(run_test, RunTest)
#include "run_test.moc"
