// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/scenes.h"
#include "tests/support/test_class.h"
#include "tests/support/worlds.h"

#include "core/generators/generator.h"
#include "core/math/random.h"
#include "core/simulation/build.h"

#include <QTest>

#include <atomic>
#include <cstdlib>
#include <new>
#include <utility>

// A step allocates nothing once the first frames have sized the scratch: operator new is counted.

namespace {

std::atomic<long> allocations = 0;

void* counted(std::size_t size, std::size_t alignment) {
    ++allocations;
    // aligned_alloc wants a multiple of the alignment
    void* memory = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

} // namespace

void* operator new(std::size_t size) { return counted(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
    return counted(size, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    ++allocations;
    return std::malloc(size);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace carom {

class AllocationTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void theCounterCounts() {
        const long before = allocations;
        int* volatile kept = new int(3); // volatile: the optimiser may leave out a pair it sees through
        delete kept;
        QVERIFY(allocations > before);
    }

    void aStepAllocatesNothingAfterWarmUp_data() {
        QTest::addColumn<QString>("broadphase");
        for (const BroadphaseRow& row : broadphases())
            QTest::newRow(row.name.data()) << QString::fromUtf8(row.name.data(), qsizetype(row.name.size()));
    }
    void aStepAllocatesNothingAfterWarmUp() {
        QFETCH(QString, broadphase);
        // An elastic gas in a box: pairs come and go for ever, and never many at once.
        Random random(7);
        Scene scene = test::sceneOf({});
        for (int axis = 0; axis < 3; ++axis) {
            scene.bodies.push_back(test::wall(Vec3::Unit(axis), -2));
            scene.bodies.push_back(test::wall(-Vec3::Unit(axis), -2));
        }
        for (int i = 0; i < 300; ++i) {
            const Vec3 centre(random.uniform(-1.8, 1.8), random.uniform(-1.8, 1.8),
                              random.uniform(-1.8, 1.8));
            const Vec3 velocity(random.gaussian(), random.gaussian(), random.gaussian());
            scene.bodies.push_back(i % 10 == 0 ? test::cylinder(0.1, 0.2, 1, centre)
                                               : test::sphere(0.1, 1, centre, velocity));
        }
        SimulationSettings options;
        options.broadphase = broadphase.toStdString();
        World world = test::worldOf(scene, options);
        test::run(world, 4000); // the largest crowds have been, in every division

        const long before = allocations;
        std::uint64_t contacts = 0;
        for (int i = 0; i < 200; ++i) {
            world.step();
            contacts += world.statistics().contacts;
        }
        QCOMPARE(allocations - before, 0);
        QVERIFY(contacts > 1000);
    }

    // Bodies that rest, slide, lean and hang, each scene once it does what it will go on doing.
    void scenesOfContactAllocateNothingAfterWarmUp_data() {
        QTest::addColumn<int>("bodies");
        for (const auto& [name, bodies] :
             {std::pair("stone_wall", 4), std::pair("log_pile", 6), std::pair("tower", 5),
              std::pair("chain", 8), std::pair("dominoes", 10), std::pair("card_house", 2),
              std::pair("pile", 40), std::pair("mattress", 4)})
            QTest::newRow(name) << bodies;
    }
    void scenesOfContactAllocateNothingAfterWarmUp() {
        QFETCH(int, bodies);
        GeneratorRequest request;
        request.n = bodies;
        const GeneratorRow* scene = findGenerator(QTest::currentDataTag());
        QVERIFY(scene != nullptr);
        World world(build(generate(*scene, request)).pipeline);
        test::run(world, 700); // the pile has come to rest
        const long before = allocations;
        test::run(world, 60);
        QCOMPARE(allocations - before, 0);
    }

    void theExactMethodAllocatesNothingAfterWarmUp() {
        Random random(11);
        Scene scene = test::sceneOf({}, Vec3(0, -9.81, 0));
        for (int axis = 0; axis < 3; ++axis) {
            scene.bodies.push_back(test::wall(Vec3::Unit(axis), -2));
            scene.bodies.push_back(test::wall(-Vec3::Unit(axis), -2));
        }
        for (int i = 0; i < 512; ++i) // all over the box; two sizes are two levels of cells
            scene.bodies.push_back(test::sphere(
                i % 20 == 0 ? 0.15 : 0.05, 1, Vec3(i % 8, i / 8 % 8, i / 64) * 0.52 - Vec3::Constant(1.82),
                3 * Vec3(random.gaussian(), random.gaussian(), random.gaussian())));
        SimulationSettings options;
        options.method = "events";
        World world = test::worldOf(scene, options);
        test::run(world, 130); // the clock is set back after every 60
        const long before = allocations;
        std::uint64_t contacts = 0;
        for (int i = 0; i < 200; ++i) {
            world.step();
            contacts += world.statistics().contacts;
        }
        QCOMPARE(allocations - before, 0);
        QVERIFY(contacts > 1000);
    }
};

} // namespace carom

CAROM_TEST(allocation_test, carom::AllocationTest)
#include "allocation_test.moc"
