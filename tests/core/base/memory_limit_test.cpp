// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/memory_limit.h"
#include "tests/support/files.h"
#include "tests/support/test_class.h"

#include <QTest>

#include <sys/mman.h>
#include <sys/resource.h>

#include <string>

namespace carom::test {

namespace {

/// Whether this process is given so many bytes that nobody has touched yet, which Linux promises to anybody.
bool isPromised(std::uint64_t bytes) {
    void* place =
        ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (place == MAP_FAILED) return false;
    ::munmap(place, bytes);
    return true;
}

} // namespace

class MemoryLimitTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void init() { QCOMPARE(::getrlimit(RLIMIT_DATA, &m_before), 0); }
    void cleanup() { QCOMPARE(::setrlimit(RLIMIT_DATA, &m_before), 0); }

    void moreThanTheMachineHasIsRefusedAndWhatItHasIsNot() {
        const std::string machine = readFile("/proc/meminfo").toStdString();
        const std::uint64_t all = *bytesOfLine(machine, "MemTotal") + *bytesOfLine(machine, "SwapTotal");
        QVERIFY(isPromised(all)); // so that a refusal is the limit's
        limitMemory();
        QVERIFY(!isPromised(all));
        constexpr std::uint64_t little = 16
                                         << 20; // [bytes] that any machine has left on which this was built
        QVERIFY(isPromised(little));
    }

    void asOftenAsItIsCalledTheLimitIsThatOfTheMachine() {
        // It counts from what is held now: called again it neither adds up nor tightens.
        limitMemory();
        const rlim_t first = limit();
        for (int i = 0; i < 20; ++i) limitMemory();
        constexpr rlim_t drift = 8; // an eighth may have been taken or given back by others meanwhile
        QVERIFY(limit() < first + first / drift);
        QVERIFY(limit() > first - first / drift);
    }

    void linesOfTheKernelAreRead_data() {
        QTest::addColumn<QByteArray>("text");
        QTest::addColumn<qint64>("bytes");
        QTest::newRow("one") << QByteArray("MemFree: 12 kB\n") << qint64{12} * 1024;
        QTest::newRow("behind others")
            << QByteArray("MemFreeNot:  1 kB\nMemFree:\t 7 kB") << qint64{7} * 1024;
        QTest::newRow("no number") << QByteArray("MemFree: many\n") << qint64{-1};
        QTest::newRow("nothing behind it") << QByteArray("MemFree:") << qint64{-1};
        QTest::newRow("not there") << QByteArray("Mem: 1 kB\n\n") << qint64{-1};
        QTest::newRow("empty") << QByteArray() << qint64{-1};
    }
    void linesOfTheKernelAreRead() {
        QFETCH(QByteArray, text);
        QFETCH(qint64, bytes);
        const auto found = bytesOfLine(text.toStdString(), "MemFree");
        QCOMPARE(found ? static_cast<qint64>(*found) : qint64{-1}, bytes);
    }

  private:
    static rlim_t limit() {
        rlimit now{};
        return ::getrlimit(RLIMIT_DATA, &now) == 0 ? now.rlim_cur : 0;
    }

    rlimit m_before{};
};

} // namespace carom::test

CAROM_TEST(memory_limit_test, carom::test::MemoryLimitTest)
#include "memory_limit_test.moc"
