// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/counted_frames.h"
#include "tests/support/files.h"
#include "tests/support/shipped_scenes.h"
#include "tests/support/test_class.h"

#include "core/integrators/integrator.h"
#include "core/simulation/settings.h"
#include "core/simulation/build.h"
#include "core/study/convergence.h"

#include <QMap>
#include <QRegularExpression>
#include <QTest>

#include <algorithm>
#include <array>
#include <vector>

// What a shipped scene runs with by itself costs at most three times the cheapest setting that is no worse,
// in instructions: valgrind counts them, so that no figure depends on the machine. Only settings that may be
// far cheaper are held against the scene's own, over its first frames; where all of these are worse nothing
// needs to be counted. Shorter runs tell fewer settings apart, so none is called worse that is not.

namespace carom {
namespace {

using namespace test;

constexpr double mostTimes = 3;
/// carom-frames leaves the first frames out, in which lists get their size, and counts the next ones.
constexpr int warmUp = 5, counted = 10;
/// Steps a frame that finding the reference solution may take. With few the default preset with more and more
/// substeps is compared with: runs by `accurate` take most of the time of a test and decide nothing where
/// many bodies touch.
constexpr double fewestSteps = 30, fewSteps = 75, manySteps = 500;

/// A scene, and what it takes to tell its settings apart.
struct Row {
    const char* scene = "";
    int frames = 30; ///< that errors are taken from
    int finest = 16; ///< substeps
    double steps = manySteps;
};
/// Scenes whose settings differ later, or in which so many bodies touch that as many frames would take
/// minutes.
constexpr std::array rows = {
    Row{"brownian", 2, 1}, // in more frames more balls meet, and more settings are worse
    Row{"card_house", 3, 4, fewSteps},
    Row{"chain", 8},
    Row{"dominoes", 6, 4, fewSteps},
    Row{"log_pile", 12, 4, fewSteps},
    Row{"mattress", 16, 4, fewSteps},
    Row{"pile", 6, 4, fewSteps},
    Row{"pool_break", 30, 8},
    Row{"pyramid", 20, 8, fewSteps},
    Row{"stone_wall", 12, 4, fewestSteps},
    Row{"table", 36, 8}, // the spheres have landed
    Row{"tour", 24},
    Row{"tower", 6}, // it rests
};

Row rowOf(const QString& scene) {
    const auto found =
        std::ranges::find_if(rows, [&](const Row& row) { return scene == QLatin1StringView(row.scene); });
    return found != rows.end() ? *found : Row{};
}

QStringList gallery() {
    QStringList scenes = shippedScenes();
    scenes.removeIf([](const QString& path) { return path.contains(QLatin1Char('/')); });
    for (QString& scene : scenes) scene.chop(4);
    return scenes;
}

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

/// Whether a setting may cost less than a third of the scene's own. One of the same method that works at
/// least as carefully takes at least a part of its time in proportion to its substeps; integrators differ by
/// more where there are springs. Where exact events serve nothing is dearer than `accurate`: 340 ms a frame
/// of the gas in place of 0.08.
bool mayBeFarCheaper(const AccuracySetting& setting, const AccuracySetting& own, const Scene& scene) {
    if (own.method->isExact) return setting.preset == nullptr || setting.preset->name != "accurate";
    if (setting.method != own.method || setting.preset < own.preset) return true;
    const bool isAlike = setting.preset == own.preset && !scene.springs.empty();
    return isAlike || 2 * setting.substeps < own.substeps;
}

/// A millisecond passes with every step until there is a reference solution, then none.
AccuracyStudy studied(const Scene& scene, const AccuracyPlan& plan) {
    double time = 0, readings = 0;
    bool hasReference = false;
    AccuracyListener listener;
    listener.goOn = [&](double) {
        time += hasReference ? 0 : 1;
        return true;
    };
    listener.changed = [&](const AccuracyStudy& soFar) { hasReference = soFar.reference.has_value(); };
    // A run of a few frames is long enough to be timed.
    listener.clock = {[&] { return time; }, [&] { return readings += 10; }};
    return runAccuracy(scene, plan, listener);
}

/// The scene's own setting, then of every family the coarsest that is no worse and may be far cheaper.
std::vector<AccuracySetting> contenders(const Scene& scene, int frames, int finest, double steps) {
    AccuracyPlan plan = planFor(scene);
    const AccuracySetting standard = ownSettingOf(scene);
    std::vector<double> substeps;
    for (int count = 1; count <= finest; count *= 2) substeps.push_back(count);
    vary(plan, substeps, {});
    std::erase_if(plan.settings,
                  [&](const AccuracySetting& setting) { return !mayBeFarCheaper(setting, standard, scene); });
    std::vector<Diagnostic> ignored;
    plan.duration = frames * settledSettings(scene, {}, ignored).step;
    plan.budget = 1e-3 * steps * frames;
    plan.runs = 1;
    plan.copies = 0;
    const AccuracyStudy study = studied(scene, plan);
    if (ownPoint(study) == nullptr || !study.leftOut.empty()) return {};
    std::vector<AccuracySetting> settings = {standard};
    for (const AccuracyFamily& family : familiesOf(study))
        for (const AccuracyPoint* point : family.points)
            if (isNoWorseThanOwn(study, *point)) {
                if (!(point->setting == standard)) settings.push_back(point->setting);
                break; // finer ones cost more
            }
    return settings;
}

} // namespace

class DefaultCostTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void initTestCase() {
        for (const QString& scene : gallery()) {
            const Row row = rowOf(scene);
            const QByteArray text = textOf(scene);
            const Build built = build(text.toStdString());
            QVERIFY(built.pipeline);
            const std::vector<AccuracySetting> settings =
                contenders(built.pipeline->scene(), row.frames, row.finest, row.steps);
            QVERIFY2(!settings.empty(), qPrintable(scene));
            for (const AccuracySetting& setting : settings)
                m_contenders[scene].push_back(
                    {QString::fromStdString(setting.name()), withSetting(text, setting)});
        }
        QList<QByteArray> texts;
        for (const QList<Contender>& ofScene : m_contenders)
            if (ofScene.size() > 1)
                for (const Contender& contender : ofScene) texts.push_back(contender.text);
        m_instructions = instructionsOf(texts, warmUp, counted);
        QVERIFY2(m_instructions.size() == texts.size(), "valgrind is a package that the tests need");
    }

    void everyRowIsASceneOfTheGallery() {
        for (const Row& row : rows) QVERIFY2(gallery().contains(QLatin1StringView(row.scene)), row.scene);
    }

    void theOwnSettingCostsAtMostThreeTimesTheCheapestThatIsNoWorse_data() {
        QTest::addColumn<QString>("scene");
        for (const QString& scene : gallery()) QTest::newRow(qPrintable(scene)) << scene;
    }
    void theOwnSettingCostsAtMostThreeTimesTheCheapestThatIsNoWorse() {
        QFETCH(QString, scene);
        const QList<Contender>& all = m_contenders[scene];
        if (all.size() == 1) {
            qInfo("%s: all that may be far cheaper is worse", qPrintable(scene));
            return;
        }
        const double own = m_instructions[all.front().text];
        QVERIFY(own > 1000);
        QString told;
        double least = own;
        for (const Contender& contender : all) {
            least = std::min(least, m_instructions[contender.text]);
            told += QStringLiteral("%1: %2\n").arg(contender.name).arg(m_instructions[contender.text]);
        }
        qInfo("%s costs %.2f times the least of %d", qPrintable(scene), own / least,
              static_cast<int>(all.size()));
        QVERIFY2(own <= mostTimes * least, qPrintable(told));
    }

  private:
    struct Contender {
        QString name;
        QByteArray text; ///< of the scene with it
    };
    QMap<QString, QList<Contender>> m_contenders; // the own setting first
    QMap<QByteArray, double> m_instructions;
};

} // namespace carom

CAROM_TEST(default_cost_test, carom::DefaultCostTest)
#include "default_cost_test.moc"
