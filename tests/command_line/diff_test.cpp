// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/program.h"
#include "tests/support/test_class.h"

#include <QTest>

// `carom diff`: two runs of a scene beside each other.

namespace carom::test {
namespace {

constexpr const char* pendulum = "gravity { accel 0, -10, 0 }\n"
                                 "sphere bob { radius 0.1  mass 1  centre 1, 0, 0 }\n"
                                 "spring { from world  to bob  stiffness 100  length 1 }\n";

} // namespace

class DiffTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void init() { m_folder = std::make_unique<QTemporaryDir>(); }

    void twoRunsWithTheSameOptionsDifferInNoBit() {
        const Ended ended =
            carom({"diff", source("scenes/table.sdl"), "-n", "60", "--threads", "1", "--", "--threads", "2"});
        QCOMPARE(ended.exitCode, 0);
        QVERIFY2(ended.out.endsWith("no bit differs in 60 frames\n"), qPrintable(ended.out));
        QCOMPARE(linesOf(ended.out).size(), 3);
    }

    // Halving the step of a second-order scheme: apart from the first frame on, ever further.
    void theFirstDifferenceIsNamedAndTheDistanceGrows() {
        writeFile(path("a.sdl"), pendulum);
        const Ended ended = carom({"diff", path("a.sdl"), "-n", "120", "-o", path("d.csv"), "--substeps", "4",
                                   "--", "--substeps", "8"});
        QCOMPARE(ended.exitCode, 0);
        QVERIFY2(ended.out.contains("first difference: frame 1, 0.0166667 s: position of `bob`\n"),
                 qPrintable(ended.out));
        const QStringList rows = linesOf(QString::fromUtf8(readFile(path("d.csv"))));
        QCOMPARE(rows.size(), 122);
        QCOMPARE(rows[0], "frame,time,distance,body,label");
        QCOMPARE(rows[1], "0,0,0,-1,");
        const QStringList last = rows.last().split(',');
        QCOMPARE(last[0], "120");
        QCOMPARE(last[4], "bob");
        QVERIFY(last[2].toDouble() > 10 * rows[2].split(',')[2].toDouble());
        QVERIFY(ended.out.contains(QStringLiteral("after 120 frames: ")));
    }

    // An edit: half a metre at the start.
    void theSecondRunMayBeAnotherText() {
        writeFile(path("a.sdl"),
                  "gravity { accel 0, 0, 0 }\nsphere a { radius 1  mass 1  centre 0, 0, 0 }\n");
        writeFile(path("b.sdl"),
                  "gravity { accel 0, 0, 0 }\nsphere a { radius 1  mass 1  centre 0.5, 0, 0 }\n");
        const Ended ended = carom({"diff", path("a.sdl"), "-n", "3", "--", path("b.sdl")});
        QCOMPARE(ended.exitCode, 0);
        QVERIFY2(ended.out.contains("first difference: frame 0, 0 s: position of `a`\n"),
                 qPrintable(ended.out));
        QVERIFY(ended.out.endsWith("after 3 frames: 0.5 m apart\n"));
    }

    void whatCannotBeComparedIsWrongUsage() {
        writeFile(path("a.sdl"), pendulum);
        writeFile(path("b.sdl"), QByteArray(pendulum) + "sphere { radius 1  mass 1  centre 9, 9, 9 }\n");
        for (const QStringList& behind : {QStringList{"--step", "0.1"},
                                          {path("b.sdl")},
                                          {path("a.sdl"), path("b.sdl")},
                                          {"--subtseps", "2"}})
            QCOMPARE(carom(QStringList{"diff", path("a.sdl"), "--"} + behind).exitCode, 2);
        QCOMPARE(carom({"diff", path("a.sdl"), "-o", path("a.sdl")}).exitCode, 2);
        QCOMPARE(carom({"diff", path("none.sdl")}).exitCode, 3);
    }

  private:
    QString path(const QString& name) const { return m_folder->filePath(name); }

    std::unique_ptr<QTemporaryDir> m_folder;
};

} // namespace carom::test

CAROM_TEST_WITH(QCoreApplication, diff_test, carom::test::DiffTest)
#include "diff_test.moc"
