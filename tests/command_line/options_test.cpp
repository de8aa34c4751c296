// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/command.h"
#include "app/errors.h"

#include "tests/support/program.h"
#include "tests/support/test_class.h"

#include <QDir>
#include <QRegularExpression>
#include <QTest>

#include <algorithm>

using namespace carom;

// How a command line is read, and that the pages of help say all of it.

class OptionsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void valuesComeInEveryGnuForm_data();
    void valuesComeInEveryGnuForm();
    void theLastOfEqualOptionsHolds();
    void aLoneMinusAndWhatFollowsTwoAreOperands();
    void mistakesAreNamedWithTheirFixIt_data();
    void mistakesAreNamedWithTheirFixIt();
    void numbersMustBeWholeAndWithinTheirRange();
    void everyPageListsEveryOptionAndAnExample();
    void everyExampleBeginsWithItsCommand();
    void theProgramsPageNamesEverySubcommand();
    void theVersionIsPrinted();
    void wrongUsageEndsWithTwoAndPointsToHelp_data();
    void wrongUsageEndsWithTwoAndPointsToHelp();
    void withoutDisplayTheIdeSaysWhatToDo();
    void subcommandsStartWithoutQt();
    void aWindowThatIsNotInstalledEndsWithThree();
    void theShippedManualPageIsMadeFromTheTables();

  private:
    const std::vector<OptionRow> m_rows = {
        {"frames", 'n', "N", "how many"}, {"json", 'j', "", "as JSON"}, {"step", 0, "S", "how long"}};

    Arguments read(const std::vector<std::string>& words) const { return readArguments(words, m_rows); }
    QString mistakeIn(const std::vector<std::string>& words) const {
        try {
            (void)read(words);
        } catch (const UsageError& error) {
            return QString::fromUtf8(error.what());
        }
        return QStringLiteral("none");
    }
};

void OptionsTest::valuesComeInEveryGnuForm_data() {
    QTest::addColumn<QStringList>("words");
    QTest::newRow("two words") << QStringList{"--frames", "12"};
    QTest::newRow("equals") << QStringList{"--frames=12"};
    QTest::newRow("letter and word") << QStringList{"-n", "12"};
    QTest::newRow("letter and value") << QStringList{"-n12"};
    QTest::newRow("letters together") << QStringList{"-jn12"};
    QTest::newRow("behind an operand") << QStringList{"scene.sdl", "-n", "12"};
}

void OptionsTest::valuesComeInEveryGnuForm() {
    QFETCH(QStringList, words);
    std::vector<std::string> given;
    for (const QString& word : words) given.push_back(word.toStdString());
    QCOMPARE(read(given).wholeNumber("frames", 0, 100), std::optional<std::int64_t>(12));
}

void OptionsTest::theLastOfEqualOptionsHolds() {
    QCOMPARE(read({"--step", "1", "--step=2"}).text("step"), std::optional<std::string>("2"));
    QCOMPARE(read({"--step="}).text("step"), std::optional<std::string>(""));
    QVERIFY(!read({}).text("step"));
}

void OptionsTest::aLoneMinusAndWhatFollowsTwoAreOperands() {
    const Arguments arguments = read({"-", "--json", "--", "--json", "-n"});
    QVERIFY(arguments.has("json"));
    QCOMPARE(arguments.operands, (std::vector<std::string>{"-", "--json", "-n"}));
}

void OptionsTest::mistakesAreNamedWithTheirFixIt_data() {
    QTest::addColumn<QString>("word");
    QTest::addColumn<QString>("message");
    QTest::newRow("slip") << "--fraems"
                          << "unknown option `--fraems`; did you mean `--frames`?";
    QTest::newRow("slip with value") << "--stpe=3"
                                     << "unknown option `--stpe`; did you mean `--step`?";
    QTest::newRow("nothing near") << "--colour"
                                  << "unknown option `--colour`";
    QTest::newRow("letter") << "-x"
                            << "unknown option `-x`";
    QTest::newRow("no value") << "--frames"
                              << "option `--frames` needs a value: N";
    QTest::newRow("no value of a letter") << "-jn"
                                          << "option `-n` needs a value: N";
    QTest::newRow("value of a switch") << "--json=yes"
                                       << "option `--json` takes no value";
}

void OptionsTest::mistakesAreNamedWithTheirFixIt() {
    QFETCH(QString, word);
    QFETCH(QString, message);
    QCOMPARE(mistakeIn({word.toStdString()}), message);
}

void OptionsTest::numbersMustBeWholeAndWithinTheirRange() {
    for (const char* wrong : {"", "x", "1.5", "0", "101", "99999999999999999999", "1 "})
        QVERIFY_EXCEPTION_THROWN((void)read({"--frames", wrong}).wholeNumber("frames", 1, 100), UsageError);
    for (const char* wrong : {"", "x", "0", "-1", "nan", "inf", "1e999"})
        QVERIFY_EXCEPTION_THROWN((void)read({"--step", wrong}).positiveNumber("step"), UsageError);
    QCOMPARE(read({"--step", "1e-3"}).positiveNumber("step"), std::optional<double>(1e-3));
}

void OptionsTest::everyPageListsEveryOptionAndAnExample() {
    for (const CommandRow& command : commands()) {
        const QString name = QString::fromUtf8(command.name.data(), qsizetype(command.name.size()));
        const test::Ended ended = test::carom(name.split(QLatin1Char(' ')) << "--help");
        QCOMPARE(ended.exitCode, 0);
        QCOMPARE(ended.out, QString::fromStdString(helpOf(command)));
        for (const OptionRow& row : command.options) {
            QVERIFY2(ended.out.contains("--" + QString::fromStdString(row.name)), row.name.c_str());
            QVERIFY2(!row.help.empty(), row.name.c_str());
            if (row.letter) QVERIFY(ended.out.contains(QStringLiteral("-%1, ").arg(QLatin1Char(row.letter))));
        }
        QVERIFY(ended.out.contains("--help"));
        QVERIFY(ended.out.contains("Example:\n  carom "));
        for (const QString& line : test::linesOf(ended.out.section("Options:", 1).section("\n\n", 0, 0)))
            QVERIFY2(line.size() <= 100, qPrintable(line));
    }
}

void OptionsTest::everyExampleBeginsWithItsCommand() {
    for (const CommandRow& command : commands())
        QVERIFY(command.example.starts_with("carom " + std::string(command.name)));
}

void OptionsTest::theProgramsPageNamesEverySubcommand() {
    const test::Ended ended = test::carom({"--help"});
    QCOMPARE(ended.exitCode, 0);
    for (const CommandRow& command : commands()) {
        QVERIFY(ended.out.contains(QString::fromStdString("\n  " + std::string(command.name) + " ")));
        QVERIFY(!command.summary.empty() && !command.summary.ends_with('.'));
    }
    for (const OptionRow& row : ideOptions())
        QVERIFY(ended.out.contains("--" + QString::fromStdString(row.name)));
}

void OptionsTest::theVersionIsPrinted() {
    const test::Ended ended = test::carom({"--version"});
    QCOMPARE(ended.exitCode, 0);
    QVERIFY(QRegularExpression(QStringLiteral("^carom \\d+\\.\\d+\\.\\d+\n$")).match(ended.out).hasMatch());
}

void OptionsTest::wrongUsageEndsWithTwoAndPointsToHelp_data() {
    QTest::addColumn<QStringList>("words");
    QTest::addColumn<QString>("message");
    QTest::newRow("slip in a subcommand")
        << QStringList{"chekc", "a.sdl"}
        << "carom: `chekc` is neither a subcommand nor a file; did you mean `check`?";
    QTest::newRow("option") << QStringList{"run", "a.sdl", "--fames", "3"}
                            << "carom run: unknown option `--fames`; did you mean `--frames`?";
    QTest::newRow("operand missing") << QStringList{"run"} << "carom run: missing SCENE";
    QTest::newRow("operand too many")
        << QStringList{"run", "a", "b"} << "carom run: `b` is one operand too many; it takes SCENE";
    QTest::newRow("value") << QStringList{"run", "a.sdl", "-n", "-3"}
                           << "carom run: `--frames` is `-3`; it must be a whole number from 0 on";
    QTest::newRow("word") << QStringList{"run", "a.sdl", "--broadphase", "all_pais"}
                          << "carom run: `--broadphase` is `all_pais`; did you mean `all_pairs`?";
    QTest::newRow("every without trace")
        << QStringList{"run", test::source("scenes/table.sdl"), "--every", "2"}
        << "carom run: `--every` needs `--trace`";
    QTest::newRow("format") << QStringList{"check", "--format", "xml", "a"}
                            << "carom check: `--format` is `xml`; it must be `text` or `json`";
    QTest::newRow("generator") << QStringList{"generate", "piramid"}
                               << "carom generate: there is no generator `piramid`; did you mean `pyramid`?";
    QTest::newRow("generator's option")
        << QStringList{"generate", "table", "--n", "3"}
        << "carom generate: `table` takes no --n; its number of bodies is fixed";
    QTest::newRow("family alone") << QStringList{"study"}
                                  << "carom: `study` alone says too little; it must be `study` followed by "
                                     "`accuracy`, `gas` or `stability`";
    QTest::newRow("no such study") << QStringList{"study", "nothing"}
                                   << "carom: there is no study `nothing`; it must be `study` followed by "
                                      "`accuracy`, `gas` or `stability`";
    QTest::newRow("both to standard output")
        << QStringList{"run", "--trace", "-", "--stats", "-", test::source("scenes/tower.sdl")}
        << "carom run: `--trace` and `--stats` cannot both be standard output";
    for (const char* size : {"5x5", "960", "x", "960x600x2", "99999x600", "-960x600"})
        QTest::newRow(size)
            << QStringList{"--picture", "a.png", "--size", size, test::source("scenes/tower.sdl")}
            << QStringLiteral("carom: `--size` is `%1`; it must be two whole numbers from 16 to 16384 such "
                              "as `960x600`")
                   .arg(size);
    QTest::newRow("size without picture")
        << QStringList{"--size", "960x600", test::source("scenes/tower.sdl")}
        << "carom: `--size` belongs to `--picture`, which is not there";
    for (const char* list : {"1,x", "0", "1,,2", "4097"})
        QTest::newRow(list) << QStringList{"study", "accuracy", test::source("scenes/tower.sdl"),
                                           "--substeps", list}
                            << QStringLiteral("carom study accuracy: `--substeps` has `%1`; it must be a "
                                              "list of whole numbers from 1 to 4096, separated by commas")
                                   .arg(QString::fromLatin1(list).contains('x')    ? "x"
                                        : QString::fromLatin1(list).contains(",,") ? ""
                                                                                   : list);
    QTest::newRow("two scenes for the IDE") << QStringList{test::source("README.md"), "b.sdl"}
                                            << "carom: `b.sdl` is one scene too many; the IDE opens one";
}

void OptionsTest::wrongUsageEndsWithTwoAndPointsToHelp() {
    QFETCH(QStringList, words);
    QFETCH(QString, message);
    const test::Ended ended = test::carom(words);
    QCOMPARE(ended.exitCode, 2);
    QCOMPARE(ended.out, QString());
    const QString who = message.section(':', 0, 0);
    QCOMPARE(test::linesOf(ended.err), (QStringList{message, "Try `" + who + " --help`."}));
}

void OptionsTest::withoutDisplayTheIdeSaysWhatToDo() {
    const test::Ended ended = test::shell("unset DISPLAY WAYLAND_DISPLAY QT_QPA_PLATFORM; $carom " +
                                          test::source("scenes/table.sdl"));
    QCOMPARE(ended.exitCode, 2);
    QVERIFY2(ended.err.contains("`carom run SCENE` simulates without"), qPrintable(ended.err));
}

void OptionsTest::subcommandsStartWithoutQt() {
    // Loading it took 13 of the 16 ms of a start.
    const test::Ended ended = test::shell("LD_TRACE_LOADED_OBJECTS=1 \"$carom\"");
    QVERIFY2(ended.out.contains("libc.so"), qPrintable(ended.out)); // or it was not asked
    QVERIFY2(!ended.out.contains("Qt"), qPrintable(ended.out));
}

void OptionsTest::aWindowThatIsNotInstalledEndsWithThree() {
#ifdef CAROM_CHARTS
    const QTemporaryDir folder;
    const QString copy = folder.filePath("bin/carom");
    QVERIFY(QDir(folder.path()).mkdir("bin") && QFile::copy(QStringLiteral(CAROM_PROGRAM), copy));
    const QString why =
        "cannot start `" + folder.filePath("lib/carom/carom-window") + "`: No such file or directory";
    const QString scene = test::source("scenes/table.sdl");
    for (const QStringList& words : {QStringList{scene, "--picture", folder.filePath("a.png")},
                                     {"study", "accuracy", scene, "-o", folder.filePath("out")}}) {
        QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
        environment.insert("DISPLAY", ":987");
        const test::Ended ended = test::runCommand(copy, words, {}, environment);
        QCOMPARE(ended.exitCode, 3);
        QVERIFY2(ended.err.contains(why), qPrintable(ended.err));
    }
    QCOMPARE(test::runCommand(copy, {"check", scene}).exitCode, 0);
#endif
}

void OptionsTest::theShippedManualPageIsMadeFromTheTables() {
    const QString path = test::source("packaging/carom.1");
    if (qEnvironmentVariableIsSet("CAROM_UPDATE"))
        test::writeFile(path, QByteArray::fromStdString(manualPage()));
    QVERIFY2(test::readFile(path) == QByteArray::fromStdString(manualPage()),
             "this test writes it anew when CAROM_UPDATE is set");
}

CAROM_TEST(options_test, OptionsTest)
#include "options_test.moc"
