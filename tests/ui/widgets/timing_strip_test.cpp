// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/files.h"
#include "tests/support/test_class.h"

#include "core/math/random.h"
#include "ui/widgets/timing_strip.h"

#include <QCoreApplication>
#include <QImage>
#include <QMouseEvent>
#include <QSignalSpy>
#include <QTest>
#include <QWheelEvent>

#include <cmath>
#include <numeric>

namespace carom {
namespace {

using test::longestWait;

FrameSample randomSample(Random& random, std::int64_t frame) {
    FrameSample sample;
    FrameStatistics& s = sample.statistics;
    s.frame = frame;
    s.integrate = random.uniform(0, 2);
    s.broadphase = random.uniform(0, 5);
    s.narrowphase = random.uniform(0, 5);
    s.respond = random.uniform(0, 5);
    s.simulate = s.integrate + s.broadphase + s.narrowphase + s.respond + random.uniform(0, 1);
    sample.render = random.uniform(0, 10);
    return sample;
}

std::vector<FrameSample> randomSamples(int count, std::uint64_t seed) {
    Random random(seed);
    std::vector<FrameSample> samples;
    for (int i = 1; i <= count; ++i) samples.push_back(randomSample(random, i));
    return samples;
}

} // namespace

class TimingStripTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void thePartsOfAFrameAddUpToItsWholeTime() {
        for (const FrameSample& sample : randomSamples(100, 1))
            QVERIFY(std::abs(totalOf(sample) - sample.statistics.simulate - sample.render) < 1e-12);
    }

    void stagesThatExceedTheStepByTheClocksGrainLeaveNoNegativeRest() {
        FrameSample sample;
        sample.statistics.simulate = 1;
        sample.statistics.integrate = 1.000001;
        for (const FramePart& part : frameParts()) QVERIFY(part.milliseconds(sample) >= 0);
    }

    void rowsAreTheSharesOfTheScaleToHalfARow() {
        constexpr int height = 200;
        constexpr double fullScale = 40;
        for (const FrameSample& sample : randomSamples(200, 2)) {
            const std::array<int, framePartCount> rows = stackedRows(sample, fullScale, height);
            const int sum = std::accumulate(rows.begin(), rows.end(), 0);
            QVERIFY(std::abs(sum - totalOf(sample) / fullScale * height) <= 0.5);
            for (std::size_t i = 0; i < framePartCount; ++i)
                QVERIFY(std::abs(rows[i] - frameParts()[i].milliseconds(sample) / fullScale * height) <= 1);
        }
    }

    void aFrameBeyondTheScaleFillsTheHeightAndNoMore() {
        FrameSample sample;
        sample.statistics.simulate = sample.statistics.respond = 500;
        const std::array<int, framePartCount> rows = stackedRows(sample, 40, 100);
        QCOMPARE(std::accumulate(rows.begin(), rows.end(), 0), 100);
    }

    void theColumnsOnScreenAreTheSamples() {
        TimingStrip strip;
        strip.resize(300, 160);
        const std::vector<FrameSample> samples = randomSamples(80, 3);
        strip.addSamples(samples);
        strip.show();
        QVERIFY(QTest::qWaitForWindowExposed(&strip, longestWait));
        QCOMPARE(strip.fullScale(), 40.0);
        const QImage image = strip.grab().toImage();
        for (int x = 299; x >= 300 - 2 * 80; --x) {
            const std::ptrdiff_t index = strip.frameAt(x);
            QCOMPARE(index, 80 - 1 - (299 - x) / 2);
            const std::array<int, framePartCount> rows =
                stackedRows(samples[static_cast<std::size_t>(index)], 40, 160);
            std::array<int, framePartCount> seen{};
            for (int y = 1; y + 1 < 160; ++y)
                for (std::size_t part = 0; part < framePartCount; ++part)
                    if (image.pixel(x, y) == frameParts()[part].colour.rgb()) ++seen[part];
            // The lowest row, the frame of the focus and the two dashed lines may each cover one.
            for (std::size_t part = 0; part < framePartCount; ++part)
                QVERIFY(seen[part] <= rows[part] && seen[part] >= rows[part] - 4);
        }
        QCOMPARE(strip.frameAt(299 - 2 * 80), TimingStrip::noFrame);
    }

    void theScaleFollowsTheFramesAndKeepsTheBudgetLinesInView() {
        TimingStrip strip;
        strip.resize(300, 160);
        FrameSample quick;
        quick.statistics.frame = 2;
        quick.statistics.simulate = quick.statistics.respond = 0.3;
        strip.addSamples({&quick, 1});
        QCOMPARE(strip.fullScale(), 40.0);
        strip.setScale(TimingStrip::Scale::Fit);
        QCOMPARE(strip.fullScale(), 0.5);
        FrameSample slow = quick;
        slow.statistics.simulate = slow.statistics.respond = 90;
        strip.addSamples({&slow, 1});
        QCOMPARE(strip.fullScale(), 100.0);
    }

    void theBudgetBoundsTheSamplesAndKeepsTheNewest() {
        TimingStrip strip;
        strip.addSamples(randomSamples(20'000, 5));
        strip.setBudget(6000 * sizeof(FrameSample));
        QVERIFY(strip.samples().size() <= 6000);
        QVERIFY(strip.bytes() <= 6000 * sizeof(FrameSample));
        QCOMPARE(strip.samples().back().statistics.frame, std::int64_t{20'000});
        strip.clear();
        QCOMPARE(strip.bytes(), std::size_t{0});
    }

    void theBudgetHoldsWhileFramesCome() {
        TimingStrip strip;
        constexpr std::size_t most = 6000;
        strip.setBudget(most * sizeof(FrameSample));
        const std::vector<FrameSample> samples = randomSamples(20'000, 5);
        for (std::size_t i = 0; i < samples.size(); i += 700) {
            strip.addSamples(std::span(samples).subspan(i, std::min<std::size_t>(700, samples.size() - i)));
            QVERIFY(strip.bytes() <= most * sizeof(FrameSample));
        }
        QCOMPARE(strip.samples().back().statistics.frame, std::int64_t{20'000});
        strip.addSamples(samples); // more than there may be, at once
        QVERIFY(strip.bytes() <= most * sizeof(FrameSample));
        QCOMPARE(strip.samples().back().statistics.frame, std::int64_t{20'000});
    }

    void theWheelZoomsAtTheMouse() {
        TimingStrip strip;
        strip.resize(300, 100);
        strip.addSamples(randomSamples(2000, 7));
        const auto turn = [&strip](int by, int x) {
            QWheelEvent event({double(x), 50}, strip.mapToGlobal(QPointF(x, 50)), {}, {0, by}, Qt::NoButton,
                              Qt::NoModifier, Qt::NoScrollPhase, false);
            QCoreApplication::sendEvent(&strip, &event);
        };
        strip.scrollTo(500);
        const std::ptrdiff_t under = strip.frameAt(100);
        turn(120, 100);
        QCOMPARE(strip.columnWidth(), 4);
        QCOMPARE(strip.frameAt(100), under);
        turn(120, 100);
        QCOMPARE(strip.frameAt(100), under);
        turn(-120, 100);
        turn(-120, 100);
        QCOMPARE(strip.columnWidth(), 2);
        QCOMPARE(strip.frameAt(100), under);
    }

    void aColumnOfSeveralFramesShowsTheSlowest() {
        TimingStrip strip;
        strip.resize(300, 160);
        std::vector<FrameSample> samples = randomSamples(2048, 8);
        constexpr std::size_t slow = 1003;
        samples[slow].statistics.respond += 30;
        samples[slow].statistics.simulate += 30;
        strip.addSamples(samples);
        strip.show();
        QVERIFY(QTest::qWaitForWindowExposed(&strip, longestWait));
        strip.setFocus();
        for (int i = 0; i < 10; ++i) QTest::keyClick(&strip, Qt::Key_Minus);
        QCOMPARE(strip.framesAColumn(), std::ptrdiff_t{8}); // the whole run fits, and no more
        const int x = 299 - (2047 / 8 - static_cast<int>(slow) / 8);
        QCOMPARE(strip.frameAt(x), static_cast<std::ptrdiff_t>(slow));
        QTest::mouseClick(&strip, Qt::LeftButton, {}, {x, 50});
        QCOMPARE(strip.picked(), static_cast<std::ptrdiff_t>(slow));
        const QImage image = strip.grab().toImage();
        int height = 0;
        for (const int rows : stackedRows(samples[slow], strip.fullScale(), 160)) height += rows;
        QVERIFY(image.pixel(x + 4, 160 - height + 4) != image.pixel(x, 160 - height + 4));
        for (int i = 0; i < 10; ++i) QTest::keyClick(&strip, Qt::Key_Plus);
        QCOMPARE(strip.framesAColumn(), std::ptrdiff_t{1});
        QCOMPARE(strip.columnWidth(), 16);
    }

    void aDragAndKeysMoveAlongTheRun() {
        TimingStrip strip;
        strip.resize(300, 100);
        strip.addSamples(randomSamples(1000, 9));
        const std::ptrdiff_t under = strip.frameAt(100);
        QTest::mousePress(&strip, Qt::RightButton, {}, {100, 50});
        QMouseEvent move(QEvent::MouseMove, QPointF(180, 50), strip.mapToGlobal(QPointF(180, 50)),
                         Qt::NoButton, Qt::RightButton, Qt::NoModifier);
        QCoreApplication::sendEvent(&strip, &move);
        QCOMPARE(strip.frameAt(180), under);
        QTest::mouseRelease(&strip, Qt::RightButton, {}, {180, 50});
        QCOMPARE(strip.picked(), TimingStrip::noFrame);
        QTest::keyClick(&strip, Qt::Key_Home);
        QCOMPARE(strip.frameAt(1), std::ptrdiff_t{0});
        QTest::keyClick(&strip, Qt::Key_PageDown);
        QCOMPARE(strip.frameAt(1), std::ptrdiff_t{150});
        QTest::keyClick(&strip, Qt::Key_PageUp);
        QCOMPARE(strip.frameAt(1), std::ptrdiff_t{0});
        QTest::keyClick(&strip, Qt::Key_End);
        QCOMPARE(strip.scrolledBack(), std::ptrdiff_t{0});
    }

    void theGraphCanShowTheSimulationOnly() {
        FrameSample sample;
        sample.statistics.frame = 2;
        sample.statistics.simulate = sample.statistics.respond = 0.3;
        sample.render = 30;
        TimingStrip strip;
        strip.setScale(TimingStrip::Scale::Fit);
        strip.addSamples({&sample, 1});
        QCOMPARE(strip.fullScale(), 50.0);
        strip.showPart(framePartCount - 1, false); // drawing
        QCOMPARE(strip.fullScale(), 0.5);
        strip.showPart(framePartCount - 1, true);
        QCOMPARE(strip.fullScale(), 50.0);
    }

    void aLineStandsAtTheFrameOnScreen() {
        TimingStrip strip;
        strip.resize(300, 160);
        strip.addSamples(randomSamples(80, 3));
        QVERIFY(!strip.cursor());
        strip.showFrame(71);
        QCOMPARE(strip.frameAt(strip.cursor().value()), std::ptrdiff_t{70});
        strip.show();
        QVERIFY(QTest::qWaitForWindowExposed(&strip, longestWait));
        const QRgb line = strip.palette().color(QPalette::Highlight).rgb();
        QCOMPARE(strip.grab().toImage().pixel(*strip.cursor(), 20), line);
        strip.showFrame(1000); // not in the graph
        QVERIFY(!strip.cursor());
    }

    void theFirstFrameDoesNotSetTheScale() {
        TimingStrip strip;
        strip.setScale(TimingStrip::Scale::Fit);
        std::vector<FrameSample> samples(2);
        samples[0].statistics.frame = 1;
        samples[0].statistics.simulate = 900;
        samples[1].statistics.frame = 2;
        samples[1].statistics.simulate = 1.5;
        strip.addSamples(samples);
        QCOMPARE(strip.fullScale(), 2.0);
    }

    void aClickPicksTheFrameUnderItAndArrowsGoOnFromThere() {
        TimingStrip strip;
        strip.resize(300, 100);
        strip.addSamples(randomSamples(50, 4));
        strip.show();
        QVERIFY(QTest::qWaitForWindowExposed(&strip, longestWait));
        QSignalSpy picked(&strip, &TimingStrip::framePicked);
        QTest::mouseClick(&strip, Qt::LeftButton, {}, {299, 50});
        QCOMPARE(strip.picked(), std::ptrdiff_t{49});
        QTest::keyClick(&strip, Qt::Key_Left);
        QCOMPARE(strip.picked(), std::ptrdiff_t{48});
        QTest::keyClick(&strip, Qt::Key_Right);
        QTest::keyClick(&strip, Qt::Key_Right); // there is no later one
        QCOMPARE(strip.picked(), std::ptrdiff_t{49});
        QTest::mouseClick(&strip, Qt::LeftButton, {}, {5, 50}); // left of the first frame
        QCOMPARE(strip.picked(), TimingStrip::noFrame);
        QCOMPARE(picked.size(), 4);
    }

    void clearingForgetsEverything() {
        TimingStrip strip;
        strip.addSamples(randomSamples(10, 5));
        strip.pick(3);
        strip.clear();
        QVERIFY(strip.samples().empty());
        QCOMPARE(strip.picked(), TimingStrip::noFrame);
        strip.grab(); // and an empty strip can be painted
    }

    void aBreakdownNamesEveryPart() {
        const QString text = breakdownOf(randomSamples(1, 6).front());
        for (const FramePart& part : frameParts()) QVERIFY(text.contains(nameOf(part)));
    }
};

} // namespace carom

CAROM_TEST_WITH(QApplication, timing_strip_test, carom::TimingStripTest)
#include "timing_strip_test.moc"
