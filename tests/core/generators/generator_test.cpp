// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/generators/generator.h"
#include "core/generators/portable.h"

#include <QTest>

#include <algorithm>
#include <cmath>

using namespace carom;

// What holds of every generator, by enumerating the catalogue.

class GeneratorTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void everyRowSaysWhatItIs();
    void equalRequestsGiveEqualBytes();
    void anotherSeedGivesAnotherScene();
    void aSceneBeginsWithTheCommandThatMakesIt();
    void everySceneHasACamera();
    void impossibleRequestsAreRefusedWithTheReason();
    void theCubeRootIsExactOnCubesAndCloseElsewhere();
};

void GeneratorTest::everyRowSaysWhatItIs() {
    QVERIFY(generators().size() >= 6);
    for (const GeneratorRow& row : generators()) {
        QVERIFY(!row.name.empty());
        QVERIFY(!row.help.empty());
        QVERIFY(row.generate != nullptr);
        QCOMPARE(findGenerator(row.name), &row);
        QVERIFY(row.defaultN == 0 || (row.minimumN <= row.defaultN && row.defaultN <= row.maximumN));
        for (const GeneratorOption& option : row.options) {
            QVERIFY(!option.help.empty());
            QVERIFY(option.minimum <= option.defaultValue && option.defaultValue <= option.maximum);
            QVERIFY2(option.name != "n" && option.name != "seed" && option.name != "help",
                     "names that the command line takes itself");
        }
    }
    QVERIFY(findGenerator("no_such_scene") == nullptr);
}

void GeneratorTest::equalRequestsGiveEqualBytes() {
    for (const GeneratorRow& row : generators())
        for (const std::uint64_t seed : {1ULL, 77ULL, ~0ULL})
            QCOMPARE(generate(row, {.n = {}, .seed = seed, .options = {}}),
                     generate(row, {.n = {}, .seed = seed, .options = {}}));
}

void GeneratorTest::anotherSeedGivesAnotherScene() {
    for (const GeneratorRow& row : generators()) {
        GeneratorRequest one{.n = {}, .seed = 1, .options = {}};
        for (const GeneratorOption& option : row.options)
            if (option.name == "jitter") one.options.emplace(option.name, option.maximum);
        GeneratorRequest two = one;
        two.seed = 2;
        // Beyond the comment, which names the seed.
        const std::string a = generate(row, one), b = generate(row, two);
        QVERIFY(a.substr(a.find("\n\n")) != b.substr(b.find("\n\n")));
    }
}

void GeneratorTest::aSceneBeginsWithTheCommandThatMakesIt() {
    for (const GeneratorRow& row : generators()) {
        GeneratorRequest request{.n = {}, .seed = 42, .options = {}};
        if (row.defaultN > 0) request.n = row.minimumN;
        for (const GeneratorOption& option : row.options)
            request.options.emplace(option.name, option.maximum);
        const std::string text = generate(row, request);
        const std::size_t begin = text.find("carom generate " + std::string(row.name));
        QVERIFY(text.starts_with("// ") && begin != std::string::npos);
        const std::string command = text.substr(begin, text.find('\n', begin) - begin);
        QVERIFY(command.find("--seed 42") != std::string::npos);
        for (const GeneratorOption& option : row.options)
            QVERIFY(command.find("--" + std::string(option.name) + " ") != std::string::npos);
        QVERIFY(text.find("What to look for:") != std::string::npos);
    }
}

void GeneratorTest::everySceneHasACamera() {
    for (const GeneratorRow& row : generators())
        QVERIFY(generate(row, {}).find("\ncamera {") != std::string::npos);
}

void GeneratorTest::impossibleRequestsAreRefusedWithTheReason() {
    const GeneratorRow& brownian = *findGenerator("brownian");
    QVERIFY(!checkRequest(brownian, {}));
    const auto refusal = [](const GeneratorRow& row, const GeneratorRequest& request) {
        return QString::fromStdString(checkRequest(row, request).value_or("accepted"));
    };
    QCOMPARE(refusal(brownian, {.n = 0, .seed = 1, .options = {}}),
             "--n is 0; for `brownian` it must be from 1 to 1000000");
    QCOMPARE(refusal(*findGenerator("table"), {.n = 3, .seed = 1, .options = {}}),
             "`table` takes no --n; its number of bodies is fixed");
    QCOMPARE(refusal(brownian, {.n = {}, .seed = 1, .options = {{"pakcing", 0.1}}}),
             "`brownian` has no option --pakcing; did you mean --packing?");
    QCOMPARE(refusal(brownian, {.n = {}, .seed = 1, .options = {{"speed", -1.5}}}),
             "--speed is -1.5; it must be from 0 to 20 m/s");
    QVERIFY(checkRequest(brownian, {.n = {}, .seed = 1, .options = {{"speed", std::nan("")}}}));
}

void GeneratorTest::theCubeRootIsExactOnCubesAndCloseElsewhere() {
    constexpr double tolerance = 1e-15; // a few units of the last digit
    for (double x = 1e-9; x < 1e12; x *= 1.37) {
        const double root = portableCubeRoot(x);
        QVERIFY2(std::abs(root / std::cbrt(x) - 1) <= tolerance, qPrintable(QString::number(x)));
    }
    QCOMPARE(portableCubeRoot(27), 3.0);
}

CAROM_TEST(generator_test, GeneratorTest)
#include "generator_test.moc"
