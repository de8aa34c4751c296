// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/player/simulation.h"

#include <QMetaObject>

#include <cmath>
#include <utility>

namespace carom {

namespace {
constexpr int collectInterval = 16; // [ms] between two checks for snapshots: sixty a second; at twice thirty
}

Simulation::Simulation(QObject* parent)
    : QObject(parent), m_thread({[this](RunStatus status) {
                                     QMetaObject::invokeMethod(
                                         this, [this, status] { takeStatus(status); }, Qt::QueuedConnection);
                                 },
                                 [this](std::optional<BreakHit> hit) {
                                     QMetaObject::invokeMethod(
                                         this, [this, hit] { Q_EMIT broke(hit); }, Qt::QueuedConnection);
                                 },
                                 [this] {
                                     QMetaObject::invokeMethod(
                                         this,
                                         [this] {
                                             if (m_timer.isActive()) return;
                                             m_timer.start();
                                             collect();
                                         },
                                         Qt::QueuedConnection);
                                 },
                                 [this](std::uint64_t run, EnergyRise rise) {
                                     QMetaObject::invokeMethod(
                                         this,
                                         [this, run, rise] {
                                             if (run == m_run) Q_EMIT energyRose(rise);
                                         },
                                         Qt::QueuedConnection);
                                 },
                                 [this](std::uint64_t run, EventStory story) {
                                     QMetaObject::invokeMethod(
                                         this,
                                         [this, run, story] {
                                             if (run == m_run) Q_EMIT explained(story);
                                         },
                                         Qt::QueuedConnection);
                                 }}) {
    m_timer.setInterval(collectInterval);
    m_timer.setTimerType(Qt::PreciseTimer);
    connect(&m_timer, &QTimer::timeout, this, &Simulation::collect);
}

void Simulation::load(std::shared_ptr<const Pipeline> pipeline) {
    m_pipeline = std::move(pipeline);
    m_atStart = true;
    m_underWay = false;
    m_time = 0;
    m_thread.post(LoadCommand{m_pipeline, ++m_run, 0});
    rest();
    Q_EMIT restarted();
}

/// A run that begins anew waits; what is still said of the one before is dropped.
void Simulation::rest() {
    const RunStatus before = std::exchange(m_status, {.health = {}, .run = m_run});
    if (before.state != RunState::Paused || before.seeking) Q_EMIT stateChanged(m_status);
}

void Simulation::exchange(std::shared_ptr<const Pipeline> pipeline) {
    m_pipeline = std::move(pipeline);
    m_underWay = true;
    const std::int64_t frame = std::llround(m_time / m_pipeline->settings().step);
    m_thread.post(LoadCommand{m_pipeline, ++m_run, frame});
    Q_EMIT restarted();
}

void Simulation::play() {
    if (!m_pipeline) return;
    m_atStart = false;
    m_thread.post(RunCommand{});
}

void Simulation::pause() { m_thread.post(PauseCommand{}); }

void Simulation::togglePlay() {
    if (isRunning() || isSeeking())
        pause();
    else
        play();
}

void Simulation::step() {
    if (!m_pipeline) return;
    m_atStart = false;
    m_thread.post(StepCommand{1});
}

void Simulation::stepBack() {
    if (m_pipeline) m_thread.post(StepCommand{-1});
}

void Simulation::seek(std::int64_t frame) {
    if (!m_pipeline) return;
    m_atStart = m_atStart && frame == 0;
    m_time = static_cast<double>(frame) * m_pipeline->settings().step;
    m_thread.post(SeekCommand{frame});
}

void Simulation::explain(std::int64_t frame) {
    if (!m_pipeline || frame < 1) return;
    m_atStart = false;
    m_thread.post(ExplainCommand{frame});
}

void Simulation::reset() {
    if (!m_pipeline) return;
    m_atStart = true;
    m_underWay = false;
    m_time = 0;
    m_thread.post(ResetCommand{++m_run});
    rest();
    Q_EMIT rewound();
}

void Simulation::setSpeed(std::optional<double> speed) { m_thread.post(SpeedCommand{speed}); }

void Simulation::setBreakpoints(std::vector<Breakpoint> breakpoints) {
    m_thread.post(BreakpointsCommand{std::move(breakpoints)});
}

void Simulation::setMemoryBudget(std::size_t bytes) { m_thread.post(BudgetCommand{bytes}); }

void Simulation::useBroadphase(const BroadphaseRow* row) { m_thread.post(BroadphaseCommand{row}); }

void Simulation::wantStructure(bool wanted) {
    m_structureWanted = wanted;
    m_thread.post(StructureCommand{wanted});
}

/// Takes what has come; the timer rests once nothing does, until the thread reports again.
void Simulation::collect() {
    const SampleQueue::Batch batch = m_thread.samples().takeAll();
    const std::optional<PublishedSnapshot> published = m_thread.snapshots().take();
    if (batch.frames.empty() && !published) m_timer.stop();
    if (batch.run == m_run && !batch.frames.empty()) Q_EMIT framesArrived(batch.frames);
    if (published && published->run == m_run) show(*published);
}

/// Of a scene loaded over, or overtaken by what came with a snapshot: dropped.
void Simulation::takeStatus(const RunStatus& status) {
    if (status.run != m_run || status.number <= m_statusNumber) return;
    m_statusNumber = status.number;
    m_status = status;
    Q_EMIT stateChanged(status);
}

void Simulation::show(const PublishedSnapshot& published) {
    takeStatus(published.status); // a key pressed on seeing this picture means the state it shows
    const Snapshot& snapshot = *published.snapshot;
    m_time = snapshot.time;
    m_recorded = published.recorded;
    if (snapshot.frame > 0)
        m_atStart = false;
    else if (!isRunning())
        m_atStart = true;
    if (std::exchange(m_underWay, false)) Q_EMIT landed();
    const bool haunted = published.ghost.snapshot != nullptr;
    if (haunted || m_haunted) Q_EMIT ghostArrived(published.ghost);
    m_haunted = haunted;
    if (m_structureWanted) Q_EMIT structureArrived(published.structure);
    Q_EMIT snapshotArrived(published.snapshot);
    if (published.judged && published.judged != m_judged) Q_EMIT judged(published.judged);
    m_judged = published.judged;
}

} // namespace carom

#include "moc_simulation.cpp"
