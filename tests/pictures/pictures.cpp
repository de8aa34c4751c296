// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/errors.h"
#include "app/files.h"
#include "tests/support/whole_ide.h"

#include "core/generators/generator.h"
#include "ui/docks/accuracy_dock.h"
#include "ui/docks/breakpoints_dock.h"
#include "ui/docks/broadphase_comparison.h"
#include "ui/docks/broadphase_dock.h"
#include "ui/docks/inspector_dock.h"
#include "ui/docks/plots_dock.h"
#include "ui/docks/stability_dock.h"
#include "ui/docks/timing_dock.h"
#include "ui/window/help_commands.h"
#include "ui/window/manual_window.h"

#include <QComboBox>
#include <QDir>
#include <QPushButton>
#include <QSettings>
#include <QToolButton>

#include <array>

// carom-pictures manual|look FOLDER: drives the IDE as a user would and saves what is on screen as PNG files.
//   manual  the pictures of the manual and the README
//   look    every workspace, panel and dialog in both themes, to look them over

namespace carom {
namespace {

using namespace test;

constexpr QSize manualSize{1280, 800}, lookSize{1600, 1000}; // [px]
constexpr int settleTime = 700;                              // [ms] until the viewport draws smoothly
constexpr int studyTime = 600'000;                           // [ms] a study may take
constexpr int longEnough = 25'000;                           // [ms] for a chart of some points

QByteArray shipped(const char* scene) {
    return readFile(QStringLiteral(CAROM_SOURCE_DIR "/scenes/%1.sdl").arg(QLatin1StringView(scene)));
}

QByteArray generated(const char* generator, std::int64_t bodies) {
    GeneratorRequest request;
    request.n = bodies;
    return QByteArray::fromStdString(generate(*findGenerator(generator), request));
}

/// Pictures come from a thread that a machine under load keeps waiting: one that is asked for and waited for
/// comes behind those that were due.
void awaitPictures(const QWidget& widget) {
    constexpr int dueInARow = 3; // of the state before, of the last one, and its smooth one
    for (Viewport* viewport : widget.window()->findChildren<Viewport*>()) {
        for (int i = 0; i < dueInARow; ++i) {
            viewport->shownPicture();
            QTest::qWait(settleTime / dueInARow);
        }
    }
}

class Photographer {
  public:
    explicit Photographer(QString folder) : m_folder(std::move(folder)) {}

    bool manual();
    bool look();

  private:
    /// The widget, or a part of it.
    void save(QWidget& widget, const QString& name, const QRect& part = {{0, 0}, QSize(-1, -1)}) {
        QTest::qWait(settleTime);
        awaitPictures(widget);
        const QString path = QDir(m_folder).filePath(name + QStringLiteral(".png"));
        m_allSaved = widget.grab(part).save(path) && m_allSaved;
    }
    /// In both themes.
    void saveTwice(Ide& ide, QWidget& widget, const QString& name);
    void lookAtWorkspaces();
    void lookAtPanels();
    void lookAtDialogs();

    QString m_folder;
    bool m_allSaved = true;
};

template<class Condition>
void awaitThat(const Condition& condition, int most = longestWait) {
    if (!QTest::qWaitFor(condition, most)) qFatal("what the picture is to show did not come");
}

void reach(Ide& ide, std::int64_t frame) {
    ide.simulation.seek(frame);
    awaitThat([&] { return ide.frame >= frame; }, studyTime);
}

void play(Ide& ide, std::int64_t frames) {
    ide.trigger(ActionId::Play);
    awaitThat([&] { return ide.frame >= frames; }, studyTime);
    ide.trigger(ActionId::Play);
    awaitThat([&] { return !ide.simulation.isRunning(); });
}

/// Stopped after `most` [ms]: what there is then is shown.
void compareAll(Ide& ide, int subject, int most = studyTime) {
    BroadphaseDock& dock = ide.bench.window().broadphase();
    BroadphaseComparison* comparison = dock.findChild<BroadphaseComparison*>();
    dock.findChild<QComboBox*>(QStringLiteral("comparisonSubject"))->setCurrentIndex(subject);
    bool finished = false;
    const QMetaObject::Connection told =
        QObject::connect(comparison, &BroadphaseComparison::reported, [&finished] { finished = true; });
    QPushButton* compare = dock.findChild<QPushButton*>(QStringLiteral("compare"));
    compare->click();
    if (!QTest::qWaitFor([&] { return finished; }, most)) compare->click();
    awaitThat([&] { return finished; }, studyTime);
    QObject::disconnect(told);
}

void studyAccuracy(Ide& ide) {
    AccuracyDock& dock = ide.bench.window().accuracy();
    bool finished = false;
    const QMetaObject::Connection told =
        QObject::connect(&dock, &AccuracyDock::reported, [&finished] { finished = true; });
    dock.findChild<QPushButton*>(QStringLiteral("accuracyStart"))->click();
    awaitThat([&] { return finished; }, studyTime);
    QObject::disconnect(told);
}

void addCurves(PlotsDock& plots, std::initializer_list<const char*> quantities) {
    QComboBox* box = plots.findChild<QComboBox*>(QStringLiteral("plotQuantity"));
    for (const char* quantity : quantities) {
        box->setCurrentIndex(box->findText(QLatin1StringView(quantity)));
        plots.findChild<QToolButton*>(QStringLiteral("plotAdd"))->click();
    }
}

bool Photographer::manual() {
    {
        Ide ide(shipped("pool_break"));
        ide.bench.window().resize(manualSize);
        reach(ide, 55);
        save(ide.bench.window(), QStringLiteral("window"));
    }
    {
        Ide ide("sphere ball { radius 0.25  mass 1  centre 0, 2, 0 }\n"
                "wall { normal 0, 1, 0  toOrg 0 }\n");
        ide.bench.window().resize(lookSize);
        awaitThat([&] { return ide.problems() > 0; });
        save(*ide.editor.parentWidget(), QStringLiteral("problem"), {0, 0, 640, 120});
    }
    {
        Ide ide(generated("brownian", 1000));
        ide.bench.window().resize(manualSize);
        ide.trigger(ActionId::WorkspaceMeasure);
        play(ide, 240);
        save(ide.bench.window(), QStringLiteral("measure"));
        ide.bench.window().resize(lookSize);
        ide.bench.window().open(ide.bench.window().broadphase());
        compareAll(ide, 0);
        save(ide.bench.window().broadphase(), QStringLiteral("broadphase"));
    }
    return m_allSaved;
}

void Photographer::saveTwice(Ide& ide, QWidget& widget, const QString& name) {
    for (const bool dark : {true, false}) {
        ide.bench.window().actions()[ActionId::DarkTheme].setChecked(dark);
        save(widget, name + (dark ? QStringLiteral("_dark") : QStringLiteral("_light")));
    }
}

void Photographer::lookAtWorkspaces() {
    Ide ide(shipped("pool_break"));
    MainWindow& window = ide.bench.window();
    window.resize(lookSize);
    saveTwice(ide, window, QStringLiteral("write"));
    placeCaretBehind(ide.editor, "sphere");
    QTest::keyClicks(&ide.editor, QStringLiteral("x"));
    awaitThat([&] { return ide.problems() > 0; });
    saveTwice(ide, window, QStringLiteral("write_error"));
    ide.trigger(ActionId::Undo);
    awaitThat([&] { return ide.problems() == 0; });
    ide.trigger(ActionId::WorkspaceWatch);
    play(ide, 60);
    saveTwice(ide, window, QStringLiteral("watch"));
    ide.trigger(ActionId::WorkspaceMeasure);
    saveTwice(ide, window, QStringLiteral("measure"));
    window.timing().findChild<QToolButton*>(QStringLiteral("timingKeep"))->click();
    ide.trigger(ActionId::Reset);
    play(ide, 90);
    window.timing().findChild<QToolButton*>(QStringLiteral("timingCompare"))->click();
    saveTwice(ide, window, QStringLiteral("measure_two_runs"));
    ide.trigger(ActionId::WorkspaceStudy);
    saveTwice(ide, window, QStringLiteral("study_empty"));
    studyAccuracy(ide);
    saveTwice(ide, window, QStringLiteral("study"));
}

void Photographer::lookAtPanels() {
    Ide ide(generated("pile", 100));
    MainWindow& window = ide.bench.window();
    window.resize(lookSize);
    ide.trigger(ActionId::WorkspaceMeasure);
    ide.viewport.setSelectedBody(5);
    Q_EMIT ide.viewport.bodyClicked(5);
    play(ide, 90);
    window.open(window.inspector());
    window.open(window.plots());
    window.plots().findChild<QComboBox*>(QStringLiteral("plotBody"))->setCurrentIndex(0);
    addCurves(window.plots(), {"energy", "energy by friction", "energy by restitution"});
    QTest::qWait(2 * settleTime);
    saveTwice(ide, window, QStringLiteral("plots"));
    window.open(window.broadphase());
    compareAll(ide, 0);
    saveTwice(ide, window, QStringLiteral("broadphase"));
    compareAll(ide, 1, longEnough);
    saveTwice(ide, window, QStringLiteral("broadphase_against_n"));
    for (const auto& [dock, name] :
         {std::pair<QDockWidget*, const char*>{&window.breakpoints(), "breakpoints"},
          {&window.stability(), "stability"},
          {&window.problems(), "problems"}}) {
        window.open(*dock);
        saveTwice(ide, window, QLatin1StringView(name));
    }
    ide.trigger(ActionId::ShowContacts);
    ide.trigger(ActionId::ShowVelocities);
    saveTwice(ide, window, QStringLiteral("overlays"));
}

void Photographer::lookAtDialogs() {
    constexpr std::array dialogs = {
        std::pair{ActionId::Welcome, "welcome"}, std::pair{ActionId::Preferences, "preferences"},
        std::pair{ActionId::FindCommand, "commands"}, std::pair{ActionId::Tutorial, "manual"}};
    for (const bool dark : {true, false}) {
        Ide ide;
        ide.bench.window().resize(lookSize);
        ide.bench.window().actions()[ActionId::DarkTheme].setChecked(dark);
        for (const auto& [action, name] : dialogs) {
            ide.trigger(action);
            QTest::qWait(settleTime);
            QWidget* front = QApplication::activePopupWidget();
            if (front == nullptr) front = QApplication::activeModalWidget();
            if (front == nullptr) front = QApplication::activeWindow();
            if (front == nullptr) front = &ide.bench.window();
            save(*front,
                 QLatin1StringView(name) + (dark ? QStringLiteral("_dark") : QStringLiteral("_light")));
            if (front != &ide.bench.window()) front->close();
        }
    }
}

bool Photographer::look() {
    lookAtWorkspaces();
    lookAtPanels();
    lookAtDialogs();
    return m_allSaved;
}

int takePictures(const QStringList& words) {
    const bool understood =
        words.size() == 2 && (words[0] == QStringLiteral("manual") || words[0] == QStringLiteral("look"));
    if (!understood || !QDir().mkpath(words[1])) {
        printError("carom-pictures: `manual FOLDER` or `look FOLDER` would be right\n");
        return exitcode::wrongUsage;
    }
    QSettings().clear();
    Photographer photographer(words[1]);
    const bool saved = words[0] == QStringLiteral("manual") ? photographer.manual() : photographer.look();
    if (!saved) printError("carom-pictures: a picture could not be written\n");
    return saved ? exitcode::done : exitcode::fileError;
}

} // namespace
} // namespace carom

int main(int argc, char** argv) {
    const carom::test::IdeApplication application(argc, argv);
    return carom::takePictures(QCoreApplication::arguments().mid(1));
}
