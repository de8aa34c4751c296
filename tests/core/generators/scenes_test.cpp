// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/generators/generator.h"
#include "core/language/analysis.h"
#include "core/narrowphase/narrowphase.h"

#include "tests/support/program.h"
#include "tests/support/test_class.h"

#include <QTest>

#include <algorithm>
#include <cmath>

using namespace carom;

// What the generated scenes are, read back through the language: the figures of the reference's scenes, and
// that nothing overlaps at the start, by comparing every body with every other.

class ScenesTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void everySceneIsFreeOfDiagnostics();
    void nothingOverlapsAtTheStart_data();
    void nothingOverlapsAtTheStart();
    void aPoolBreakIsFifteenRackedBallsAndASmallerFasterOne();
    void rackedBallsStandWithinAHairOfEachOther();
    void poolBreaksAreWholeRacks();
    void aGasFillsItsShareOfTheBoxAndHasItsTemperature();
    void theTwoGasesStartOnOppositeSides();
    void theHeavySphereReachesTheTopOfThePyramidInFrame300();
    void theTableStandsOnItsLegs();
    void aHeapIsOfCylindersAndCuboidsByItsShare();
    void bodiesOfAHeapAreTurnedEveryWay();
    void aHeapStartsAboveABinThatHoldsItToItsDepth();
    void theShippedScenesAreTheGeneratorsOwn_data();
    void theShippedScenesAreTheGeneratorsOwn();

  private:
    static Scene heapOf(std::int64_t n, double cuboids) {
        return analyse(generate(*findGenerator("heap"), {.n = n, .options = {{"cuboids", cuboids}}})).scene;
    }
    static Scene sceneOf(const char* name, std::optional<std::int64_t> n = {}, std::uint64_t seed = 1) {
        const GeneratorRow& row = *findGenerator(name);
        return analyse(generate(row, {.n = n, .seed = seed, .options = {}})).scene;
    }
    static double radiusOf(const Body& body) { return std::get<Sphere>(body.shape).radius; }
};

void ScenesTest::everySceneIsFreeOfDiagnostics() {
    for (const GeneratorRow& row : generators())
        for (const std::uint64_t seed : {1ULL, 2ULL, 3ULL}) {
            const Analysis analysis = analyse(generate(row, {.n = {}, .seed = seed, .options = {}}));
            QVERIFY2(analysis.diagnostics.empty(), row.name.data());
            QVERIFY(analysis.scene.camera.source);
        }
}

void ScenesTest::nothingOverlapsAtTheStart_data() {
    QTest::addColumn<int>("n");
    QTest::addColumn<double>("jitter"); // share of its greatest value
    for (const double jitter : {0.0, 1.0})
        for (const GeneratorRow& row : generators())
            if (row.name != "brownian" && row.name != "pyramid")
                QTest::addRow("%s jitter %g", row.name.data(), jitter) << 0 << jitter;
    for (const int n : {16, 40, 400}) QTest::addRow("pool_breaks %d", n) << n << 1.0;
    for (const int n : {1, 2, 7, 150})
        for (const char* name : {"dominoes", "stone_wall", "log_pile", "mattress", "chain", "tower", "heap"})
            QTest::addRow("%s %d", name, n) << n << 1.0;
    for (const int n : {2, 3, 10}) {
        QTest::addRow("card_house %d", n) << n << 1.0;
        QTest::addRow("cradle %d", n) << n << 1.0;
        QTest::addRow("pendulums %d", n) << n << 1.0;
    }
    for (const int n : {1, 2, 3, 10, 150, 600}) {
        QTest::addRow("brownian %d", n) << n << 0.0;
        QTest::addRow("pyramid %d", n) << n << 0.0;
        QTest::addRow("pile %d", n) << n << 1.0;
    }
}

void ScenesTest::nothingOverlapsAtTheStart() {
    // What stands touches what it stands on; rounding of a height up to 150 m may turn that into this much
    // overlap [m].
    constexpr double rounding = 5e-14;
    QFETCH(int, n);
    QFETCH(double, jitter);
    const GeneratorRow& row =
        *findGenerator(QString(QTest::currentDataTag()).section(' ', 0, 0).toStdString());
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        GeneratorRequest request{.n = {}, .seed = seed, .options = {}};
        if (n > 0) request.n = n;
        for (const GeneratorOption& option : row.options)
            if (option.name == "jitter") request.options.emplace(option.name, jitter * option.maximum);
        const Scene scene = analyse(generate(row, request)).scene;
        for (BodyIndex a = 0; a < scene.bodies.size(); ++a)
            for (BodyIndex b = a + 1; b < scene.bodies.size(); ++b) {
                const Body &one = scene.bodies[a], &two = scene.bodies[b];
                if (one.fixed && two.fixed) continue;
                const double distance =
                    proximityOf({&one.shape, &one.pose}, {&two.shape, &two.pose}).distance;
                QVERIFY2(distance >= -rounding,
                         qPrintable(QStringLiteral("seed %1: bodies %2 and %3 are %4 m apart")
                                        .arg(seed)
                                        .arg(a)
                                        .arg(b)
                                        .arg(distance)));
            }
    }
}

void ScenesTest::aPoolBreakIsFifteenRackedBallsAndASmallerFasterOne() {
    const Scene scene = sceneOf("pool_break");
    int red = 0, yellow = 0, black = 0;
    for (const Body& body : scene.bodies) {
        if (isWall(body.shape)) continue;
        QCOMPARE(body.mass, 0.17);
        QCOMPARE(body.elastic, 0.95);
        QCOMPARE(body.pose.position.y(), radiusOf(body)); // on the table
        if (body.label == "cue") continue;
        QCOMPARE(radiusOf(body), 0.0286);
        red += body.colour == Vec3(1, 0, 0);
        yellow += body.colour == Vec3(1, 1, 0);
        black += body.colour == Vec3(0, 0, 0);
    }
    QCOMPARE(red, 7);
    QCOMPARE(yellow, 7);
    QCOMPARE(black, 1);
    const Body& cue = scene.bodies[scene.labelled("cue")];
    QCOMPARE(radiusOf(cue), 0.027);
    QCOMPARE(cue.velocity.norm(), 8.0);
    QCOMPARE(cue.colour, Vec3(Vec3::Ones()));
}

void ScenesTest::rackedBallsStandWithinAHairOfEachOther() {
    // The rack is opened by four standard deviations of the jitter (8e-5 m) and a clearance of 1e-5 m, and
    // each ball may be off by two standard deviations: no gap between neighbours exceeds 1.7e-4 m.
    constexpr double widestGap = 1.7e-4 + 2e-6;
    const Scene scene = sceneOf("pool_break");
    int neighbours = 0;
    for (std::size_t a = 0; a < scene.bodies.size(); ++a)
        for (std::size_t b = a + 1; b < scene.bodies.size(); ++b) {
            const Body &one = scene.bodies[a], &two = scene.bodies[b];
            if (isWall(one.shape) || isWall(two.shape)) continue;
            const double gap = (one.pose.position - two.pose.position).norm() - radiusOf(one) - radiusOf(two);
            neighbours += gap < widestGap;
        }
    QCOMPARE(neighbours, 30); // of fifteen balls in a triangle: 10 + 10 + 10
}

void ScenesTest::poolBreaksAreWholeRacks() {
    for (const int n : {16, 31, 32, 1850}) {
        const Scene scene = sceneOf("pool_breaks", n);
        QCOMPARE(static_cast<int>(scene.bodies.size()) - 1, n / 16 * 16); // and the table
    }
}

void ScenesTest::aGasFillsItsShareOfTheBoxAndHasItsTemperature() {
    constexpr int n = 2000;
    const Scene scene = sceneOf("brownian", n);
    double edge = 0, sum = 0, squares = 0;
    for (const Body& body : scene.bodies) {
        if (const Wall* wall = std::get_if<Wall>(&body.shape)) {
            edge = std::max(edge, -2 * wall->offset);
            QCOMPARE(body.elastic, 1.0);
            continue;
        }
        QCOMPARE(radiusOf(body), 0.1);
        QCOMPARE(body.mass, 0.1);
        QCOMPARE(body.elastic, 1.0);
        sum += body.velocity.sum();
        squares += body.velocity.squaredNorm();
    }
    const double filled = n * 4.0 / 3 * M_PI * 1e-3 / (edge * edge * edge);
    QVERIFY2(std::abs(filled - 0.05) < 1e-5,
             qPrintable(QString::number(filled))); // the edge is rounded to 1e-6
    // 6,000 draws of N(0, 3): five standard errors.
    QVERIFY(std::abs(sum / (3 * n)) < 5 * 3 / std::sqrt(3.0 * n));
    QVERIFY(std::abs(std::sqrt(squares / (3 * n)) - 3) < 5 * 3 / std::sqrt(6.0 * n));
}

void ScenesTest::theTwoGasesStartOnOppositeSides() {
    const Scene scene = sceneOf("brownian", 501);
    int white = 0, red = 0;
    for (const Body& body : scene.bodies) {
        if (isWall(body.shape)) continue;
        const bool isRed = body.colour == Vec3(1, 0, 0);
        (isRed ? red : white)++;
        QVERIFY(isRed ? body.pose.position.x() >= 0.1 : body.pose.position.x() <= -0.1);
    }
    QCOMPARE(white, 251);
    QCOMPARE(red, 250);
    QCOMPARE(scene.bodies[scene.labelled("blue")].colour, Vec3(0, 0, 1));
}

void ScenesTest::theHeavySphereReachesTheTopOfThePyramidInFrame300() {
    constexpr double rounding = 2e-5; // the speed is rounded to 1e-6 m/s, and five seconds pass
    for (const int n : {10, 500, 5000}) {
        const Scene scene = sceneOf("pyramid", n);
        const Body& heavy = scene.bodies[scene.labelled("heavy")];
        double top = 0;
        for (const Body& body : scene.bodies)
            if (const Cylinder* step = std::get_if<Cylinder>(&body.shape))
                top = std::max(top, body.pose.position.y() + step->halfHeight);
        const double t = 5; // 300 frames of 1/60 s
        const double height = heavy.pose.position.y() + heavy.velocity.y() * t - 9.8 * t * t / 2;
        QVERIFY2(std::abs(height - radiusOf(heavy) - top) < rounding, qPrintable(QString::number(height)));
        for (const Body& body : scene.bodies)
            if (body.label.empty() && !isWall(body.shape)) QVERIFY(heavy.mass > body.mass);
    }
}

void ScenesTest::theTableStandsOnItsLegs() {
    const Scene scene = sceneOf("table");
    const Body& top = scene.bodies[scene.labelled("top")];
    int legs = 0, spheres = 0;
    for (const Body& body : scene.bodies) {
        spheres += std::holds_alternative<Sphere>(body.shape);
        const Cylinder* leg = std::get_if<Cylinder>(&body.shape);
        if (!leg || &body == &top) continue;
        ++legs;
        QCOMPARE(body.pose.position.y(), leg->halfHeight);
        const double gap = proximityOf({&body.shape, &body.pose}, {&top.shape, &top.pose}).distance;
        QVERIFY(std::abs(gap) < 1e-12);
    }
    QCOMPARE(legs, 4);
    QCOMPARE(spheres, 2);
}

void ScenesTest::aHeapIsOfCylindersAndCuboidsByItsShare() {
    for (const double share : {0.0, 0.25, 0.5, 1.0}) {
        int cylinders = 0, cuboids = 0;
        for (const Body& body : heapOf(100, share).bodies) {
            if (isWall(body.shape)) continue;
            QCOMPARE(body.elastic, 0.2);
            QCOMPARE(body.friction, 0.5);
            QCOMPARE(halfThicknessOf(body.shape), 0.1);
            ++(std::holds_alternative<Cylinder>(body.shape) ? cylinders : cuboids);
        }
        QCOMPARE(cuboids, static_cast<int>(100 * share));
        QCOMPARE(cylinders, 100 - cuboids);
    }
}

void ScenesTest::bodiesOfAHeapAreTurnedEveryWay() {
    // Of a unit vector with any direction, the square of a component has the mean 1/3 and the variance 4/45.
    constexpr int n = 4000;
    for (const double share : {0.0, 1.0}) {
        Vec3 squares = Vec3::Zero();
        for (const Body& body : heapOf(n, share).bodies)
            if (!isWall(body.shape)) squares += (body.pose.orientation * Vec3::UnitY()).cwiseAbs2();
        const double fiveErrors = 5 * std::sqrt(4.0 / 45 / n);
        for (Eigen::Index k = 0; k < 3; ++k) QVERIFY(std::abs(squares[k] / n - 1.0 / 3) < fiveErrors);
    }
}

void ScenesTest::aHeapStartsAboveABinThatHoldsItToItsDepth() {
    constexpr double packing = 0.6; // of the settled heap, as the generator takes it
    for (const int n : {400, 1600}) {
        double width = 0, volume = 0;
        for (const Body& body : heapOf(n, 0.5).bodies) {
            if (const Wall* wall = std::get_if<Wall>(&body.shape))
                width = std::max(width, -2 * wall->offset);
            else
                volume += body.mass / 1000;
        }
        const double depth = volume / packing / (width * width);
        QVERIFY2(std::abs(depth - 0.8) < 0.15,
                 qPrintable(QString::number(depth))); // whole cells: half of one
    }
}

void ScenesTest::theShippedScenesAreTheGeneratorsOwn_data() {
    QTest::addColumn<QString>("path");
    for (const GeneratorRow& row : generators())
        // The pool break is shipped; a heap takes the tests that run every shipped scene too long.
        if (row.name != "pool_breaks" && row.name != "heap")
            QTest::newRow(row.name.data())
                << test::source(QStringLiteral("scenes/%1.sdl").arg(row.name.data()));
}

void ScenesTest::theShippedScenesAreTheGeneratorsOwn() {
    QFETCH(QString, path);
    const QByteArray text = QByteArray::fromStdString(generate(*findGenerator(QTest::currentDataTag()), {}));
    if (qEnvironmentVariableIsSet("CAROM_UPDATE")) test::writeFile(path, text);
    QCOMPARE(test::readFile(path), text);
}

CAROM_TEST(scenes_test, ScenesTest)
#include "scenes_test.moc"
