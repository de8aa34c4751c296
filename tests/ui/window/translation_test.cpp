// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/shipped_scenes.h"
#include "tests/support/test_class.h"
#include "tests/support/whole_ide.h"

#include "core/effects/effect.h"
#include "core/integrators/integrator.h"
#include "core/simulation/build.h"
#include "core/solvers/solver.h"
#include "core/study/convergence.h"
#include "core/study/measures.h"
#include "ui/docks/effects_dock.h"
#include "ui/widgets/text_of.h"
#include "ui/window/translation.h"

#include <QAbstractButton>
#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QProcess>
#include <QRegularExpression>
#include <QSettings>
#include <QTextBrowser>

using namespace carom;
using namespace carom::test;

namespace {

/// What a text is filled in with: "%1 %2", and nothing else.
QStringList placesOf(const QString& text) {
    static const QRegularExpression place(QStringLiteral("%(\\d|n)"));
    QStringList places;
    for (QRegularExpressionMatchIterator found = place.globalMatch(text); found.hasNext();)
        places.append(found.next().captured());
    places.sort();
    return places;
}

QString plain(QString xml) {
    return xml.replace(QStringLiteral("&lt;"), QStringLiteral("<"))
        .replace(QStringLiteral("&amp;"), QStringLiteral("&"));
}

/// Every text that the window's widgets and actions show, also in panels that are hidden.
QSet<QString> textsOf(const MainWindow& window) {
    QSet<QString> texts;
    const auto add = [&texts](QString text) {
        text.remove(u'&');
        static const QRegularExpression word(QStringLiteral("[a-z]{3}"));
        if (text.contains(word)) texts.insert(text);
    };
    for (const QAction* action : window.findChildren<QAction*>()) {
        add(action->text());
        add(action->statusTip());
    }
    for (const QWidget* widget : window.findChildren<QWidget*>()) {
        add(widget->toolTip());
        add(widget->accessibleName());
        if (const QLabel* label = qobject_cast<const QLabel*>(widget)) add(label->text());
        if (const QAbstractButton* button = qobject_cast<const QAbstractButton*>(widget)) add(button->text());
        if (const QDockWidget* dock = qobject_cast<const QDockWidget*>(widget)) add(dock->windowTitle());
        if (const QLineEdit* line = qobject_cast<const QLineEdit*>(widget)) add(line->placeholderText());
    }
    return texts;
}

} // namespace

class TranslationTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void init() { QSettings().clear(); }

    void everyTextOfTheSourcesHasAGermanOne() {
        QProcess check;
        check.setProcessChannelMode(QProcess::MergedChannels);
        check.start(QStringLiteral(CAROM_SOURCE_DIR "/packaging/translate"), {QStringLiteral("--check")});
        QVERIFY(check.waitForFinished(longestWait));
        QVERIFY2(check.exitCode() == 0, check.readAll().constData());
    }

    void noTextOfTheWindowStaysEnglish() {
        QSet<QString> english, german;
        {
            const NewIde ide;
            english = textsOf(ide.bench.window());
        }
        installTranslation(*qApp, QStringLiteral("de"));
        {
            const NewIde ide;
            german = textsOf(ide.bench.window());
        }
        QVERIFY(english.size() > 250); // what the test looks at is there
        // Words that are the same in both; what core says is English.
        QSet<QString> same;
        for (const char* word : {"Simulation", "Text"}) same.insert(QString::fromLatin1(word));
        for (const SolverRow& row : solvers()) same.insert(textOf(row.title));
        for (const IntegratorRow& row : integrators()) same.insert(textOf(row.title));
        QStringList left;
        for (const QString& text : english& german)
            if (!same.contains(text)) left.append(text);
        QVERIFY2(left.isEmpty(), qPrintable(left.join(u'\n')));
    }

    void theMenusSpeakGermanOnceItIsChosen() {
        installTranslation(*qApp, QStringLiteral("de"));
        QObject owner;
        QMenuBar bar;
        Actions actions(&owner);
        actions.fill(bar);
        QCOMPARE(actions.menu(MenuId::File).title().remove(u'&'), QStringLiteral("Datei"));
        QCOMPARE(actions[ActionId::Undo].text().remove(u'&'), QString::fromUtf8("Rückgängig"));
        QVERIFY(actions[ActionId::Save].statusTip().contains(QStringLiteral("Datei")));
    }

    void theEffectsAreNamedInGerman() {
        installTranslation(*qApp, QStringLiteral("de"));
        const NewIde ide;
        const QString text = ide.bench.window().effects().findChild<QTextBrowser*>()->toPlainText();
        QVERIFY2(text.contains(QStringLiteral("Schwerkraft")), qPrintable(text));
        QVERIFY2(text.contains(QStringLiteral("nicht vorhanden")), qPrintable(text));
        for (const EffectRow& row : effects()) // "Rotation" and "Restitution" are German, too
            QVERIFY2(row.title == "Rotation" || row.title == "Restitution" ||
                         !text.contains(textOf(row.title)),
                     qPrintable(text));
    }

    // Whatever an effect says of a scene, under every method.
    void theReasonsOfEffectsAreGerman_data() {
        QTest::addColumn<QString>("text");
        for (const QString& path : shippedScenes())
            QTest::newRow(qPrintable(path)) << QString::fromStdString(textOfScene(path));
    }
    void theReasonsOfEffectsAreGerman() {
        QFETCH(QString, text);
        installTranslation(*qApp, QStringLiteral("de"));
        const Scene scene = build(text.toStdString()).pipeline->scene();
        for (const SolverRow& method : solvers()) {
            SimulationSettings options;
            options.method = std::string(method.name);
            const Pipeline pipeline(scene, options);
            for (const EffectDecision& decision : pipeline.effects())
                for (const Reason::Part& part : decision.reason.parts()) {
                    const QString english = QString::fromStdString(part.sentence.text());
                    QVERIFY2(sentence(part.sentence) != english, qPrintable(english));
                    for (const std::string& value : part.sentence.values)
                        QVERIFY2(sentence(part.sentence).contains(QString::fromStdString(value)),
                                 qPrintable(english));
                }
        }
    }

    // The verdict and the axis of the accuracy panel stayed English.
    void whatAnAccuracyStudySaysIsGerman() {
        installTranslation(*qApp, QStringLiteral("de"));
        const Build built = build(twoBalls.toStdString());
        AccuracyStudy study;
        study.plan = planFor(built.pipeline->scene());
        study.settings = built.pipeline->settings();
        study.leftOut = {study.plan.settings.front()};
        for (const AccuracySetting& setting : study.plan.settings) {
            AccuracyPoint& point = study.points.emplace_back(AccuracyPoint{.setting = setting});
            point.status = PointStatus::Measured;
            point.isDefault = study.points.size() == 1;
            point.errors.position = 0.5 / setting.substeps;
            point.times = {1.0 + setting.substeps};
        }
        static const QRegularExpression english(QStringLiteral("\\b(the|of|is|at|than|below|substeps?)\\b"));
        // "128 substeps" of the run that errors are measured against stayed English longest.
        const Build sliding = build("wall { normal 0,1,0 toOrig 0 friction .5 }\n"
                                    "sphere { radius .5 mass 1 centre 0,.5,0 vel 1,0,0 friction .5 }");
        AccuracyPlan brief = planFor(sliding.pipeline->scene());
        brief.settings.resize(1);
        brief.duration = 0.1;
        AccuracyListener silent;
        silent.goOn = [](double) { return true; };
        silent.changed = [](const AccuracyStudy&) {};
        study.reference = runAccuracy(sliding.pipeline->scene(), brief, silent).reference;
        QVERIFY(study.reference && study.reference->kind == ReferenceKind::ConvergedRun);
        for (const MeasureRow& measure : measures()) {
            study.measure = &measure;
            for (const std::string_view words : {measure.noun, measure.axis, measure.help})
                QVERIFY2(sentence(Sentence{words}) != textOf(words), qPrintable(textOf(words)));
            for (const Reason& said : {recommendation(study), yardstickOf(study), omissionsOf(study)}) {
                const QString german = sentences(said);
                QVERIFY(!german.isEmpty());
                QVERIFY2(!german.contains(english), qPrintable(german));
            }
        }
    }

    void noTranslationLosesAPlaceThatIsFilledIn() {
        const QString ts = QString::fromUtf8(
            readFile(QStringLiteral(CAROM_SOURCE_DIR "/resources/translations/carom_de.ts")));
        static const QRegularExpression pair(
            QStringLiteral("<source>([^<]*)</source>\\s*<translation>([^<]*)</translation>"));
        int compared = 0;
        for (QRegularExpressionMatchIterator found = pair.globalMatch(ts); found.hasNext(); ++compared) {
            const QRegularExpressionMatch match = found.next();
            QVERIFY2(placesOf(plain(match.captured(1))) == placesOf(plain(match.captured(2))),
                     qPrintable(match.captured(1)));
        }
        QVERIFY(compared > 300);
    }
};

CAROM_TEST_WITH(IdeApplication, translation_test, TranslationTest)
#include "translation_test.moc"
