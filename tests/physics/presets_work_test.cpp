// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/frame_work.h"
#include "tests/support/test_class.h"
#include "tests/support/varied_scene.h"

#include "core/study/cases/generated.h"
#include "core/study/cases/scene_text.h"

#include <QTest>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

// What a preset costs beside the others, in counted work: `fast` no more than `default`, `accurate` less than
// a second in any frame. carom-presets (tests/benchmark) times all shipped scenes.

namespace carom {
namespace {

struct PresetWork {
    double sum = 0, worst = 0; // operations
    std::uint64_t factorisations = 0;
};

PresetWork workWith(const std::string& text, const char* preset, int frames) {
    SimulationSettings options;
    options.method = "contacts";
    options.preset = preset;
    World world(build(text, options).pipeline);
    PresetWork work;
    for (int frame = 0; frame < frames && world.health().finite; ++frame) {
        world.step();
        const double operations = operationsOf(world.statistics().work);
        work.sum += operations;
        work.worst = std::max(work.worst, operations);
        work.factorisations += world.statistics().work.factorisations;
    }
    return work;
}

} // namespace

class PresetsWorkTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    // What a coarse tolerance left made boxes sink by more than the slop in each substep, and each had its
    // position corrected and its contacts found again: 1.5 times the work of a default run.
    void fastRunsOfSlidingBoxesCostNoMore() {
        std::string scene = falling() + "simulation { substeps 8 }\n" + levelFloor(1);
        for (const double friction : {0.0, 0.05, 0.25})
            scene += text("cuboid { size 0.4, 0.3, 0.4  mass 1  centre ", Vec3(-1, 0.15, 10 * friction),
                          "  vel 3, 0, 0  elastic 0  friction ", friction, " }\n");
        const double fast = workWith(scene, "fast", 120).sum, usual = workWith(scene, "default", 120).sum;
        qInfo("%.3g and %.3g operations", fast, usual);
        QVERIFY(usual > 0);
        QVERIFY(fast <= 1.02 * usual);
    }

    // With one substep a frame, what flies came so far in it that all bodies were one island, of which every
    // impact looked at all pairs again: 1.2 to 3.7 times the work of default runs. The median of some scenes
    // counts: how two runs differ in one of them is a matter of chance, by up to a factor of two.
    // What all of them cost together: preset_cost_test.
    void fastRunsOfBouncingBodiesCostNoMore() {
        std::vector<double> times;
        for (const std::uint64_t seed : {8, 28, 40, 63, 64, 81, 97, 100}) {
            const std::string scene = test::variedScene(seed);
            const double usual = workWith(scene, "default", 60).sum;
            QVERIFY(usual > 0);
            times.push_back(workWith(scene, "fast", 60).sum / usual);
        }
        std::ranges::sort(times);
        const double median = 0.5 * (times[3] + times[4]);
        qInfo("%.3g times the work, at most %.3g", median, times.back());
        QVERIFY(median <= 1);
    }

    // 39 bodies of a random scene took 1.3e9 operations in one frame.
    void accurateRunsTakeLessThanASecondInAFrame() {
        const std::string scene = test::variedScene(22);
        const PresetWork accurate = workWith(scene, "accurate", 60), usual = workWith(scene, "default", 60);
        qInfo("%.3g and %.3g operations, %.3g in one frame", accurate.sum, usual.sum, accurate.worst);
        QVERIFY(accurate.sum > usual.sum);
        QVERIFY(accurate.worst < 1e9);
    }

    // Two cylinders rest on each other in one point while another is still apart. That the bodies touch was
    // taken for an impact of the other point, again after each billionth of a substep, until no more events
    // were allowed: 6.1e8 operations in one frame of six cylinders, four times the next.
    void noImpactIsLocatedInAPointThatRests() {
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
            const std::string scene = generated("pyramid", {.n = 30, .seed = seed, .options = {}});
            const PresetWork accurate = workWith(scene, "accurate", 90);
            qInfo("%.3g operations, %.3g in one frame", accurate.sum, accurate.worst);
            QVERIFY(accurate.worst < 3e8);
        }
    }

    // Bodies on springs whose gaps to others close within a substep. The shorter a part of it, the larger the
    // force that closes a gap: a stop of what slides there was looked for in ever shorter parts, at ten
    // solves of the springs each, found in one of .2 % of the substep, and again in the next: 160,000
    // factorisations.
    void noStopIsLocatedInAGap() {
        const PresetWork accurate = workWith(test::variedScene(33), "accurate", 16);
        QVERIFY(accurate.factorisations > 0);
        QVERIFY(accurate.factorisations < 110'000);
    }
};

} // namespace carom

CAROM_TEST(presets_work_test, carom::PresetsWorkTest)
#include "presets_work_test.moc"
