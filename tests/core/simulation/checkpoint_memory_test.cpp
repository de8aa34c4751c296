// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/shipped_scenes.h"
#include "tests/support/test_class.h"
#include "tests/support/text.h"
#include "tests/support/worlds.h"

#include "core/simulation/build.h"
#include "core/simulation/recording.h"

#include <QTest>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>

// What a checkpoint says it holds is what the allocator has given for it: operator new and delete are
// counted. The budget of a recording is worth what these figures are: with 2 % of them said, a run of a
// cradle as fast as possible took 1.7 GB in a minute.

namespace {

std::atomic<std::size_t> held = 0; // [bytes]

/// What malloc takes for a piece of this size: its own figure beside it, in units of 16 bytes, two at least.
/// What a piece really gets may be more, by what was free before, and would depend on the heap's past.
std::size_t chunkOf(std::size_t size) {
    return std::max<std::size_t>(32, (size + sizeof(std::size_t) + 15) / 16 * 16);
}

/// The size is kept before the piece.
void* counted(void* memory, std::size_t before, std::size_t size) {
    if (memory == nullptr) throw std::bad_alloc();
    held += chunkOf(size);
    char* piece = static_cast<char*>(memory) + before;
    std::memcpy(piece - sizeof size, &size, sizeof size);
    return piece;
}

void release(void* memory, std::size_t before) {
    if (memory == nullptr) return;
    char* piece = static_cast<char*>(memory);
    std::size_t size = 0;
    std::memcpy(&size, piece - sizeof size, sizeof size);
    held -= chunkOf(size);
    std::free(piece - before);
}

constexpr std::size_t usual = alignof(std::max_align_t);

} // namespace

void* operator new(std::size_t size) { return counted(std::malloc(usual + size), usual, size); }
void* operator new(std::size_t size, std::align_val_t alignment) {
    const std::size_t unit = static_cast<std::size_t>(alignment);
    return counted(std::aligned_alloc(unit, unit + (size + unit - 1) / unit * unit), unit, size);
}
void operator delete(void* memory) noexcept { release(memory, usual); }
void operator delete(void* memory, std::size_t) noexcept { release(memory, usual); }
void operator delete(void* memory, std::align_val_t alignment) noexcept {
    release(memory, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory, std::size_t, std::align_val_t alignment) noexcept {
    release(memory, static_cast<std::size_t>(alignment));
}

using namespace carom;

namespace {
using carom::test::q;
}

class CheckpointMemoryTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    // With each method that can treat it: a scene of bodies that touch has rows, manifolds and islands to
    // remember, one of events has its queue.
    void aCheckpointTakesTheMemoryThatItReports_data() {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("method");
        for (const SolverRow& row : solvers())
            for (const QString& path : test::shippedScenes())
                QTest::newRow(qPrintable(path + u' ' + q(row.name)))
                    << q(test::textOfScene(path)) << q(row.name);
    }
    void aCheckpointTakesTheMemoryThatItReports() {
        QFETCH(QString, text);
        QFETCH(QString, method);
        // What is rounded up differs from piece to piece, and small checkpoints have many.
        constexpr double rounding = 0.05;
        SimulationSettings options;
        options.method = method.toStdString();
        const std::shared_ptr<const Pipeline> pipeline =
            std::make_shared<const Pipeline>(build(text.toStdString()).pipeline->scene(), options);
        World world(pipeline);
        for (const int frames : {0, 1, 60}) {
            test::run(world, pipeline->bodies().count() > 100 ? frames / 4 : frames);
            const std::size_t before = held;
            const Checkpoint checkpoint = world.checkpoint();
            const double given = static_cast<double>(held - before + sizeof(Checkpoint));
            const double said = static_cast<double>(checkpoint.bytes());
            QVERIFY2(std::abs(said - given) <= rounding * given,
                     qPrintable(QStringLiteral("after %1 frames: %2 bytes said, %3 given")
                                    .arg(world.state().frame)
                                    .arg(said)
                                    .arg(given)));
        }
    }

    // A scene of one body must not carry what solving large ones takes.
    void aCheckpointOfOneBodyIsSmall() {
        constexpr std::size_t most = 3'500; // [bytes]; it was 58,632
        World world(build(test::textOfScene(QStringLiteral("spring_pendulum.sdl"))).pipeline);
        test::run(world, 60);
        QVERIFY2(world.checkpoint().bytes() < most, qPrintable(QString::number(world.checkpoint().bytes())));
    }
};

CAROM_TEST(checkpoint_memory_test, CheckpointMemoryTest)
#include "checkpoint_memory_test.moc"
