// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/files.h"
#include "tests/support/test_class.h"

#include "ui/base/pauses.h"
#include "ui/docks/effects_dock.h"

#include "core/effects/effect.h"

#include <QTest>
#include <QTextBrowser>

#include <vector>

namespace carom {
namespace {

using test::longestWait;

/// A ball over a floor, built.
SharedBuild ballOverFloor() {
    auto result = std::make_shared<BuildResult>();
    result->build = build("wall { normal 0,1,0 toOrig 0 }\nsphere { radius 1 mass 1 centre 0,3,0 }\n");
    return result;
}

/// Frames that respond for 1, 2, … ms, and do nothing else; the first takes 500 ms.
std::vector<FrameSample> responses(int count) {
    std::vector<FrameSample> samples(static_cast<std::size_t>(count) + 1);
    for (int i = 0; i <= count; ++i) {
        FrameStatistics& frame = samples[static_cast<std::size_t>(i)].statistics;
        frame.frame = i + 1;
        frame.respond = frame.simulate = i == 0 ? 500 : i;
    }
    return samples;
}

} // namespace

class EffectsDockTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void initTestCase() { shortenPauses(10); }

    void everyEffectHasItsReasonAndTheLineThatCallsForIt() {
        EffectsDock dock(loadTheme(true));
        dock.show(ballOverFloor());
        const QString text = dock.findChild<QTextBrowser*>()->toPlainText();
        for (const EffectRow& row : effects())
            QVERIFY2(
                text.contains(QString::fromUtf8(row.title.data(), static_cast<qsizetype>(row.title.size()))),
                row.title.data());
        QVERIFY(text.contains(QStringLiteral("Springs  absent")));
        QVERIFY(text.contains(QStringLiteral("line 2")));
        QVERIFY(!text.contains(QStringLiteral("A frame takes"))); // nothing has run
    }

    void whatAFrameTakesIsTheMeanOfTheNewestWithoutTheFirst() {
        EffectsDock dock(loadTheme(true));
        dock.show(ballOverFloor());
        dock.QWidget::show();
        dock.addSamples(responses(20));
        const QTextBrowser* text = dock.findChild<QTextBrowser*>();
        QTRY_VERIFY_WITH_TIMEOUT(text->toPlainText().contains(QStringLiteral("A frame takes 10.500 ms")),
                                 longestWait);
        QVERIFY(text->toPlainText().contains(QStringLiteral("respond 10.500")));
        dock.addSamples(responses(100)); // of which the last sixty count
        QTRY_VERIFY_WITH_TIMEOUT(text->toPlainText().contains(QStringLiteral("A frame takes 70.500 ms")),
                                 longestWait);
        dock.clear();
        QTRY_VERIFY_WITH_TIMEOUT(!text->toPlainText().contains(QStringLiteral("A frame takes")), longestWait);
    }
};

} // namespace carom

CAROM_TEST_WITH(QApplication, effects_dock_test, carom::EffectsDockTest)
#include "effects_dock_test.moc"
