// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/run_commands.h"

#include "ui/docks/breakpoints_dock.h"
#include "ui/docks/broadphase_dock.h"
#include "ui/docks/effects_dock.h"
#include "ui/docks/inspector_dock.h"
#include "ui/docks/plots_dock.h"
#include "ui/docks/problems_dock.h"
#include "ui/docks/timing_dock.h"
#include "ui/player/frame_log.h"
#include "ui/player/simulation.h"
#include "ui/viewport/viewport.h"
#include "ui/widgets/body_title.h"
#include "ui/widgets/text_of.h"
#include "ui/widgets/timeline.h"
#include "ui/widgets/transport_bar.h"
#include "ui/base/actions.h"
#include "ui/window/live_preview.h"
#include "ui/window/main_window.h"

#include <QApplication>
#include <QKeyEvent>
#include <QShortcut>

#include <cmath>

namespace carom {

RunCommands::RunCommands(MainWindow& window, Simulation& simulation, FrameLog& log, LivePreview& preview)
    : QObject(&window), m_window(window), m_simulation(simulation), m_log(log), m_preview(preview) {
    connectActions();
    connectFrames();
    connectPanels();
}

void RunCommands::setTheme(const Theme& theme) {
    m_theme = theme;
    showStatus(m_simulation.status());
}

void RunCommands::connectActions() {
    const Actions& actions = m_window.actions();
    connect(&actions[ActionId::Play], &QAction::triggered, &m_simulation, &Simulation::togglePlay);
    connect(&actions[ActionId::Step], &QAction::triggered, this,
            [this] { stepUnlessHeld(&Simulation::step); });
    connect(&actions[ActionId::StepBack], &QAction::triggered, this,
            [this] { stepUnlessHeld(&Simulation::stepBack); });
    qApp->installEventFilter(this);
    connect(&actions[ActionId::Reset], &QAction::triggered, &m_preview, &LivePreview::reset);
    Viewport& viewport = m_window.viewport();
    connect(&actions[ActionId::FrameSelection], &QAction::triggered, &viewport, &Viewport::frameSelection);
    connect(&actions[ActionId::FrameAll], &QAction::triggered, &viewport, &Viewport::frameAll);

    const std::pair<ActionId, Overlay> overlays[] = {
        {ActionId::ShowAxes, Overlay::Axes},
        {ActionId::ShowBoxes, Overlay::Boxes},
        {ActionId::ShowPairs, Overlay::Pairs},
        {ActionId::ShowStructure, Overlay::Structure},
        {ActionId::ShowVelocities, Overlay::Velocities},
        {ActionId::ShowContacts, Overlay::Contacts},
        {ActionId::ShowLabels, Overlay::Labels},
        {ActionId::ShowTrails, Overlay::Trails},
        {ActionId::ShowCentreOfMass, Overlay::CentreOfMass},
    };
    for (const auto& row : overlays) {
        actions[row.first].setCheckable(true);
        connect(&actions[row.first], &QAction::toggled, &viewport,
                [&viewport, overlay = row.second](bool shown) { viewport.setOverlay(overlay, shown); });
    }
    actions[ActionId::StopAtRise].setCheckable(true);
    actions[ActionId::StopAtRise].setChecked(true);
    connect(&actions[ActionId::StopAtRise], &QAction::toggled, &m_simulation,
            &Simulation::stopWhereEnergyRises);
    connect(&actions[ActionId::ShowStructure], &QAction::toggled, &m_simulation, &Simulation::wantStructure);
    actions[ActionId::ShowGhost].setCheckable(true);
    actions[ActionId::ShowGhost].setChecked(true);
    connect(&actions[ActionId::ShowGhost], &QAction::toggled, &m_simulation, &Simulation::wantGhost);

    // Keys that mean something else in the text, so only the viewport has them.
    const std::pair<QKeySequence, ActionId> viewportKeys[] = {
        {Qt::Key_Space, ActionId::Play},    {Qt::Key_Right, ActionId::Step},
        {Qt::Key_Left, ActionId::StepBack}, {Qt::Key_Plus, ActionId::Faster},
        {Qt::Key_Minus, ActionId::Slower},  {Qt::Key_Equal, ActionId::RealTime},
    };
    for (const auto& [key, id] : viewportKeys) {
        QShortcut* shortcut = new QShortcut(key, &viewport, nullptr, nullptr, Qt::WidgetShortcut);
        connect(shortcut, &QShortcut::activated, &actions[id], &QAction::trigger);
    }
    connect(&m_window.transport(), &TransportBar::speedChanged, &m_simulation, &Simulation::setSpeed);
    m_simulation.setSpeed(m_window.transport().speed());
}

/// Each press is a step. A key that is held asks sooner than a large scene can answer: what was not made is
/// not made up for.
void RunCommands::stepUnlessHeld(void (Simulation::*step)()) {
    if (!m_keyHeld || !m_simulation.isStepping()) (m_simulation.*step)();
}

bool RunCommands::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::ShortcutOverride) // comes before the key's action
        m_keyHeld = static_cast<QKeyEvent*>(event)->isAutoRepeat();
    else if (event->type() == QEvent::KeyRelease || event->type() == QEvent::MouseButtonPress)
        m_keyHeld = false;
    return QObject::eventFilter(watched, event);
}

void RunCommands::connectFrames() {
    Viewport& viewport = m_window.viewport();
    Timeline& timeline = m_window.timeline();
    connect(&timeline, &Timeline::seeked, &m_simulation, &Simulation::seek);
    connect(&m_simulation, &Simulation::framesArrived, &timeline, &Timeline::addFrames);
    connect(&m_simulation, &Simulation::restarted, this, [this, &timeline] {
        const RunSettings& settings = m_simulation.pipeline()->settings();
        timeline.restart(settings.step, settings.duration);
    });
    connect(&m_simulation, &Simulation::structureArrived, &viewport, &Viewport::showStructure);
    connect(&m_simulation, &Simulation::ghostArrived, &viewport, &Viewport::showGhost);
    connect(&m_simulation, &Simulation::framesArrived, &m_log, &FrameLog::addFrames);
    connect(&m_simulation, &Simulation::snapshotArrived, this,
            [this, &viewport](const std::shared_ptr<const Snapshot>& snapshot) {
                viewport.showSnapshot(snapshot);
                m_window.transport().showTime(snapshot->frame, snapshot->time);
                m_window.timeline().showFrame(snapshot->frame);
                m_window.timing().showFrame(snapshot->frame);
                m_window.plots().showFrame(snapshot->frame);
                noteSpeed(snapshot->time);
            });
    connect(&timeline, &Timeline::seeked, this, [this] { m_speed.restart(); });
    connect(&viewport, &Viewport::frameRendered, &m_log, &FrameLog::noteRendered);
    for (const auto begins : {&Simulation::restarted, &Simulation::rewound})
        connect(&m_simulation, begins, &m_log, &FrameLog::clear);
    connect(&m_simulation, &Simulation::stateChanged, this, &RunCommands::showStatus);
}

void RunCommands::connectPanels() {
    TimingDock& timing = m_window.timing();
    BroadphaseDock& broadphase = m_window.broadphase();
    EffectsDock& effects = m_window.effects();
    connect(&m_log, &FrameLog::samplesReady, this,
            [&timing, &broadphase, &effects](const std::vector<FrameSample>& samples) {
                timing.addSamples(samples);
                broadphase.addSamples(samples);
                effects.addSamples(samples);
            });
    for (const auto begins : {&Simulation::restarted, &Simulation::rewound}) {
        connect(&m_simulation, begins, &effects, &EffectsDock::clear);
        connect(&m_simulation, begins, &timing, &TimingDock::clear);
        connect(&m_simulation, begins, &broadphase, &BroadphaseDock::clear);
    }
    connect(&m_simulation, &Simulation::restarted, this, &RunCommands::describeRun);
    connect(&timing, &TimingDock::framePicked, &m_simulation, &Simulation::seek);
    connectBreakpoints();
    connectGuard();
    connectStories();
    InspectorDock& inspector = m_window.inspector();
    connect(&m_preview, &LivePreview::shownChanged, &inspector,
            [&inspector](const SharedBuild& shown) { inspector.showPipeline(shown->build.pipeline); });
    connect(&m_simulation, &Simulation::snapshotArrived, &inspector, &InspectorDock::showSnapshot);
    PlotsDock& plots = m_window.plots();
    connect(&m_simulation, &Simulation::restarted, &plots,
            [this, &plots] { plots.showPipeline(m_simulation.pipeline()); });
    connect(&m_simulation, &Simulation::framesArrived, &plots,
            [&plots](const std::vector<FrameStatistics>& frames) { plots.reach(frames.back().frame); });
    connect(&plots, &PlotsDock::framePicked, &m_simulation, &Simulation::seek);
    plots.plotWhole("energy"); // what most scenes are watched for
    connect(&broadphase, &BroadphaseDock::algorithmChosen, this, [this](const BroadphaseRow* row) {
        m_simulation.useBroadphase(row);
        m_broadphase = row;
        describeRun();
        Q_EMIT reported(row != nullptr ? tr("broad-phase: %1").arg(textOf(row->title))
                                       : tr("broad-phase: as the scene asks"));
    });
    connect(&m_preview, &LivePreview::shownChanged, &broadphase,
            [&broadphase](const SharedBuild& shown) { broadphase.showPipeline(shown->build.pipeline); });
    connect(&m_preview, &LivePreview::noticeChanged, &m_window.transport(), &TransportBar::showNotice);
}

/// What tells this run from another one in the panels.
void RunCommands::describeRun() {
    const std::shared_ptr<const Pipeline> pipeline = m_simulation.pipeline();
    if (!pipeline) return;
    const RunSettings& settings = pipeline->settings();
    const BroadphaseRow* broadphase = m_broadphase != nullptr ? m_broadphase : settings.broadphase;
    QString description =
        tr("%1 bodies, %2").arg(pipeline->bodies().count()).arg(textOf(settings.method->name));
    if (broadphase != nullptr) description += QStringLiteral(", ") + textOf(broadphase->title);
    m_window.timing().describeRun(description);
}

void RunCommands::connectBreakpoints() {
    BreakpointsDock& breakpoints = m_window.breakpoints();
    const Actions& actions = m_window.actions();
    connect(&actions[ActionId::Breakpoint], &QAction::triggered, &breakpoints,
            [this, &breakpoints] { m_window.open(breakpoints); });
    connect(&actions[ActionId::FindBack], &QAction::triggered, &m_simulation, &Simulation::findBack);
    connect(&breakpoints, &BreakpointsDock::backWanted, &m_simulation, &Simulation::findBack);
    connect(&breakpoints, &BreakpointsDock::changed, &m_simulation, &Simulation::setBreakpoints);
    connect(&m_simulation, &Simulation::restarted, &breakpoints,
            [this, &breakpoints] { breakpoints.showPipeline(m_simulation.pipeline()); });
    connect(
        &m_simulation, &Simulation::broke, this, [this, &breakpoints](const std::optional<BreakHit>& hit) {
            if (!hit) {
                Q_EMIT reported(tr("No breakpoint held before this frame"));
                return;
            }
            m_window.timeline().markHit(hit->frame);
            const double time = static_cast<double>(hit->frame) * m_simulation.pipeline()->settings().step;
            const QString sentence = tr("Frame %1, %2 s: %3")
                                         .arg(hit->frame)
                                         .arg(time, 0, 'f', 3)
                                         .arg(breakpoints.titleOf(hit->breakpoint));
            m_hit = {hit->frame, sentence};
            m_window.transport().showNotice(sentence);
            Q_EMIT reported(sentence);
        });
}

QString RunCommands::energyWords(double lost) {
    if (lost == 0) return tr("no energy lost");
    const QString figure = QString::number(std::abs(lost), 'g', 3);
    return lost > 0 ? tr("%1 J lost").arg(figure) : tr("%1 J gained").arg(figure);
}

/// "Why did this happen?": of a mark that was clicked, the frame on screen, or a breakpoint that held.
void RunCommands::connectStories() {
    const auto explain = [this](std::int64_t frame) { m_simulation.explain(frame); };
    connect(&m_window.actions()[ActionId::Explain], &QAction::triggered, this,
            [this] { m_simulation.explain(m_window.timeline().frame()); });
    connect(&m_window.timeline(), &Timeline::eventClicked, this, explain);
    connect(&m_simulation, &Simulation::broke, this, [explain](const std::optional<BreakHit>& hit) {
        if (hit) explain(hit->frame);
    });
    connect(&m_simulation, &Simulation::explained, this, [this](const EventStory& story) {
        const Scene& scene = m_simulation.pipeline()->scene();
        if (story.a == noBody) {
            m_window.transport().showNotice(tr("Frame %1: nothing met in it").arg(story.frame));
            return;
        }
        const QString figures = tr("impulse %1 N s, %2")
                                    .arg(QString::number(story.impulse, 'g', 4))
                                    .arg(energyWords(story.energyLost));
        const QString a = bodyTitle(scene, story.a);
        const QString sentence =
            story.b == noBody
                ? tr("Frame %1: %2 changed its motion most, %3").arg(QString::number(story.frame), a, figures)
                : tr("Frame %1: %2 met %3, %4")
                      .arg(QString::number(story.frame), a, bodyTitle(scene, story.b), figures);
        Viewport& viewport = m_window.viewport();
        Q_EMIT viewport.bodyClicked(story.a);
        viewport.showPair(story.a, story.b, story.at);
        const bool ofBreakpoint = m_hit && m_hit->first == story.frame;
        m_window.transport().showNotice(ofBreakpoint ? m_hit->second + QStringLiteral(". ") + sentence
                                                     : sentence);
        Q_EMIT reported(sentence);
    });
}

/// A run whose energy rises from nowhere is not to be believed from there on.
void RunCommands::connectGuard() {
    ProblemsDock& problems = m_window.problems();
    for (const auto begins : {&Simulation::restarted, &Simulation::rewound})
        connect(&m_simulation, begins, &problems, [&problems] { problems.showRun(std::nullopt); });
    connect(&problems, &ProblemsDock::frameActivated, &m_simulation, &Simulation::seek);
    connect(&m_simulation, &Simulation::energyRose, this, [this, &problems](const EnergyRise& rise) {
        const QString sentence = tr("The run %1; shorter steps or more substeps may hold it")
                                     .arg(QString::fromStdString(describe(rise)));
        problems.showRun(RunProblem{rise.frame, sentence});
        m_window.timeline().markWarning(rise.frame);
        m_window.transport().showNotice(sentence);
        Q_EMIT reported(sentence);
    });
}

void RunCommands::showStatus(const RunStatus& status) {
    const bool running = status.state == RunState::Running || status.seeking;
    m_speed.restart();
    m_window.transport().showReached(std::nullopt);
    const bool stopped = status.state == RunState::Stopped;
    QAction& play = m_window.actions()[ActionId::Play];
    play.setText(running ? tr("&Pause") : tr("&Play"));
    play.setIcon(m_theme.icon(running ? QStringLiteral("pause") : QStringLiteral("play")));
    play.setEnabled(!stopped);
    m_window.actions()[ActionId::Step].setEnabled(!stopped);
    m_window.transport().showStatus(status);
    if (!stopped) return;
    m_window.timeline().markWarning(status.health.frame);
    const QString sentence = whyItStopped(status);
    m_window.transport().showNotice(sentence);
    Q_EMIT reported(sentence);
}

void RunCommands::noteSpeed(double time) {
    if (!m_simulation.isRunning()) return;
    if (const std::optional<double> speed = m_speed.note(time, SpeedMeter::Clock::now()))
        m_window.transport().showReached(speed);
}

QString RunCommands::whyItStopped(const RunStatus& status) const {
    const QString frame = QString::number(status.health.frame);
    if (status.cause == StopCause::Memory)
        return tr("Stopped at frame %1: there is not enough memory for it").arg(frame);
    if (status.cause == StopCause::Error)
        return tr("Stopped at frame %1 by an error inside the program").arg(frame);
    return tr("Stopped at frame %1: the %2 of %3 is not finite, or too large to follow")
        .arg(frame, textOf(status.health.quantity),
             QString::fromStdString(m_simulation.pipeline()->scene().nameOf(status.health.body)));
}

} // namespace carom

#include "moc_run_commands.cpp"
