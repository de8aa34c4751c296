// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/files.h"
#include "tests/support/test_class.h"

#include "core/integrators/integrator.h"
#include "core/simulation/build.h"
#include "core/study/accuracy_csv.h"
#include "core/study/measures.h"
#include "ui/docks/accuracy_dock.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFile>
#include <QImage>
#include <QLabel>
#include <QMenu>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalSpy>
#include <QSpinBox>
#include <QTemporaryDir>
#include <QTest>
#include <QToolButton>

#include <memory>

// The Accuracy panel: a study in the background with progress, its knobs, its points, and what is written.

namespace carom {
namespace {

using test::longestWait;

SharedBuild built(const char* text) {
    auto result = std::make_shared<BuildResult>();
    result->build = build(text);
    return result;
}

const char* const bouncing = "wall { normal 0, 1, 0 toOrig 0 }\n"
                             "sphere { radius 0.1 mass 1 centre 0, 1, 0 vel 0.5, 0, 0 }\n"
                             "simulation { method contacts }\n";
const char* const swinging = "sphere bob { radius 0.1 mass 1 centre 0, 0.8, 0 }\n"
                             "spring { from world to bob fromAt 0.5, 2, 0 stiffness 100 length 1 }\n";

} // namespace

class AccuracyDockTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void init() {
        m_dock = std::make_unique<AccuracyDock>();
        m_dock->resize(1200, 700);
        m_dock->show();
        m_start = child<QPushButton>("accuracyStart");
        m_duration = child<QDoubleSpinBox>("accuracyDuration");
        m_run = child<QPushButton>("accuracyRun");
        m_use = child<QPushButton>("accuracyUse");
        m_plot = m_dock->findChild<PlotWidget*>();
        m_duration->setValue(0.5);
    }

    void withoutASceneThereIsNothingToStudy() {
        QVERIFY(!m_start->isEnabled());
        QVERIFY(m_dock->exportTo(m_folder.filePath(QStringLiteral("none.csv")))
                    .contains(QStringLiteral("nothing was studied yet")));
        m_dock->setScene(built("wall { normal 0, 1, 0 toOrig 0 }"), QStringLiteral("still"));
        QVERIFY(!m_start->isEnabled());
        QCOMPARE(m_start->toolTip(), QStringLiteral("Nothing in the scene can move"));
    }

    void aStudyShowsItsProgressAndThenItsRecommendation() {
        QSignalSpy reported(m_dock.get(), &AccuracyDock::reported);
        m_dock->setScene(built(swinging), QStringLiteral("swing"));
        m_start->click();
        QCOMPARE(m_start->text(), QStringLiteral("Stop"));
        QProgressBar* progress = m_dock->findChild<QProgressBar*>();
        QVERIFY(progress->isVisible());
        QTRY_VERIFY_WITH_TIMEOUT(progress->value() > 0, longestWait);
        finish();
        QVERIFY(!progress->isVisible());
        QVERIFY(m_dock->result()->complete);
        QVERIFY(child<QLabel>("accuracyVerdict")->text().contains(QStringLiteral("per simulated second")));
        QCOMPARE(reported.size(), 1);
        QVERIFY(reported[0][0].toString().startsWith(QStringLiteral("accuracy of swing studied in")));
        QVERIFY(m_plot->chart().series.size() > 8); // a line a family, the front, the scene's own
        QVERIFY(m_plot->chart().x.logarithmic && m_plot->chart().y.logarithmic);
    }

    void theKnobsLeaveMethodsAndIntegratorsOut() {
        m_dock->setScene(built(swinging), QStringLiteral("swing"));
        tryOnly({QStringLiteral("contacts"), QStringLiteral("verlet")});
        study();
        for (const AccuracyPoint& point : m_dock->result()->points) {
            if (point.isDefault) continue; // what the scene runs with is always there
            QCOMPARE(point.setting.method->name, std::string_view("contacts"));
            QCOMPARE(point.setting.integrator->name, std::string_view("verlet"));
        }
        QVERIFY(m_dock->result()->points.size() > 5);
    }

    void anotherEngineThatIsInstalledCanBeComparedWith() {
        const QString program = m_folder.filePath(QStringLiteral("carom-engine-still"));
        test::writeFile(program, "#!/bin/sh\necho lacks,motion\n");
        QFile::setPermissions(program, QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
        const QByteArray path = qgetenv("PATH");
        init(); // no panel looks for it before its menu is opened
        qputenv("PATH", m_folder.path().toUtf8() + ":" + path);
        Q_EMIT child<QToolButton>("accuracyKnobs")->menu()->aboutToShow();
        m_dock->setScene(built(swinging), QStringLiteral("swing"));
        tryOnly({QStringLiteral("contacts"), QStringLiteral("verlet")});
        study();
        const auto ofEngine = [&] {
            return std::ranges::count_if(m_dock->result()->points, [](const AccuracyPoint& point) {
                return point.setting.engine == "still" && point.reason.text() == "it has no motion";
            });
        };
        QCOMPARE(ofEngine(), 0);
        for (QAction* action : child<QToolButton>("accuracyKnobs")->menu()->actions())
            if (action->data().toString() == QStringLiteral("still")) action->trigger();
        study();
        qputenv("PATH", path);
        QCOMPARE(ofEngine(), 10); // 1 to 16 steps, its own rules and tuned
        QVERIFY(child<QLabel>("accuracyPoint")
                    ->text()
                    .contains(QStringLiteral("Engine still, tuned: it has no motion.")));
    }

    void aClickOnAPointChoosesItRunsItAndPutsItIntoTheText() {
        m_dock->setScene(built(bouncing), QStringLiteral("ball"));
        tryOnly(aFew);
        study();
        QVERIFY(!m_run->isEnabled());
        QSignalSpy runs(m_dock.get(), &AccuracyDock::runWanted);
        QSignalSpy settings(m_dock.get(), &AccuracyDock::settingWanted);
        Q_EMIT m_plot->pointClicked(0, 0);
        QVERIFY(m_run->isEnabled() && m_use->isEnabled());
        const QString told = child<QLabel>("accuracyPoint")->text();
        QVERIFY2(told.contains(QStringLiteral("ms per simulated second")), qPrintable(told));
        QVERIFY2(told.contains(QStringLiteral("impacts")), qPrintable(told));
        const ChartSeries mark = m_plot->chart().series.back(); // a ring around it
        QCOMPARE(mark.mark, SeriesMark::Halo);
        QCOMPARE(mark.x.front(), m_plot->chart().series.front().x.front());
        QCOMPARE(mark.y.front(), m_plot->chart().series.front().y.front());
        m_run->click();
        m_use->click();
        const auto pipeline = runs[0][0].value<std::shared_ptr<const Pipeline>>();
        const auto wanted = settings[0][0].value<SimulationSettings>();
        QVERIFY(told.startsWith(QString::fromStdString(std::string(pipeline->settings().method->name))));
        QCOMPARE(wanted.substeps, pipeline->settings().substeps);
        QCOMPARE(*wanted.method, std::string(pipeline->settings().method->name));

        // Another text: the point still runs, but it would be written into a scene it was not studied on.
        m_dock->setScene(built(swinging), QStringLiteral("swing"));
        QVERIFY(m_run->isEnabled() && !m_use->isEnabled());
        Q_EMIT m_plot->pointClicked(999, 0); // a mark that is no point of a setting
        QVERIFY(m_run->isEnabled());
    }

    void theMeasureCanBeChosenBeforeAndAfterAStudy() {
        m_dock->setScene(built(bouncing), QStringLiteral("ball"));
        tryOnly(aFew);
        QComboBox* measure = child<QComboBox>("accuracyMeasure");
        QCOMPARE(measure->count(), 1 + static_cast<int>(measures().size()));
        measure->setCurrentIndex(measure->findText(QStringLiteral("energy")));
        study();
        QCOMPARE(m_dock->result()->measure->name, std::string_view("energy"));
        QVERIFY(m_plot->chart().x.label.contains(QStringLiteral("energy")));
        measure->setCurrentIndex(0);
        QCOMPARE(m_dock->result()->measure->name, std::string_view("trajectory"));
        QVERIFY(m_plot->chart().x.label.contains(QStringLiteral("distance by scene size")));
        QVERIFY(child<QLabel>("accuracyVerdict")->text().startsWith(QStringLiteral("Error ")));
    }

    void theBudgetIsThatOfTheStudy() {
        m_dock->setScene(built(bouncing), QStringLiteral("ball"));
        tryOnly(aFew);
        child<QSpinBox>("accuracyBudget")->setValue(7);
        study();
        QCOMPARE(m_dock->result()->plan.budget, 7.0);
        QVERIFY(m_dock->result()->complete);
    }

    void aStudyThatIsStoppedGoesOnWhereItWas() {
        m_dock->setScene(built(swinging), QStringLiteral("swing"));
        m_duration->setValue(8);
        m_start->click();
        QTRY_VERIFY_WITH_TIMEOUT(m_dock->result() && m_dock->result()->points.front().finished(),
                                 longestWait);
        m_start->click();
        finish();
        QVERIFY(!m_dock->result()->complete);
        QCOMPARE(m_start->text(), QStringLiteral("Go on"));
        const AccuracyPoint before = m_dock->result()->points.front();
        m_duration->setValue(7);
        QCOMPARE(m_start->text(), QStringLiteral("Study")); // another study
        m_duration->setValue(8);
        QCOMPARE(m_start->text(), QStringLiteral("Go on"));
        m_start->click();
        QTRY_VERIFY_WITH_TIMEOUT(child<QProgressBar>("accuracyProgress")->value() > 0, longestWait);
        m_start->click();
        finish();
        const AccuracyPoint& after = m_dock->result()->points.front();
        QCOMPARE(after.errors.position, before.errors.position);
        QVERIFY(after.times.size() >= before.times.size());
        m_dock->setScene(built(bouncing), QStringLiteral("ball"));
        QCOMPARE(m_start->text(), QStringLiteral("Study"));
    }

    void aKeptStudyIsShownTogetherWithAnother() {
        m_dock->setScene(built(bouncing), QStringLiteral("ball"));
        tryOnly(aFew);
        study();
        const std::size_t alone = m_plot->chart().series.size();
        child<QToolButton>("accuracyKeep")->click();
        QCOMPARE(m_plot->chart().series.size(), alone); // not with itself
        m_dock->setScene(built(swinging), QStringLiteral("swing"));
        study();
        int balls = 0, swings = 0;
        for (const ChartSeries& series : m_plot->chart().series) {
            balls += series.name.startsWith(QStringLiteral("ball: ")) ? 1 : 0;
            swings += series.name.startsWith(QStringLiteral("swing: ")) ? 1 : 0;
        }
        QVERIFY(balls > 2 && swings > 2);
        Q_EMIT m_plot->pointClicked(0, 0); // of the kept one
        QVERIFY(!m_run->isEnabled());
        Q_EMIT m_plot->pointClicked(balls, 0);
        QVERIFY(m_run->isEnabled());
        const ChartSeries mark = m_plot->chart().series.back(); // a ring around it, as where nothing is kept
        QCOMPARE(mark.mark, SeriesMark::Halo);
        QCOMPARE(mark.x.front(), m_plot->chart().series[static_cast<std::size_t>(balls)].x.front());
    }

    void diagramAndFiguresAreWritten() {
        m_dock->setScene(built(bouncing), QStringLiteral("ball"));
        tryOnly(aFew);
        study();
        for (const char* ending : {"png", "svg", "pdf"}) {
            const QString path = m_folder.filePath(QStringLiteral("a.") + QLatin1StringView(ending));
            QCOMPARE(m_dock->exportTo(path), QString());
            QVERIFY(QFile(path).size() > 1000);
        }
        QVERIFY(!QImage(m_folder.filePath(QStringLiteral("a.png"))).isNull());
        const QString csv = m_folder.filePath(QStringLiteral("a.csv"));
        QCOMPARE(m_dock->exportTo(csv), QString());
        QFile file(csv);
        QVERIFY(file.open(QIODevice::ReadOnly));
        const ReadPoints read =
            pointsFromCsv(file.readAll().toStdString(),
                          {hashOfScene(bouncing), 0.5, QApplication::applicationVersion().toStdString()});
        QCOMPARE(read.objection, std::string());
        QCOMPARE(read.known.points.size(), m_dock->result()->points.size());
        QVERIFY(!m_dock->exportTo(QStringLiteral("/dev/null/a.csv")).isEmpty());
    }

  private:
    /// Enough families for what is shown and written of a study, in a third of the time of all.
    const QStringList aFew = {QStringLiteral("contacts"), QStringLiteral("microcollisions"),
                              QStringLiteral("symplectic"), QStringLiteral("verlet")};

    void tryOnly(const QStringList& names) {
        for (QAction* action : child<QToolButton>("accuracyKnobs")->menu()->actions())
            if (action->isCheckable()) action->setChecked(names.contains(action->data().toString()));
    }
    template<class Widget>
    Widget* child(const char* name) const {
        return m_dock->findChild<Widget*>(QLatin1StringView(name));
    }
    void finish() { QTRY_VERIFY_WITH_TIMEOUT(m_start->text() != QStringLiteral("Stop"), longestWait); }
    void study() {
        m_start->click();
        finish();
    }

    QTemporaryDir m_folder;
    std::unique_ptr<AccuracyDock> m_dock;
    QPushButton *m_start = nullptr, *m_run = nullptr, *m_use = nullptr;
    QDoubleSpinBox* m_duration = nullptr;
    PlotWidget* m_plot = nullptr;
};

} // namespace carom

CAROM_TEST_WITH(QApplication, accuracy_dock_test, carom::AccuracyDockTest)
#include "accuracy_dock_test.moc"
