// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/docks/accuracy_dock.h"

#include "core/base/clock.h"
#include "core/integrators/integrator.h"
#include "core/study/accuracy_csv.h"
#include "core/study/measures.h"
#include "ui/docks/engine_programs.h"
#include "ui/widgets/empty_state.h"
#include "ui/base/export_menu.h"
#include "ui/widgets/panel_parts.h"
#include "ui/base/file_output.h"
#include "ui/widgets/text_of.h"

#include <QApplication>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollArea>
#include <QSpinBox>
#include <QSysInfo>
#include <QToolButton>
#include <QVBoxLayout>

#include <cmath>

namespace carom {
namespace {

/// [ms] between two reports of progress, and between two diagrams of a study that is running. At a tenth,
/// reports and drawing take time from the study; at ten times it seems to have stopped.
constexpr double reportInterval = 100;
constexpr double chartInterval = 700;
constexpr int progressSteps = 1000;
constexpr int heightForLegend = 260; ///< [px] of the diagram
constexpr int pointWidth = 300;      ///< [px] of what is said about a point

/// A checkable action for every row of a catalogue.
template<class Rows>
std::vector<QAction*> choices(QMenu& menu, const Rows& rows) {
    std::vector<QAction*> actions;
    for (const auto& row : rows) {
        QAction* action = menu.addAction(textOf(row.title));
        action->setToolTip(textOf(row.help));
        action->setData(textOf(row.name));
        action->setCheckable(true);
        action->setChecked(true);
        actions.push_back(action);
    }
    return actions;
}

/// A point without a time, or without an error, is nowhere in the diagram yet.
bool hasFigures(const std::optional<AccuracyStudy>& study) {
    return study && std::any_of(study->points.begin(), study->points.end(), [](const AccuracyPoint& point) {
               return !point.times.empty() && point.status != PointStatus::Timed;
           });
}

bool sameText(const SharedBuild& a, const SharedBuild& b) {
    return a && b && (a == b || a->build.analysis.text == b->build.analysis.text);
}

bool isChosen(const std::vector<QAction*>& actions, std::string_view name) {
    for (const QAction* action : actions)
        if (action->data().toString() == textOf(name)) return action->isChecked();
    return true;
}

} // namespace

AccuracyDock::AccuracyDock(QWidget* parent)
    : Panel(tr("Accuracy"), parent), m_start(new QPushButton),
      m_knobs(wordButton("accuracyKnobs", tr("Vary"), tr("Which methods and integrators are compared"))),
      m_duration(new QDoubleSpinBox), m_budget(new QSpinBox), m_measure(new QComboBox),
      m_progress(new QProgressBar), m_state(new QLabel), m_verdict(new QLabel),
      m_keep(wordButton("accuracyKeep", tr("Keep"), tr("Show this study together with the next one"))),
      m_export(makeExportMenu(QStringLiteral("accuracy"))), m_plot(new PlotWidget), m_point(new QLabel),
      m_run(new QPushButton(tr("Run it"))), m_use(new QPushButton(tr("Use this setting"))) {
    setObjectName(QStringLiteral("accuracy"));
    m_start->setObjectName(QStringLiteral("accuracyStart"));
    m_knobs->setPopupMode(QToolButton::InstantPopup);
    m_knobs->setMenu(knobsMenu());
    m_duration->setObjectName(QStringLiteral("accuracyDuration"));
    m_duration->setAccessibleName(tr("Simulated time"));
    m_duration->setToolTip(tr("How long the scene is simulated in each run"));
    m_duration->setRange(0.05, 100);
    m_duration->setSuffix(tr(" s"));
    m_duration->setValue(AccuracyPlan{}.duration);
    connect(m_duration, &QDoubleSpinBox::valueChanged, this, &AccuracyDock::updateControls);
    m_budget->setObjectName(QStringLiteral("accuracyBudget"));
    m_budget->setAccessibleName(tr("Time for the study"));
    m_budget->setToolTip(tr("How long the study may take; what does not fit is left out"));
    m_budget->setRange(1, 3600);
    m_budget->setSuffix(tr(" s"));
    m_budget->setValue(static_cast<int>(AccuracyPlan{}.budget));
    m_measure->setObjectName(QStringLiteral("accuracyMeasure"));
    m_measure->setAccessibleName(tr("Measure"));
    m_measure->setToolTip(tr("What the diagram has across"));
    m_measure->addItem(tr("automatic"), QString());
    for (const MeasureRow& row : measures()) {
        m_measure->addItem(textOf(row.name), textOf(row.name));
        m_measure->setItemData(m_measure->count() - 1, sentence(Sentence{row.help}), Qt::ToolTipRole);
    }
    connect(m_measure, &QComboBox::currentIndexChanged, this, [this] {
        if (m_result) take(AccuracyStudy(*m_result));
    });
    m_progress->setObjectName(QStringLiteral("accuracyProgress"));
    m_progress->setRange(0, progressSteps);
    m_progress->setTextVisible(false);
    m_progress->setMaximumSize(120, 12);
    m_state->setObjectName(QStringLiteral("accuracyState"));
    m_state->setTextFormat(Qt::PlainText); // names of files, too
    m_state->setProperty("role", QStringLiteral("muted"));
    m_state->setWordWrap(true);
    m_keep->setCheckable(true);

    QHBoxLayout* top = new QHBoxLayout;
    QLabel* simulated = new QLabel(tr("over"));
    QLabel* within = new QLabel(tr("within"));
    for (QLabel* word : {simulated, within}) word->setProperty("role", QStringLiteral("muted"));
    for (QWidget* widget : std::initializer_list<QWidget*>{m_start, m_knobs, simulated, m_duration, within,
                                                           m_budget, m_measure, m_progress})
        top->addWidget(widget);
    top->addWidget(m_state, 1);
    top->addWidget(m_keep);
    top->addWidget(m_export);

    m_verdict->setObjectName(QStringLiteral("accuracyVerdict"));
    m_verdict->setProperty("role", QStringLiteral("verdict"));
    m_verdict->setWordWrap(true);
    m_verdict->setTextInteractionFlags(Qt::TextSelectableByMouse);
    m_point->setObjectName(QStringLiteral("accuracyPoint"));
    m_point->setWordWrap(true);
    m_point->setAlignment(Qt::AlignTop | Qt::AlignLeft);
    m_run->setObjectName(QStringLiteral("accuracyRun"));
    m_run->setToolTip(tr("Run the scene with this setting, from its start"));
    m_use->setObjectName(QStringLiteral("accuracyUse"));
    m_use->setToolTip(tr("Write this setting into the scene's `simulation` declaration"));
    QWidget* figures = new QWidget;
    QVBoxLayout* side = new QVBoxLayout;
    QScrollArea* words = new QScrollArea; // of a study that leaves much out they are many
    words->setAccessibleName(tr("About the study"));
    words->setWidgetResizable(true);
    words->setFrameShape(QFrame::NoFrame);
    words->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    words->setWidget(m_point);
    words->setFixedWidth(pointWidth);
    side->addWidget(words, 1);
    QHBoxLayout* buttons = new QHBoxLayout;
    buttons->addWidget(m_run);
    buttons->addWidget(m_use);
    side->addLayout(buttons);
    QVBoxLayout* underVerdict = new QVBoxLayout(figures);
    underVerdict->setContentsMargins(0, 0, 0, 0);
    underVerdict->addWidget(m_verdict);
    QHBoxLayout* sideBySide = new QHBoxLayout;
    underVerdict->addLayout(sideBySide, 1);
    sideBySide->addWidget(m_plot, 1);
    sideBySide->addLayout(side);
    m_empty = new EmptyState(figures, tr("A study runs the scene with every method, integrator and number of "
                                         "substeps and shows what each error costs in time.\nChoose Study "
                                         "to begin; the simulation above goes on meanwhile."));

    QWidget* content = new QWidget;
    QVBoxLayout* column = new QVBoxLayout(content);
    column->setContentsMargins(6, 4, 6, 6);
    column->addLayout(top);
    column->addWidget(m_empty, 1);
    setWidget(content);
    setFocusProxy(m_start);
    connect(m_start, &QPushButton::clicked, this, &AccuracyDock::startOrStop);
    connect(&m_runner, &StudyRunner::failed, this, [this](const QString& sentence) {
        updateControls();
        m_state->setText(sentence);
        Q_EMIT reported(sentence);
    });
    connect(m_plot, &PlotWidget::pointClicked, this, &AccuracyDock::choose);
    connect(m_keep, &QToolButton::toggled, this, [this](bool kept) {
        m_kept = kept ? m_result : std::nullopt;
        m_keptName = m_studiedName;
        m_keptBuild = m_studied;
        showChart();
    });
    connect(m_run, &QPushButton::clicked, this, [this] {
        const auto pipeline =
            std::make_shared<const Pipeline>(m_studied->scene(), m_chosen->setting.options());
        Q_EMIT runWanted(pipeline);
        Q_EMIT reported(tr("running with %1").arg(sentences(saidOf(m_chosen->setting))));
    });
    connect(m_use, &QPushButton::clicked, this, [this] {
        SimulationSettings settings = m_chosen->setting.options();
        Q_EMIT settingWanted(settings);
        Q_EMIT reported(tr("%1 is now the scene's own setting").arg(sentences(saidOf(m_chosen->setting))));
    });
    updateControls();
}

QMenu* AccuracyDock::knobsMenu() {
    QMenu* menu = new QMenu(m_knobs);
    menu->setToolTipsVisible(true);
    menu->addSection(tr("Methods"));
    m_methods = choices(*menu, solvers());
    menu->addSection(tr("Integrators"));
    m_integrators = choices(*menu, integrators());
    // Looking for them goes through all folders of programs: a sixteenth of the time that the window takes to
    // be made, for a menu that few open.
    connect(
        menu, &QMenu::aboutToShow, this, [this, menu] { offerEngines(*menu); }, Qt::SingleShotConnection);
    return menu;
}

void AccuracyDock::offerEngines(QMenu& menu) {
    const QStringList engines = installedEngines();
    if (!engines.isEmpty()) menu.addSection(tr("Other engines"));
    for (const QString& engine : engines) {
        QAction* action = menu.addAction(engine);
        action->setToolTip(tr("Run the scene in this engine, too, with its own rules and tuned to ours"));
        action->setData(engine);
        action->setCheckable(true);
        m_engines.push_back(action);
    }
}

void AccuracyDock::setScene(const SharedBuild& build, const QString& name) {
    m_build = build;
    m_name = name;
    updateControls();
}

void AccuracyDock::updateControls() {
    const bool moves = m_build && !m_build->build.pipeline->bodies().mobileBodies.empty();
    m_start->setText(m_runner.isRunning() ? tr("Stop") : canGoOn() ? tr("Go on") : tr("Study"));
    m_start->setEnabled(m_runner.isRunning() || moves);
    m_start->setToolTip(m_runner.isRunning() ? tr("Show what was computed so far")
                        : canGoOn()          ? tr("Take the study up where it was stopped")
                        : moves              ? tr("Run the scene with every setting chosen")
                                             : tr("Nothing in the scene can move"));
    m_knobs->setEnabled(!m_runner.isRunning());
    m_duration->setEnabled(!m_runner.isRunning());
    m_budget->setEnabled(!m_runner.isRunning());
    m_progress->setVisible(m_runner.isRunning());
    const bool figures = hasFigures(m_result);
    m_empty->setEmpty(!figures);
    m_keep->setVisible(figures);
    m_export->setVisible(figures);
    const bool isOurs = m_chosen && m_chosen->setting.engine.empty();
    m_run->setEnabled(isOurs);
    m_use->setEnabled(isOurs && m_build == m_studied);
}

AccuracyPlan AccuracyDock::chosenPlan() const {
    AccuracyPlan plan = planFor(m_build->scene());
    std::erase_if(plan.settings, [&](const AccuracySetting& setting) {
        return !isChosen(m_methods, setting.method->name) ||
               (setting.integrator != nullptr && !isChosen(m_integrators, setting.integrator->name));
    });
    plan.duration = m_duration->value();
    plan.budget = m_budget->value();
    std::vector<std::string> engines;
    for (const QAction* action : m_engines)
        if (action->isChecked()) engines.push_back(action->data().toString().toStdString());
    addEngines(plan, engines);
    plan.runEngine = [text = QByteArray::fromStdString(std::string(m_build->build.analysis.text))](
                         const EngineRequest& request) { return runEngineOn(text, request); };
    return plan;
}

void AccuracyDock::chooseMeasureOf(AccuracyStudy& study) const {
    study.plan.measure = findMeasure(m_measure->currentData().toString().toStdString());
    study.measure = study.plan.measure != nullptr ? study.plan.measure : &chooseMeasure(study);
}

bool AccuracyDock::canGoOn() const {
    return m_result && !m_result->complete && !m_runner.isRunning() && sameText(m_build, m_studied) &&
           m_result->plan.duration == m_duration->value();
}

void AccuracyDock::startOrStop() {
    if (m_runner.isRunning()) {
        m_runner.stop();
        return;
    }
    const KnownPoints known = canGoOn() ? KnownPoints{m_result->points, m_result->duration} : KnownPoints();
    m_studied = m_build;
    m_studiedName = m_name;
    m_chosen.reset();
    m_progress->setValue(0);
    m_state->setText(tr("computing the reference solution"));
    m_runner.start([this, known, build = m_build, plan = chosenPlan()](const std::stop_token& stop) {
        return run(stop, build, plan, known);
    });
    updateControls();
}

// On the thread: whatever touches a widget is handed to the GUI's.
StudyRunner::Finish AccuracyDock::run(const std::stop_token& stop, const SharedBuild& build,
                                      const AccuracyPlan& plan, const KnownPoints& known) {
    const Stopwatch whole;
    Stopwatch sinceReport, sinceChart;
    AccuracyListener listener;
    listener.goOn = [&](double seconds) {
        if (sinceReport.elapsed() > reportInterval) {
            sinceReport.lap();
            QMetaObject::invokeMethod(
                this, [this, seconds, budget = plan.budget] { showProgress(seconds, budget); },
                Qt::QueuedConnection);
        }
        return !stop.stop_requested();
    };
    listener.changed = [&](const AccuracyStudy& study) {
        if (!study.reference || sinceChart.elapsed() < chartInterval) return;
        sinceChart.lap();
        QMetaObject::invokeMethod(
            this, [this, study] { take(study); }, Qt::QueuedConnection);
    };
    const AccuracyStudy study = runAccuracy(build->scene(), plan, listener, known);
    const double seconds = 1e-3 * whole.elapsed();
    return [this, study, seconds] { finish(study, seconds); };
}

void AccuracyDock::showProgress(double seconds, double budget) {
    m_progress->setValue(static_cast<int>(progressSteps * seconds / budget));
    m_state->setText(tr("%1 s of at most %2 s").arg(seconds, 0, 'f', 0).arg(budget, 0, 'f', 0));
}

void AccuracyDock::take(const AccuracyStudy& study) {
    m_result = study;
    chooseMeasureOf(*m_result);
    m_verdict->setText(sentences(recommendation(*m_result)));
    updateControls();
    showChart();
}

void AccuracyDock::finish(const AccuracyStudy& study, double seconds) {
    take(study);
    m_state->setText(study.complete ? tr("studied in %1 s").arg(seconds, 0, 'f', 1)
                                    : tr("stopped after %1 s").arg(seconds, 0, 'f', 1));
    QString words = sentences(yardstickOf(*m_result));
    for (const Reason& more : {omissionsOf(*m_result), enginesIn(*m_result)})
        if (!more.empty()) words += QStringLiteral("\n\n") + sentences(more);
    m_point->setText(words + tr("\n\nClick a point to choose it."));
    Q_EMIT reported(tr("accuracy of %1 studied in %2 s: %3")
                        .arg(m_studiedName, QString::number(seconds, 'f', 1), m_verdict->text()));
}

void AccuracyDock::showChart() {
    if (!m_result) return;
    const bool compares = m_kept && !sameText(m_keptBuild, m_studied);
    const QString keptName = m_keptName == m_studiedName ? tr("kept") : m_keptName;
    m_chart = compares ? comparedAccuracy(*m_kept, keptName, *m_result, m_studiedName)
                       : accuracyChart(*m_result, m_studiedName);
    ChartSpec shown = m_chart.spec;
    shown.title.clear();
    shown.note.clear(); // it stands above
    if (m_chosen) markChosen(*m_result, *m_chosen, shown);
    shown.leastForBelow = heightForLegend; // where there is none, the mouse over a point tells
    m_plot->setChart(shown);
}

void AccuracyDock::choose(int series, int point) {
    const auto s = static_cast<std::size_t>(series), p = static_cast<std::size_t>(point);
    if (s >= m_chart.points.size() || p >= m_chart.points[s].size()) return;
    m_chosen = m_result->points[m_chart.points[s][p]];
    m_point->setText(describe(*m_result, *m_chosen));
    updateControls();
    showChart();
}

QString AccuracyDock::exportTo(const QString& path) const {
    if (!hasFigures(m_result)) return tr("nothing was studied yet; choose Study first");
    if (!isCsv(path)) return writeChart(m_chart.spec, path);
    const StudyOrigin origin{
        "carom", QApplication::applicationVersion().toStdString(),
        (QSysInfo::prettyProductName() + QStringLiteral(", ") + QSysInfo::currentCpuArchitecture())
            .toStdString()};
    return saveFile(path, QByteArray::fromStdString(
                              pointsAsCsv(*m_result, hashOfScene(m_studied->build.analysis.text), origin)));
}

} // namespace carom

#include "moc_accuracy_dock.cpp"
