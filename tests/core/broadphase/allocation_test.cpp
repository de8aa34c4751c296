// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/core/broadphase/moving_boxes.h"
#include "tests/support/test_class.h"

#include <QTest>

#include <atomic>
#include <cstdlib>
#include <new>

// Counts every allocation of this program.

namespace {
std::atomic<std::uint64_t> allocations = 0;
}

void* operator new(std::size_t size) {
    ++allocations;
    if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
    throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace carom {

class AllocationTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aMotionSeenBeforeAllocatesNothing() {
        Random random(5);
        MovingBoxes scene;
        for (int i = 0; i < 300; ++i) {
            const Vec3 centre = uniformIn(random, 2);
            const Vec3 half = Vec3::Constant(i == 0 ? 2 : random.uniform(0.05, 0.3));
            scene.add({centre - half, centre + half}, i % 9 != 0);
        }
        std::vector<std::vector<Aabb>> frames;
        for (int frame = 0; frame < 20; ++frame) {
            frames.push_back(scene.boxes);
            for (Aabb& box : scene.boxes) shift(box, uniformIn(random, frame < 10 ? 0.003 : 0.1));
        }
        for (const BroadphaseRow& row : broadphases()) {
            const std::unique_ptr<Broadphase> algorithm = row.create();
            std::uint64_t before = 0;
            constexpr int warmUps = 3; // a tree is rebuilt at moments of its own: capacities settle slowly
            for (int round = 0; round <= warmUps; ++round) {
                before = allocations;
                for (const std::vector<Aabb>& boxes : frames)
                    algorithm->update({boxes, scene.bodies, scene.mobile});
            }
            QVERIFY2(allocations == before, row.name.data());
        }
        QVERIFY(allocations > 0);
    }
};

} // namespace carom

CAROM_TEST(allocation_test, carom::AllocationTest)
#include "allocation_test.moc"
