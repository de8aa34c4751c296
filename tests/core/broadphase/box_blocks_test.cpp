// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/core/broadphase/moving_boxes.h"
#include "tests/support/constants.h"
#include "tests/support/test_class.h"

#include "core/broadphase/box_blocks.h"

#include <QTest>

#include <algorithm>
#include <vector>

// Boxes in blocks, against each box compared with each.

namespace carom {
namespace {

std::vector<std::uint32_t> obvious(const std::vector<Aabb>& boxes, const Aabb& box) {
    std::vector<std::uint32_t> entries;
    for (std::uint32_t entry = 0; entry < boxes.size(); ++entry)
        if (overlap(boxes[entry], box)) entries.push_back(entry);
    return entries;
}

std::vector<std::uint32_t> sorted(std::span<const std::uint32_t> entries) {
    std::vector<std::uint32_t> result(entries.begin(), entries.end());
    std::sort(result.begin(), result.end());
    return result;
}

} // namespace

class BoxBlocksTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void whatOverlapsIsFound() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 81);
        std::size_t found = 0;
        for (int trial = 0; trial < 60; ++trial) {
            MovingBoxes scene = randomScene(random);
            BoxBlocks blocks;
            BoxBlocks::Search search;
            blocks.build(scene.boxes);
            for (int step = 0; step < 3; ++step) {
                for (const Aabb& box : scene.boxes) {
                    const std::vector<std::uint32_t> entries = sorted(blocks.overlapping(box, search));
                    QVERIFY(entries == obvious(scene.boxes, box));
                    found += entries.size();
                }
                move(scene, random);
                for (std::size_t entry = 0; entry < scene.boxes.size(); ++entry)
                    blocks.set(entry, scene.boxes[entry]);
            }
        }
        QVERIFY(found > 10'000);
    }

    // Blocks of blocks of blocks; then every third box moves.
    void whatOverlapsIsFoundAmongMany() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 88);
        std::vector<Aabb> boxes;
        for (int i = 0; i < 700; ++i) {
            const Vec3 centre(random.uniform(0, 8), random.uniform(0, 8), random.uniform(0, 3));
            boxes.push_back(grown({centre, centre}, random.uniform(0.1, 0.5)));
        }
        BoxBlocks blocks;
        BoxBlocks::Search search;
        blocks.build(boxes);
        const auto areFound = [&] {
            return std::all_of(boxes.begin(), boxes.end(), [&](const Aabb& box) {
                return sorted(blocks.overlapping(box, search)) == obvious(boxes, box);
            });
        };
        QVERIFY(areFound());
        for (std::size_t entry = 0; entry < boxes.size(); entry += 3) {
            const Vec3 shift(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2));
            boxes[entry] = {boxes[entry].lower + shift, boxes[entry].upper + shift};
            blocks.set(entry, boxes[entry]);
        }
        QVERIFY(areFound());
    }

    void nothingOverlapsAmongNone() {
        BoxBlocks blocks;
        BoxBlocks::Search search;
        blocks.build({});
        QVERIFY(blocks.overlapping({Vec3::Constant(-1), Vec3::Constant(1)}, search).empty());
    }
};

} // namespace carom

CAROM_TEST(box_blocks_test, carom::BoxBlocksTest)
#include "box_blocks_test.moc"
