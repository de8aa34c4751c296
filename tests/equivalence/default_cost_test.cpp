// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/counted_frames.h"
#include "tests/support/files.h"
#include "tests/support/test_class.h"

#include "core/integrators/integrator.h"
#include "core/simulation/build.h"
#include "core/study/convergence.h"

#include <QMap>
#include <QRegularExpression>
#include <QTemporaryDir>
#include <QTest>

#include <algorithm>
#include <vector>

// What a shipped scene runs with by itself costs at most three times the cheapest setting that is no worse,
// in instructions: valgrind counts them, so that no figure depends on the machine. Scenes for which this does
// not hold are explained in the manual (resources/help/diagrams.md).

namespace carom {
namespace {

using namespace test;

constexpr double mostTimes = 3;
/// carom-frames leaves the first frames out, in which lists get their size, and counts the next ones.
constexpr int warmUp = 10, counted = 30;

QByteArray textOf(const QString& scene) {
    return readFile(source(("scenes/" + scene.toStdString() + ".sdl").c_str()));
}

/// The scene with this setting in place of its own.
QByteArray withSetting(const QByteArray& text, const AccuracySetting& setting) {
    static const QRegularExpression own(QStringLiteral("simulation \\{[^}]*\\}"));
    QString words = QStringLiteral("simulation { method %1 substeps %2")
                        .arg(QString::fromUtf8(setting.method->name.data(), std::ssize(setting.method->name)))
                        .arg(setting.substeps);
    if (setting.integrator != nullptr)
        words += QStringLiteral(" integrator ") +
                 QString::fromUtf8(setting.integrator->name.data(), std::ssize(setting.integrator->name));
    if (setting.preset != nullptr)
        words += QStringLiteral(" preset ") +
                 QString::fromUtf8(setting.preset->name.data(), std::ssize(setting.preset->name));
    QString scene = QString::fromUtf8(text);
    scene.remove(own);
    return (scene + words + QStringLiteral(" }\n")).toUtf8();
}

/// Instructions of each text, in one run of valgrind.
QMap<QByteArray, double> instructionsOf(const QList<QByteArray>& texts) {
    const QTemporaryDir folder;
    const QString counts = folder.filePath(QStringLiteral("counts"));
    const test::Ended ended = test::countFrames(texts, warmUp, counted, counts);
    QMap<QByteArray, double> instructions;
    if (ended.exitCode != 0) return instructions;
    for (qsizetype i = 0; i < texts.size(); ++i)
        for (const QString& line :
             linesOf(QString::fromUtf8(readFile(counts + QStringLiteral(".%1").arg(i + 1)))))
            if (line.startsWith(QStringLiteral("totals: ")))
                instructions[texts[i]] = line.section(QLatin1Char(' '), 1, 1).toDouble();
    return instructions;
}

/// The scene's own setting, then of every family the coarsest that is no worse.
std::vector<AccuracySetting> noWorseThanOwn(const Scene& scene, double duration) {
    AccuracyPlan plan = planFor(scene);
    vary(plan, {1, 2, 4, 8, 16}, {});
    plan.duration = duration;
    plan.runs = 1;
    AccuracyListener listener;
    listener.goOn = [](double) { return true; };
    double now = 0; // no time passes: everything fits into the budget
    listener.clock = {[] { return 0.0; }, [&] { return now += 1; }};
    const AccuracyStudy study = runAccuracy(scene, plan, listener);
    const AccuracyPoint* own = ownPoint(study);
    if (own == nullptr) return {};
    std::vector<AccuracySetting> settings = {own->setting};
    for (const AccuracyFamily& family : familiesOf(study))
        for (const AccuracyPoint* point : family.points)
            if (isNoWorseThanOwn(study, *point)) {
                if (!(point->setting == own->setting)) settings.push_back(point->setting);
                break; // finer ones cost more
            }
    return settings;
}

} // namespace

class DefaultCostTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void theOwnSettingCostsAtMostThreeTimesTheCheapestThatIsNoWorse_data() {
        QTest::addColumn<QString>("scene");
        QTest::addColumn<double>("duration"); // [s] simulated for the errors
        const auto add = [](const char* scene, double duration) {
            QTest::newRow(scene) << QString::fromUtf8(scene) << duration;
        };
        add("bouncing_ball", 0.5);
        add("cradle", 0.5); // the first ball arrives after 0.4 s
        add("pendulums", 0.5);
        add("spinning_cylinder", 0.5);
        add("spring_pendulum", 0.5);
        add("tower", 0.1); // it rests
        add("tumbling_cuboid", 0.5);
    }
    void theOwnSettingCostsAtMostThreeTimesTheCheapestThatIsNoWorse() {
        QFETCH(QString, scene);
        QFETCH(double, duration);
        const QByteArray text = textOf(scene);
        const Build built = build(text.toStdString());
        QVERIFY(built.pipeline);
        const std::vector<AccuracySetting> settings = noWorseThanOwn(built.pipeline->scene(), duration);
        QVERIFY(!settings.empty());
        QList<QByteArray> texts;
        for (const AccuracySetting& setting : settings) texts.push_back(withSetting(text, setting));
        const QMap<QByteArray, double> instructions = instructionsOf(texts);
        QVERIFY2(instructions.size() == texts.size(), "valgrind is a package that the tests need");
        const double own = instructions[texts.front()];
        QVERIFY(own > 1000);
        QString all;
        double least = own;
        for (qsizetype i = 0; i < texts.size(); ++i) {
            least = std::min(least, instructions[texts[i]]);
            all += QStringLiteral("%1: %2\n")
                       .arg(QString::fromStdString(settings[static_cast<std::size_t>(i)].name()))
                       .arg(instructions[texts[i]]);
        }
        qInfo("%s costs %.2f times the least", qPrintable(scene), own / least);
        QVERIFY2(own <= mostTimes * least, qPrintable(all));
    }
};

} // namespace carom

CAROM_TEST(default_cost_test, carom::DefaultCostTest)
#include "default_cost_test.moc"
