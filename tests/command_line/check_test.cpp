// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/random.h"

#include "tests/support/program.h"
#include "tests/support/test_class.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QRegularExpression>
#include <QTest>

using namespace carom;

class CheckTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aRightSceneGivesNothingAndZero();
    void aMistakeIsOneLineWithItsPlaceAndOne();
    void warningsAreShownAndEndWithZero();
    void twentyMistakesAreTwentyDiagnosticsOfTwentyKinds();
    void theRightDeclarationsAroundTwentyMistakesRun();
    void columnsCountCharacters();
    void jsonSaysTheSameAsText();
    void jsonOfARightSceneIsAnEmptyList();
    void theFixInJsonCorrectsTheText();
    void severalScenesAreCheckedEvenIfOneCannotBeRead();
    void foldersAndEndlessFilesEndWithThreeOrOne();
    void randomBytesEndWithZeroOrOne();

  private:
    const QString m_mistakes = test::source("tests/command_line/data/twenty_mistakes.sdl");
    static QJsonArray json(const QStringList& words, const QByteArray& input = {}) {
        const test::Ended ended = test::carom(QStringList{"check", "--format", "json"} + words, input);
        return QJsonDocument::fromJson(ended.out.toUtf8()).array();
    }
};

void CheckTest::aRightSceneGivesNothingAndZero() {
    const test::Ended ended = test::carom({"check", test::source("scenes/pool_break.sdl")});
    QCOMPARE(ended.exitCode, 0);
    QCOMPARE(ended.out + ended.err, QString());
}

void CheckTest::aMistakeIsOneLineWithItsPlaceAndOne() {
    const test::Ended ended = test::carom({"check", "-"}, "\nsphere { raduis 1  mass 1  centre 0, 0, 0 }\n");
    QCOMPARE(ended.exitCode, 1);
    QCOMPARE(ended.out,
             QString("<stdin>:2:10: error: `raduis` is not a parameter of sphere; did you mean `radius`? "
                     "[sdl-unknown-parameter]\n"));
    QCOMPARE(ended.err, QString());
}

void CheckTest::warningsAreShownAndEndWithZero() {
    const QByteArray overlapping = "sphere { radius 1  mass 1  centre 0, 0, 0 }\n"
                                   "sphere { radius 1  mass 1  centre 1, 0, 0 }\n";
    const test::Ended ended = test::carom({"check", "-"}, overlapping);
    QCOMPARE(ended.exitCode, 0);
    QVERIFY2(ended.out.contains(": warning: ") && ended.out.contains("[sdl-overlap-at-start]"),
             qPrintable(ended.out));
}

void CheckTest::twentyMistakesAreTwentyDiagnosticsOfTwentyKinds() {
    const test::Ended ended = test::carom({"check", m_mistakes});
    QCOMPARE(ended.exitCode, 1);
    const QRegularExpression form("^[^:]+:(\\d+):(\\d+): (error|note): .+$");
    const QRegularExpression code(" \\[(sdl-[a-z-]+)\\]$");
    QSet<QString> codes;
    int errors = 0;
    for (const QString& line : test::linesOf(ended.out)) {
        const QRegularExpressionMatch match = form.match(line);
        QVERIFY2(match.hasMatch(), qPrintable(line));
        if (match.captured(3) == "note") continue;
        ++errors;
        codes.insert(code.match(line).captured(1));
    }
    QCOMPARE(errors, 20);
    QCOMPARE(codes.size(), 20);
}

void CheckTest::theRightDeclarationsAroundTwentyMistakesRun() {
    const test::Ended ended = test::carom({"run", m_mistakes, "-n", "30", "--json"});
    QCOMPARE(ended.exitCode, 0);
    const QJsonObject summary = QJsonDocument::fromJson(ended.out.toUtf8()).object();
    // `floor`, `good`, `fine` and the one whose second radius is the mistake: there the first holds.
    QCOMPARE(summary["bodies"].toInt(), 4);
    QCOMPARE(summary["mobile"].toInt(), 3);
    QCOMPARE(summary["diagnostics"].toInt(), 20);
    QCOMPARE(ended.err.count(": error: "), 20);
    QCOMPARE(test::carom({"run", m_mistakes, "--strict"}).exitCode, 1);
}

void CheckTest::columnsCountCharacters() {
    const test::Ended ended = test::carom({"check", "-"}, "// é€😀\n\xEF\xBB\xBF"
                                                          "é");
    QVERIFY2(ended.out.startsWith("<stdin>:2:"), qPrintable(ended.out));
    const test::Ended same = test::carom({"check", "-"}, "camera ; \t@\n");
    QVERIFY2(same.out.startsWith("<stdin>:1:11: error:"), qPrintable(same.out));
}

void CheckTest::jsonSaysTheSameAsText() {
    const QStringList lines = test::linesOf(test::carom({"check", m_mistakes}).out);
    QStringList fromJson;
    for (const QJsonValue value : json({m_mistakes})) {
        const QJsonObject object = value.toObject();
        fromJson +=
            QString("%1:%2:%3: %4: %5 [%6]")
                .arg(object["file"].toString())
                .arg(object["line"].toInt())
                .arg(object["column"].toInt())
                .arg(object["severity"].toString(), object["message"].toString(), object["code"].toString());
        for (const QJsonValue note : object["notes"].toArray())
            fromJson += QString("%1:%2:%3: note: %4")
                            .arg(object["file"].toString())
                            .arg(note["line"].toInt())
                            .arg(note["column"].toInt())
                            .arg(note["message"].toString());
    }
    QCOMPARE(fromJson, lines);
}

void CheckTest::jsonOfARightSceneIsAnEmptyList() {
    QCOMPARE(test::carom({"check", "--format=json", test::source("scenes/table.sdl")}).out, QString("[]\n"));
}

void CheckTest::theFixInJsonCorrectsTheText() {
    QByteArray text = "sphere { raduis 1  mass 1  centre 0, 0, 0 }\n";
    const QJsonArray diagnostics = json({"-"}, text);
    QCOMPARE(diagnostics.size(), 1);
    const QJsonObject fix = diagnostics[0]["fix"].toObject();
    QCOMPARE(fix["title"].toString(), QString("change to `radius`"));
    text.replace(fix["offset"].toInt(), fix["length"].toInt(), fix["text"].toString().toUtf8());
    QCOMPARE(json({"-"}, text), QJsonArray());
}

void CheckTest::severalScenesAreCheckedEvenIfOneCannotBeRead() {
    const test::Ended ended = test::carom({"check", "/nowhere/at/all.sdl", m_mistakes});
    QCOMPARE(ended.exitCode, 3);
    QCOMPARE(ended.err,
             QString("carom check: cannot read `/nowhere/at/all.sdl`: No such file or directory\n"));
    QCOMPARE(ended.out.count(": error: "), 20);
}

void CheckTest::foldersAndEndlessFilesEndWithThreeOrOne() {
    const test::Ended folder = test::carom({"check", "/"});
    QCOMPARE(folder.exitCode, 3);
    QVERIFY2(folder.err.contains("cannot read `/`: Is a directory"), qPrintable(folder.err));
    const test::Ended endless = test::carom({"check", "/dev/zero"});
    QCOMPARE(endless.exitCode, 3);
    QVERIFY2(endless.err.contains("cannot read `/dev/zero`: it is a device"), qPrintable(endless.err));
    const test::Ended piped = test::shell("\"$carom\" check - < /dev/zero");
    QCOMPARE(piped.exitCode, 3);
    const test::Ended large = test::shell("head -c 67108865 /dev/zero | \"$carom\" check -");
    QCOMPARE(large.exitCode, 1);
    QVERIFY2(large.out.contains("<stdin>:1:1: error: ") && large.out.contains("[sdl-text-too-large]"),
             qPrintable(large.out.left(300)));
}

void CheckTest::randomBytesEndWithZeroOrOne() {
    // A few dozen through the whole program; the analysis itself meets a hundred thousand elsewhere.
    constexpr std::uint64_t seed = 20261121;
    Random random(seed);
    const QByteArray scene = test::readFile(test::source("scenes/tour.sdl"));
    for (int round = 0; round < 40; ++round) {
        QByteArray bytes;
        if (round % 2 == 0) {
            for (std::uint64_t i = random.below(3000); i > 0; --i)
                bytes += static_cast<char>(random.below(256));
        } else {
            bytes = scene;
            for (std::uint64_t i = random.below(30); i > 0; --i)
                bytes[static_cast<qsizetype>(random.below(static_cast<std::uint64_t>(bytes.size())))] =
                    static_cast<char>(random.below(256));
        }
        const test::Ended ended = test::carom({"check", "--format", "json", "-"}, bytes);
        QVERIFY2(ended.exitCode == 0 || ended.exitCode == 1,
                 qPrintable(QString("seed %1 round %2").arg(seed).arg(round)));
        QVERIFY(QJsonDocument::fromJson(ended.out.toUtf8()).isArray());
    }
}

CAROM_TEST(check_test, CheckTest)
#include "check_test.moc"
