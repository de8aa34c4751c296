// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/counted_frames.h"
#include "tests/support/test_class.h"
#include "tests/support/varied_scene.h"

#include <QTest>

// What the presets cost in instructions, which valgrind counts.

namespace carom {

class PresetCostTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    // Scenes of which the bodies, with one substep a frame, came so far in it that they were one island: fast
    // runs took 2.3 times the work of default runs in all.
    void fastRunsOfBouncingBodiesCostNoMore() {
        QList<QByteArray> texts;
        for (const std::uint64_t seed : {8, 28, 40, 63, 64, 81, 97, 100})
            for (const char* preset : {"fast", "default"})
                texts.push_back(QByteArray::fromStdString(test::variedScene(seed) + "simulation { preset " +
                                                          preset + " }\n"));
        const QMap<QByteArray, double> instructions = test::instructionsOf(texts, 0, 60);
        QVERIFY2(instructions.size() == texts.size(), "valgrind is a package that the tests need");
        double fast = 0, usual = 0;
        for (qsizetype i = 0; i < texts.size(); i += 2) {
            fast += instructions[texts[i]];
            usual += instructions[texts[i + 1]];
        }
        qInfo("%.4g and %.4g instructions", fast, usual);
        QVERIFY(usual > 0);
        QVERIFY(fast <= usual);
    }
};

} // namespace carom

CAROM_TEST(preset_cost_test, carom::PresetCostTest)
#include "preset_cost_test.moc"
