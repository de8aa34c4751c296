// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/program.h"
#include "tests/support/test_class.h"

#include "core/study/stability.h"

#include <QDir>
#include <QRegularExpression>
#include <QTest>

namespace carom::test {

class StudyStabilityTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void itWritesFiguresAndASummary() {
        const QTemporaryDir folder;
        const Ended ended = carom({"study", "stability", "elastic_ball", "7", "-o", folder.filePath("new")});
        QCOMPARE(ended.exitCode, 0);
        const QStringList rows = linesOf(QString::fromUtf8(readFile(folder.filePath("new/stability.csv"))));
        QVERIFY(rows[1].startsWith("1,elastic_ball,default,energy,"));
        QVERIFY(rows[1].contains("carom study stability elastic_ball 7 --output="));
        QCOMPARE(QString::fromUtf8(readFile(folder.filePath("new/summary.txt"))), ended.out);
        QVERIFY(ended.out.contains("default: 2 of 2 hold\naccurate: 2 of 2 hold\nexact: 1 of 1 hold\n"));
        QCOMPARE(ended.err, QString());
    }

    void oneColumnCanBeAskedFor() {
        const Ended ended = carom({"study", "stability", "1", "--column=exact"});
        QCOMPARE(ended.exitCode, 0);
        QVERIFY(ended.out.endsWith("\nexact: 1 of 1 hold\n"));
        QVERIFY(!ended.out.contains("accurate: "));
    }

    // It said "elastic_ball", as files do.
    void theListNamesEveryCaseAsAReaderSaysIt() {
        const QString list = carom({"study", "stability", "--list"}).out;
        for (const HardCase& row : hardCases())
            QVERIFY2(
                list.contains(QString::fromStdString(std::to_string(row.number) + " " + spokenName(row))),
                row.name.data());
        QVERIFY(list.contains("\n11 Euler's disk  "));
        static const QRegularExpression underscores(QStringLiteral("^ ?[0-9]+ [^ ]*_"),
                                                    QRegularExpression::MultilineOption);
        QVERIFY2(!list.contains(underscores), qPrintable(underscores.match(list).captured()));
    }

    void aCaseIsFoundByNumberAndBothItsNames() {
        const HardCase* disk = findHardCase("11");
        QVERIFY(disk != nullptr && disk == findHardCase("eulers_disk"));
        QCOMPARE(spokenName(*disk), std::string("Euler's disk"));
        for (const HardCase& row : hardCases()) QCOMPARE(findHardCase(spokenName(row)), &row);
        const Ended ended = carom({"study", "stability", "Elastic ball", "--column=exact"});
        QCOMPARE(ended.exitCode, 0);
        QVERIFY2(ended.out.startsWith("1 Elastic ball, exact: holds"), qPrintable(ended.out));
    }

    // Three cases in two parts, and the same in one: nothing differs but the time taken.
    void partsTogetherAreTheWhole() {
        const QTemporaryDir folder;
        const QString parts = folder.filePath("parts"), whole = folder.filePath("whole");
        const auto study = [](const QString& into, const QStringList& more) {
            return carom(QStringList{"study", "stability", "1", "13", "43", "--column=default", "-o", into} +
                         more);
        };
        const auto rowsOf = [](const QString& into) {
            QStringList rows = linesOf(QString::fromUtf8(readFile(into + "/stability.csv")));
            for (QString& row : rows) { // without the time, and without the folder that the command names
                QStringList cells = row.split(',');
                cells.removeAt(8);
                row = cells.mid(0, 8).join(',');
            }
            return rows;
        };
        QCOMPARE(study(whole, {}).exitCode, 0);
        QCOMPARE(study(parts, {"--shard=2/2"}).exitCode, 0);
        const Ended early = carom({"study", "stability", "--merge", parts});
        QCOMPARE(early.exitCode, 3);
        QVERIFY2(early.err.contains("these parts are missing: 1/2"), qPrintable(early.err));
        QCOMPARE(study(parts, {"--shard=1/2"}).exitCode, 0);
        QCOMPARE(carom({"study", "stability", "--merge", parts}).exitCode, 0);
        QVERIFY(rowsOf(whole).size() > 3);
        QCOMPARE(rowsOf(parts), rowsOf(whole));
        QVERIFY(!readFile(parts + "/stability.csv").contains("--shard"));
        QCOMPARE(carom({"study", "stability", "--merge", whole}).exitCode, 2);
        QCOMPARE(study(parts, {"--shard=1/3"}).exitCode, 0);
        QVERIFY(carom({"study", "stability", "--merge", parts}).err.contains("has parts of"));
    }

    void aCaseComesAsAScene() {
        const QTemporaryDir folder;
        const Ended ended = carom({"study", "stability", "--scene=sliding_cube", "--column=accurate"});
        QCOMPARE(ended.exitCode, 0);
        QCOMPARE(ended.out.toStdString(), sceneOf(*findHardCase("13"), StudyColumn::Accurate));
    }

    void aWrongWordIsNamedWithTheNearestRightOne() {
        Ended ended = carom({"study", "stability", "elastic_bal"});
        QCOMPARE(ended.exitCode, 2);
        QVERIFY(ended.err.contains("there is no hard case `elastic_bal`; did you mean `elastic_ball`?"));
        ended = carom({"study", "stability", "1", "--column=fast"});
        QCOMPARE(ended.exitCode, 2);
        ended = carom({"study", "stability", "1", "-o", "/dev/null/x"});
        QCOMPARE(ended.exitCode, 3);
    }
};

} // namespace carom::test

CAROM_TEST_WITH(QCoreApplication, study_stability_test, carom::test::StudyStabilityTest)
#include "study_stability_test.moc"
