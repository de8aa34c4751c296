// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/player/speed_meter.h"

namespace carom::test {

using namespace std::chrono_literals;

class SpeedMeterTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void aFifthOfASecondInASecondIsAFifth() {
        SpeedMeter meter;
        const SpeedMeter::Clock::time_point start{};
        QVERIFY(!meter.note(3.0, start));
        QVERIFY(!meter.note(3.05, start + 250ms));
        QCOMPARE(meter.note(3.1, start + 500ms).value(), 0.2);
        // The next window has speeds of its own.
        QVERIFY(!meter.note(3.3, start + 700ms));
        QCOMPARE(meter.note(4.1, start + 1000ms).value(), 2.0);
    }

    void afterAPauseOrASeekBackwardsAWindowBeginsAnew() {
        SpeedMeter meter;
        const SpeedMeter::Clock::time_point start{};
        meter.note(0, start);
        meter.restart();
        QVERIFY(!meter.note(0.1, start + 60s));
        QVERIFY(!meter.note(0.05, start + 61s)); // back in the run
        QCOMPARE(meter.note(1.05, start + 62s).value(), 1.0);
    }
};

} // namespace carom::test

CAROM_TEST(speed_meter_test, carom::test::SpeedMeterTest)
#include "speed_meter_test.moc"
