// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/files.h"
#include "tests/support/test_class.h"

#include "core/simulation/build.h"
#include "ui/docks/race_dock.h"
#include "ui/viewport/viewport.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFile>
#include <QImage>
#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>
#include <QSlider>
#include <QSpinBox>
#include <QTemporaryDir>
#include <QTest>
#include <QToolButton>

#include <memory>

// The Race panel: two runs side by side, one camera, one time, the distance, and what differs first.

namespace carom {
namespace {

using test::longestWait;

SharedBuild builtRace(const QByteArray& text) {
    auto result = std::make_shared<BuildResult>();
    result->build = build(text.toStdString());
    return result;
}

const QByteArray pendulum = "gravity { accel 0, -10, 0 }\n"
                            "sphere bob { radius 0.1  mass 1  centre 1, 0, 0 }\n"
                            "spring { from world  to bob  stiffness 100  length 1 }\n";

} // namespace

class RaceDockTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void init() {
        m_dock = std::make_unique<RaceDock>();
        m_dock->resize(1300, 500);
        m_dock->show();
        m_dock->setScene(builtRace(pendulum), QStringLiteral("swing"));
        child<QDoubleSpinBox>("raceDuration")->setValue(1);
    }

    void withoutASceneThatMovesThereIsNoRace() {
        QVERIFY(child<QPushButton>("raceStart")->isEnabled());
        m_dock->setScene(builtRace("wall { normal 0, 1, 0 toOrig 0 }"), QStringLiteral("still"));
        QVERIFY(!child<QPushButton>("raceStart")->isEnabled());
        QVERIFY(m_dock->exportTo(m_folder.filePath(QStringLiteral("none.csv")))
                    .contains(QStringLiteral("no race yet")));
    }

    // The same setting twice: no bit differs, and the chart is empty.
    void theSameSettingTwiceDiffersNowhere() {
        race();
        QCOMPARE(m_dock->recording()->count(), 61);
        QVERIFY(!m_dock->recording()->firstDifference());
        QCOMPARE(child<QPushButton>("raceFirst")->text(), QStringLiteral("no bit differs in 60 frames"));
        QVERIFY(!child<QPushButton>("raceFirst")->isEnabled());
    }

    void twoSettingsPartAndTheFirstDifferenceIsNamed() {
        child<QSpinBox>("raceSubstepsA")->setValue(4);
        child<QSpinBox>("raceSubstepsB")->setValue(8);
        QSignalSpy reported(m_dock.get(), &RaceDock::reported);
        race();
        // Only what differs, so that it is read in a narrow panel; the tip says all.
        QCOMPARE(child<QLabel>("raceTitleA")->text(), QStringLiteral("A: swing, 4 substeps a frame"));
        QCOMPARE(child<QLabel>("raceTitleB")->text(), QStringLiteral("B: swing, 8 substeps a frame"));
        const QString tip = child<QLabel>("raceTitleA")->toolTip();
        QVERIFY2(tip.startsWith(QStringLiteral("A: swing, preset default, method contacts, ")),
                 qPrintable(tip));
        QCOMPARE(child<QPushButton>("raceFirst")->text(),
                 QStringLiteral("first difference: frame 1, 0.0167 s: position of `bob`"));
        QCOMPARE(reported.size(), 1);
        const ChartSpec& chart = m_dock->findChild<PlotWidget*>()->chart();
        QCOMPARE(chart.series.size(), std::size_t(1));
        QCOMPARE(chart.series[0].x.size(), std::size_t(61));
        QVERIFY(chart.series[0].y[60] > chart.series[0].y[1]);
        const QString csv = m_folder.filePath(QStringLiteral("race.csv"));
        QCOMPARE(m_dock->exportTo(csv), QString());
        QVERIFY(test::readFile(csv).startsWith("frame,time,distance,body,label\n0,0,0,-1,\n1,"));
        const QString png = m_folder.filePath(QStringLiteral("race.png"));
        QCOMPARE(m_dock->exportTo(png), QString());
        QVERIFY(!QImage(png).isNull());
    }

    void oneTimeIsShownInBothViews() {
        child<QSpinBox>("raceSubstepsB")->setValue(2);
        race();
        child<QSlider>("raceSlider")->setValue(30);
        QCOMPARE(m_dock->shownFrame(), 30);
        Q_EMIT m_dock->findChild<PlotWidget*>()->placeClicked(0.75);
        QCOMPARE(m_dock->shownFrame(), 45);
        child<QPushButton>("raceFirst")->click();
        QCOMPARE(m_dock->shownFrame(), 1);
        QCOMPARE(*m_dock->findChild<PlotWidget*>()->cursor(), 1.0 / 60);
        Q_EMIT m_dock->findChild<PlotWidget*>()->placeClicked(1e9);
        QCOMPARE(m_dock->shownFrame(), 60);
    }

    void oneCameraLooksAtBoth() {
        race();
        Camera camera = m_dock->viewport(0).camera();
        camera.target.x() += 1;
        m_dock->viewport(0).setCamera(camera);
        QCOMPARE(m_dock->viewport(1).camera().target.x(), camera.target.x());
        m_dock->viewport(1).lookFrom(ViewSide::Top);
        const Camera turned = m_dock->viewport(1).camera();
        QCOMPARE(m_dock->viewport(0).camera().yaw, turned.yaw);
        QCOMPARE(m_dock->viewport(0).camera().pitch, turned.pitch);
    }

    void playingGoesOnInRealTimeAndEnds() {
        race();
        QToolButton* play = child<QToolButton>("racePlay");
        play->setChecked(false);
        child<QSlider>("raceSlider")->setValue(50);
        play->setChecked(true);
        QTRY_VERIFY_WITH_TIMEOUT(!play->isChecked(), longestWait);
        QCOMPARE(m_dock->shownFrame(), 60);
        play->setChecked(true); // from the start again
        QVERIFY(m_dock->shownFrame() < 60);
        play->setChecked(false);
    }

    void anotherTextRacesTheFirst() {
        QByteArray other = pendulum;
        other.replace("1, 0, 0", "1.5, 0, 0");
        m_dock->setOtherText(QString::fromUtf8(other), QStringLiteral("swing before"));
        race();
        QVERIFY(child<QLabel>("raceTitleB")->text().startsWith(QStringLiteral("B: swing before")));
        QCOMPARE(m_dock->recording()->firstDifference()->frame, 0);
        m_dock->setOtherText(QStringLiteral("sphere { radius 1 mass 1 centre 0, 0, 0 } "
                                            "sphere { radius 1 mass 1 centre 9, 0, 0 }"),
                             QStringLiteral("two"));
        race();
        const QString said = child<QLabel>("raceState")->text();
        QVERIFY2(said.startsWith(QStringLiteral("the two scenes have other bodies")), qPrintable(said));
        QVERIFY(child<QLabel>("raceTitleB")->text().startsWith(QStringLiteral("B: swing before"))); // stays
    }

    void whatIsStoppedIsKept() {
        child<QDoubleSpinBox>("raceDuration")->setValue(1000);
        QPushButton* start = child<QPushButton>("raceStart");
        start->click();
        QCOMPARE(start->text(), QStringLiteral("Stop"));
        QTRY_VERIFY_WITH_TIMEOUT(m_dock->recording() != nullptr && m_dock->recording()->count() > 10,
                                 longestWait);
        start->click();
        QTRY_COMPARE_WITH_TIMEOUT(start->text(), QStringLiteral("Race"), longestWait);
        QVERIFY(m_dock->recording()->count() > 10);
        QCOMPARE(child<QSlider>("raceSlider")->maximum(), static_cast<int>(m_dock->recording()->count() - 1));
    }

  private:
    template<class Widget>
    Widget* child(const char* name) {
        return m_dock->findChild<Widget*>(QString::fromLatin1(name));
    }
    void race() {
        QPushButton* start = child<QPushButton>("raceStart");
        start->click();
        QTRY_COMPARE_WITH_TIMEOUT(start->text(), QStringLiteral("Race"), longestWait);
        child<QToolButton>("racePlay")->setChecked(false);
    }

    QTemporaryDir m_folder;
    std::unique_ptr<RaceDock> m_dock;
};

} // namespace carom

CAROM_TEST_WITH(QApplication, race_dock_test, carom::RaceDockTest)
#include "race_dock_test.moc"
