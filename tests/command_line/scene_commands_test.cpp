// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/generators/generator.h"

#include "tests/support/program.h"
#include "tests/support/test_class.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QRegularExpression>
#include <QTemporaryDir>
#include <QTest>

using namespace carom;

// effects, contacts and generate.

class SceneCommandsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void effectsAreOneLineEachWithTheLineThatCallsForThem();
    void effectsAsJsonSayTheSame();
    void contactsOfAPairAreOneRowAPoint();
    void contactsAtALaterFrameAreThoseOfThatFrame();
    void aSceneApartHasNoContacts();
    void generatedTextIsThatOfTheCatalogue();
    void theListNamesEveryGenerator();
    void everyGeneratedSceneChecksAndRuns();
    void optionsOfOtherGeneratorsAreRefused();
    void fullDisksAndMissingFilesEndWithThree();
};

void SceneCommandsTest::effectsAreOneLineEachWithTheLineThatCallsForThem() {
    const QByteArray scene = "wall { normal 0, 1, 0  toOrig 0 }\n"
                             "sphere { radius 1  mass 1  centre 0, 1, 0  elastic 0.5 }\n";
    const test::Ended ended = test::carom({"effects", "-"}, scene);
    QCOMPARE(ended.exitCode, 0);
    QVERIFY2(ended.out.contains(QRegularExpression("(?m)^restitution +on +<stdin>:2:\\d+: .+$")),
             qPrintable(ended.out));
    QVERIFY2(ended.out.contains(QRegularExpression("(?m)^friction +absent +.+$")), qPrintable(ended.out));
}

void SceneCommandsTest::effectsAsJsonSayTheSame() {
    const QString scene = test::source("scenes/tour.sdl");
    const QStringList lines = test::linesOf(test::carom({"effects", scene}).out);
    const test::Ended ended = test::carom({"effects", scene, "--json"});
    const QJsonArray effects = QJsonDocument::fromJson(ended.out.toUtf8()).array();
    QCOMPARE(effects.size(), lines.size());
    for (int i = 0; i < lines.size(); ++i) {
        const QJsonObject effect = effects[i].toObject();
        QVERIFY(lines[i].startsWith(effect["effect"].toString() + ' '));
        QVERIFY(lines[i].contains(' ' + effect["status"].toString() + ' '));
        QVERIFY(lines[i].endsWith(effect["reason"].toString()));
        if (!effect["line"].isNull())
            QVERIFY(lines[i].contains(
                QString(":%1:%2: ").arg(effect["line"].toInt()).arg(effect["column"].toInt())));
    }
}

void SceneCommandsTest::contactsOfAPairAreOneRowAPoint() {
    // Radii 1 and 0.5, centres 1.25 apart: the overlap is 0.25, the normal runs along x from 0 to 1.
    const QByteArray scene = "sphere { radius 1  mass 1  centre 0, 0, 0 }\n"
                             "sphere { radius 0.5  mass 1  centre 1.25, 0, 0 }\n";
    const test::Ended ended = test::carom({"contacts", "-"}, scene);
    QCOMPARE(ended.exitCode, 0);
    QCOMPARE(test::linesOf(ended.out),
             QStringList({"a,b,depth,nx,ny,nz,ax,ay,az,bx,by,bz", "0,1,0.25,1,0,0,1,0,0,0.75,0,0"}));
}

void SceneCommandsTest::contactsAtALaterFrameAreThoseOfThatFrame() {
    // By explicit Euler the sphere has fallen g h² (0 + 1 + ... + (n - 1)) = n (n - 1) / 4 metres after n
    // frames: exactly the 3 m it stands above the floor in frame 4, where it stops (elastic 0).
    const QByteArray scene = "gravity { accel 0, -8, 0 }\nsimulation { step 0.25 }\n"
                             "wall { normal 0, 1, 0  toOrig 0  elastic 0 }\n"
                             "sphere { radius 1  mass 1  centre 0, 4, 0 }\n";
    for (const char* early : {"0", "1", "2", "3"})
        QCOMPARE(test::linesOf(test::carom({"contacts", "-", "--at", early}, scene).out).size(), 1);
    const QStringList rows = test::linesOf(test::carom({"contacts", "-", "--at", "4"}, scene).out);
    QCOMPARE(rows.size(), 2);
    QVERIFY2(rows[1].startsWith("0,1,0,0,1,0,"), qPrintable(rows[1]));
}

void SceneCommandsTest::aSceneApartHasNoContacts() {
    const test::Ended ended = test::carom({"contacts", test::source("scenes/spinning_cylinder.sdl")});
    QCOMPARE(ended.exitCode, 0);
    QCOMPARE(test::linesOf(ended.out).size(), 1);
}

void SceneCommandsTest::generatedTextIsThatOfTheCatalogue() {
    const test::Ended ended =
        test::carom({"generate", "brownian", "--n", "30", "--seed", "18446744073709551615", "--packing=0.1"});
    QCOMPARE(ended.exitCode, 0);
    const GeneratorRequest request{.n = 30, .seed = ~0ULL, .options = {{"packing", 0.1}}};
    QCOMPARE(ended.out, QString::fromStdString(generate(*findGenerator("brownian"), request)));
}

void SceneCommandsTest::theListNamesEveryGenerator() {
    const test::Ended ended = test::carom({"generate", "--list"});
    QCOMPARE(ended.exitCode, 0);
    QCOMPARE(test::linesOf(ended.out).size(), static_cast<qsizetype>(generators().size()));
    for (const GeneratorRow& row : generators())
        QVERIFY(ended.out.contains(QString::fromStdString(std::string(row.name) + " ")));
}

void SceneCommandsTest::everyGeneratedSceneChecksAndRuns() {
    const QTemporaryDir folder;
    QStringList files;
    for (const GeneratorRow& row : generators()) {
        const QString name = QString::fromStdString(std::string(row.name));
        const QByteArray text = test::carom({"generate", name}).out.toUtf8();
        QCOMPARE(test::carom({"run", "-", "-n", "3", "--strict"}, text).exitCode, 0);
        QCOMPARE(test::carom({"format", "-"}, text).out, QString::fromUtf8(text));
        files += folder.filePath(name + ".sdl");
        test::writeFile(files.last(), text);
    }
    const test::Ended checked = test::carom(QStringList{"check"} + files);
    QCOMPARE(checked.out, QString());
    QCOMPARE(checked.exitCode, 0);
}

void SceneCommandsTest::optionsOfOtherGeneratorsAreRefused() {
    const test::Ended ended = test::carom({"generate", "table", "--packing", "0.1"});
    QCOMPARE(ended.exitCode, 2);
    QVERIFY2(ended.err.startsWith("carom generate: `table` has no option --packing\n"),
             qPrintable(ended.err));
    QCOMPARE(test::carom({"generate", "brownian", "--packing", "much"}).exitCode, 2);
    QCOMPARE(test::carom({"generate", "brownian", "--packing", "7"}).exitCode, 2);
    QCOMPARE(test::carom({"generate", "brownian", "--seed", "-1"}).exitCode, 2);
    QCOMPARE(test::carom({"generate"}).exitCode, 2);
}

void SceneCommandsTest::fullDisksAndMissingFilesEndWithThree() {
    for (const char* line : {"$carom generate table > /dev/full", "$carom effects /nowhere.sdl",
                             "$carom contacts /nowhere.sdl", "$carom generate --list > /dev/full"}) {
        const test::Ended ended = test::shell(line);
        QCOMPARE(ended.exitCode, 3);
        QVERIFY2(ended.err.contains(": cannot "), qPrintable(ended.err));
    }
}

CAROM_TEST(scene_commands_test, SceneCommandsTest)
#include "scene_commands_test.moc"
