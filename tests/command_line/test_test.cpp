// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/program.h"
#include "tests/support/test_class.h"

#include <QTest>
#include <QXmlStreamReader>

// `carom test`: what it prints, writes and ends with.

namespace carom::test {
namespace {

constexpr const char* rightScene = "gravity { accel 0, -10, 0 }\n"
                                   "sphere ball { radius 1  mass 1  centre 0, 0, 0 }\n"
                                   "expect fall { quantity y  of ball  at 1  value -5  within 1e-9 }\n"
                                   "expect { quantity energy  until 1  drift 1e-9  preset accurate }\n";
constexpr const char* wrongScene = "gravity { accel 0, -10, 0 }\n"
                                   "sphere ball { radius 1  mass 1  centre 0, 0, 0 }\n"
                                   "expect slow { quantity speed  until 1  max 5.01 }\n"
                                   "expect { quantity y  of ball  at 1  value -5  within 1e-9 }\n";

} // namespace

class TestTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void init() {
        m_folder = std::make_unique<QTemporaryDir>();
        writeFile(path("right.sdl"), rightScene);
        writeFile(path("wrong.sdl"), wrongScene);
        writeFile(path("broken.sdl"), QByteArray(rightScene) + "expect { quantity speed }\n");
    }

    void aSceneWhoseExpectationsHoldEndsWithZero() {
        const Ended ended = carom({"test", path("right.sdl")});
        QCOMPARE(ended.exitCode, 0);
        const QStringList lines = linesOf(ended.out);
        QCOMPARE(lines.size(), 3);
        QCOMPARE(lines[0], path("right.sdl") + ", preset default");
        QVERIFY2(lines[1].startsWith("  holds  line 3, fall: -5"), qPrintable(lines[1]));
        QCOMPARE(lines[2], "1 of 1 expectation holds, in 1 run of 1 scene");
        QCOMPARE(ended.err, QString());
    }

    void oneThatFailsEndsWithFiveAndSaysWhatWasMeasured() {
        const Ended ended = carom({"test", path("right.sdl"), path("wrong.sdl")});
        QCOMPARE(ended.exitCode, 5);
        QVERIFY2(ended.out.contains("  FAILS  line 3, slow: 10 m/s, at most 5.01, by `ball`, at 1 s\n"),
                 qPrintable(ended.out));
        QVERIFY(ended.out.contains("failed first in frame 31"));
        QVERIFY(ended.out.endsWith("2 of 3 expectations hold, in 2 runs of 2 scenes\n"));
    }

    void presetsAreChosenOneOrAll() {
        QVERIFY(carom({"test", "--preset=accurate", path("right.sdl")})
                    .out.endsWith("2 of 2 expectations hold, in 1 run of 1 scene\n"));
        const QString all = carom({"test", "--all-presets", path("right.sdl")}).out;
        QVERIFY2(all.endsWith("4 of 4 expectations hold, in 3 runs of 1 scene\n"), qPrintable(all));
        QVERIFY(all.contains("preset fast") && all.contains("preset default") &&
                all.contains("preset accurate"));
        QCOMPARE(carom({"test", "--all-presets", "--preset=fast", path("right.sdl")}).exitCode, 2);
        QCOMPARE(carom({"test", "--preset=best", path("right.sdl")}).exitCode, 2);
    }

    void theOutputIsTheSameOnAnyNumberOfThreads() {
        QStringList scenes;
        for (const char* name : {"bouncing_ball", "cradle", "table", "tour"})
            scenes += source(QStringLiteral("scenes/%1.sdl").arg(QLatin1String(name)));
        scenes += {path("right.sdl"), path("wrong.sdl")};
        const QStringList common = QStringList{"test", "--all-presets"} + scenes;
        const Ended one = carom(common + QStringList{"--threads=1", "--junit=" + path("1.xml")});
        const Ended many = carom(common + QStringList{"--threads=8", "--junit=" + path("8.xml")});
        QCOMPARE(one.exitCode, 5);
        QCOMPARE(many.out, one.out);
        QCOMPARE(readFile(path("8.xml")), readFile(path("1.xml")));
    }

    // Seed by seed the first cube of a tower stands somewhere else; the report names the worst.
    void aRepeatedExpectationNamesTheWorstSeed() {
        writeFile(path("cubes.sdl"), "generate cubes { scene tower  n 2 }\n"
                                     "expect { quantity x  of cubes  at 0  value 0  within 1e-9  repeat 3 }\n"
                                     "expect { quantity y  of cubes  at 0  min 0.4  repeat 3  seed 8 }\n");
        const Ended ended = carom({"test", path("cubes.sdl")});
        QCOMPARE(ended.exitCode, 5);
        QVERIFY2(ended.out.contains(", the worst of 3 runs\n"), qPrintable(ended.out));
        QVERIFY(ended.out.contains(", with seed 1") || ended.out.contains(", with seed 2") ||
                ended.out.contains(", with seed 3"));
        QVERIFY(ended.out.contains("in each of 3 runs"));
        // Seeds 1 to 3 and 8 to 10.
        QVERIFY2(ended.out.endsWith("1 of 2 expectations hold, in 6 runs of 1 scene\n"),
                 qPrintable(ended.out));
    }

    void tapCountsEveryLine() {
        const Ended ended =
            carom({"test", "--tap", path("right.sdl"), path("wrong.sdl"), path("broken.sdl")});
        QCOMPARE(ended.exitCode, 5);
        const QStringList lines = linesOf(ended.out);
        QCOMPARE(lines.first(), "TAP version 13");
        QCOMPARE(lines.last(), "1..5");
        QVERIFY(lines[1].startsWith("ok 1 - "));
        QVERIFY(lines[2].startsWith("not ok 2 - "));
        QVERIFY(lines[3].startsWith("# expected speed until 1 s: at most 5.01"));
        QVERIFY(ended.out.contains("not ok 5 - "));
    }

    void junitIsXmlThatCountsRight() {
        const QString file = path("report.xml");
        QCOMPARE(carom({"test", "--junit", file, path("right.sdl"), path("wrong.sdl"), path("broken.sdl")})
                     .exitCode,
                 5);
        QXmlStreamReader xml(readFile(file));
        int cases = 0, failures = 0, errors = 0, suites = 0;
        while (!xml.atEnd()) {
            if (xml.readNext() != QXmlStreamReader::StartElement) continue;
            const QXmlStreamAttributes attributes = xml.attributes();
            if (xml.name() == QLatin1String("testsuites")) {
                QCOMPARE(attributes.value("tests").toInt(), 5);
                QCOMPARE(attributes.value("failures").toInt(), 1);
                QCOMPARE(attributes.value("errors").toInt(), 1);
            }
            suites += xml.name() == QLatin1String("testsuite");
            cases += xml.name() == QLatin1String("testcase");
            failures += xml.name() == QLatin1String("failure");
            errors += xml.name() == QLatin1String("error");
        }
        QVERIFY2(!xml.hasError(), qPrintable(xml.errorString()));
        QCOMPARE(suites, 3);
        QCOMPARE(cases, 5);
        QCOMPARE(failures, 1);
        QCOMPARE(errors, 1);
    }

    void mistakesAndMissingFilesHaveTheirOwnExitCodes() {
        Ended ended = carom({"test", path("broken.sdl")});
        QCOMPARE(ended.exitCode, 1);
        QVERIFY2(ended.out.contains("broken.sdl:5:1: error: expect says nothing that must hold"),
                 qPrintable(ended.out));
        ended = carom({"test", path("none.sdl"), path("right.sdl")});
        QCOMPARE(ended.exitCode, 3);
        QVERIFY(ended.out.contains("cannot read") && ended.out.contains("  holds  "));
        QCOMPARE(carom({"test", "--junit", path("right.sdl"), path("right.sdl")}).exitCode, 2);
        QCOMPARE(readFile(path("right.sdl")), QByteArray(rightScene));
        QCOMPARE(carom({"test", "--junit", "/dev/null/x", path("right.sdl")}).exitCode, 3);
    }

    void aStateThatIsLostFailsWhatWasStillToCome() {
        writeFile(path("lost.sdl"), "simulation { method microcollisions  step 1  integrator euler }\n"
                                    "sphere a { radius 1  mass 1  centre 0, 5, 0 }\n"
                                    "spring { from world  to a  stiffness 1e300  length 1 }\n"
                                    "expect { quantity y  of a  at 100  value 0  within 1e300 }\n");
        const Ended ended = carom({"test", path("lost.sdl")});
        QCOMPARE(ended.exitCode, 5);
        QVERIFY2(ended.out.contains("is not finite, or too large to follow, in frame"),
                 qPrintable(ended.out));
    }

  private:
    QString path(const QString& name) const { return m_folder->filePath(name); }

    std::unique_ptr<QTemporaryDir> m_folder;
};

} // namespace carom::test

CAROM_TEST_WITH(QCoreApplication, test_test, carom::test::TestTest)
#include "test_test.moc"
