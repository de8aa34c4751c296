// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/simulation/simulation_thread.h"

#include <algorithm>
#include <utility>

namespace carom {
namespace {

using namespace std::chrono_literals;

/// At most sixty snapshots a second. A frame that is a little early on that grid counts as in time: the
/// frames of a scene in real time lie on the same grid and would otherwise be dropped by the jitter of waking
/// up.
constexpr std::chrono::nanoseconds publishInterval = 16'666'667ns;
constexpr std::chrono::nanoseconds publishSlack = 4ms;

/// A simulation that falls further behind the clock than this gives the lost time up instead of racing on
/// for as long once the load is gone.
constexpr std::chrono::nanoseconds longestDebt = 100ms;

} // namespace

SimulationThread::SimulationThread(Listener listener)
    : m_listener(std::move(listener)), m_thread([this](const std::stop_token& stop) { run(stop); }) {}

SimulationThread::~SimulationThread() {
    m_thread.request_stop();
    m_thread.join();
}

void SimulationThread::post(SimulationCommand command) {
    {
        const std::lock_guard lock(m_mutex);
        m_queue.push_back(std::move(command));
    }
    m_wake.notify_one();
}

void SimulationThread::run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
        for (const SimulationCommand& command : nextCommands(stop))
            std::visit([this](const auto& c) { execute(c); }, command);
        const bool due = !m_speed || Clock::now() >= m_due;
        if (m_state == RunState::Running && due && !stop.stop_requested()) advance();
    }
}

/// Waits for a command, or for the next frame's time while running.
std::deque<SimulationCommand> SimulationThread::nextCommands(const std::stop_token& stop) {
    std::unique_lock lock(m_mutex);
    const auto somethingQueued = [this] { return !m_queue.empty(); };
    if (m_state != RunState::Running)
        m_wake.wait(lock, stop, somethingQueued);
    else if (m_speed)
        m_wake.wait_until(lock, stop, m_due, somethingQueued);
    return std::exchange(m_queue, {});
}

void SimulationThread::execute(const LoadCommand& command) {
    m_world = std::make_unique<World>(command.pipeline);
    m_run = command.run;
    applyBroadphase();
    enter(RunState::Paused);
    publish(true);
}

void SimulationThread::execute(const RunCommand&) {
    if (!m_world || m_state != RunState::Paused) return;
    m_due = Clock::now();
    enter(RunState::Running);
}

void SimulationThread::execute(const PauseCommand&) {
    if (m_state != RunState::Running) return;
    enter(RunState::Paused);
    publish(true);
}

void SimulationThread::execute(const StepCommand&) {
    if (!m_world || m_state == RunState::Stopped) return;
    enter(RunState::Paused);
    advance();
    publish(true);
}

void SimulationThread::execute(const ResetCommand& command) {
    if (!m_world) return;
    m_run = command.run;
    m_world->reset();
    enter(RunState::Paused);
    publish(true);
}

void SimulationThread::execute(const SpeedCommand& command) {
    m_speed = command.speed;
    m_due = Clock::now();
}

void SimulationThread::execute(const BroadphaseCommand& command) {
    m_broadphase = command.row;
    applyBroadphase();
    if (m_world && m_structureWanted) publish(true);
}

void SimulationThread::execute(const StructureCommand& command) {
    m_structureWanted = command.wanted;
    if (m_world && m_structureWanted) publish(true);
}

void SimulationThread::applyBroadphase() {
    if (!m_world) return;
    const BroadphaseRow* wanted =
        m_broadphase != nullptr ? m_broadphase : m_world->pipeline().settings().broadphase;
    if (wanted != nullptr && wanted != &m_world->broadphaseRow()) m_world->useBroadphase(*wanted);
}

void SimulationThread::advance() {
    const RunSettings& settings = m_world->pipeline().settings();
    m_world->step();
    if (!m_world->health().finite) {
        enter(RunState::Stopped);
        publish(true);
        return;
    }
    m_samples.push(m_run, m_world->statistics());
    const double time = m_world->state().time;
    const bool reachedEnd =
        settings.duration && time >= *settings.duration && time - settings.step < *settings.duration;
    if (reachedEnd && m_state == RunState::Running) enter(RunState::Paused);
    publish(m_state != RunState::Running);
    schedule();
}

void SimulationThread::schedule() {
    if (!m_speed) return;
    const std::chrono::duration<double> frame(m_world->pipeline().settings().step / *m_speed);
    m_due = std::max(m_due + std::chrono::duration_cast<Clock::duration>(frame), Clock::now() - longestDebt);
}

void SimulationThread::publish(bool always) {
    const Clock::time_point now = Clock::now();
    if (!always && now + publishSlack < m_nextPublish) return;
    m_nextPublish = std::max(m_nextPublish + publishInterval, now);
    m_snapshots.publish({m_run, std::make_shared<const Snapshot>(m_world->snapshot()),
                         m_structureWanted ? m_world->broadphaseStructure() : std::vector<Aabb>()});
    m_listener.published();
}

void SimulationThread::enter(RunState state) {
    if (state == m_state) return;
    m_state = state;
    m_listener.stateChanged({state, m_world ? m_world->health() : Health{}});
}

} // namespace carom
