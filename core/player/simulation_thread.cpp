// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/player/simulation_thread.h"

#include "core/base/memory_limit.h"
#include "core/simulation/world.h"

#include <pthread.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <stdexcept>
#include <utility>

namespace carom {
namespace {

using namespace std::chrono_literals;

/// At most sixty snapshots a second. A frame that is a little early on that grid counts as in time: the
/// frames of a scene in real time lie on the same grid and would otherwise be dropped by the jitter of waking
/// up.
constexpr std::chrono::nanoseconds publishInterval = 16'666'667ns;
constexpr std::chrono::nanoseconds publishSlack = 4ms;

/// A simulation that is further behind the clock than this drops the lost time instead of running too fast
/// later. At a tenth, short delays slow the run down; at ten times, it runs too fast for a second after a
/// delay.
constexpr std::chrono::nanoseconds longestDebt = 100ms;

/// A seek that takes longer is shown as one, so that it can be cancelled. At a tenth short seeks flicker; at
/// ten times long ones seem to hang.
constexpr std::chrono::nanoseconds longSeek = 150ms;

/// Between two checks whether samples have been taken; at ten times, the run waits longer than it must.
constexpr std::chrono::nanoseconds roomInterval = 1ms;

} // namespace

SimulationThread::SimulationThread(Listener listener)
    : m_listener(std::move(listener)), m_thread([this](const std::stop_token& stop) { run(stop); }) {}

SimulationThread::~SimulationThread() {
    m_thread.request_stop();
    m_thread.join();
}

void SimulationThread::post(SimulationCommand command) {
    if (std::holds_alternative<StepCommand>(command)) ++m_stepsWaiting;
    {
        const std::lock_guard lock(m_mutex);
        m_queue.push_back(std::move(command));
    }
    m_wake.notify_one();
}

void SimulationThread::run(const std::stop_token& stop) {
    pthread_setname_np(pthread_self(), "simulation"); // for debuggers, profilers and /proc
    while (!stop.stop_requested()) {
        try {
            act(stop);
        } catch (const std::bad_alloc&) {
            giveUp(StopCause::Memory);
        } catch (const std::length_error&) { // an array longer than any memory
            giveUp(StopCause::Memory);
        } catch (const std::exception&) {
            giveUp(StopCause::Error);
        }
    }
}

void SimulationThread::act(const std::stop_token& stop) {
    const std::list<SimulationCommand> next = nextCommand(stop);
    if (!next.empty()) {
        std::visit([this](const auto& c) { execute(c); }, next.front());
        return;
    }
    const bool due = !m_speed || Clock::now() >= m_due;
    if (m_state == RunState::Running && due && !stop.stop_requested()) advance();
}

/// The last picture stays, and earlier frames can still be reached.
void SimulationThread::giveUp(StopCause cause) {
    m_ghost.reset();
    m_torn = m_world != nullptr;
    m_seeking = false;
    m_state = RunState::Stopped;
    Health health;
    if (m_world) health.frame = m_world->state().frame;
    say({m_state, health, cause, m_run});
}

/// Waits for a command, or for the next frame's time while running. One command at a time: the others must be
/// seen by superseded().
std::list<SimulationCommand> SimulationThread::nextCommand(const std::stop_token& stop) {
    std::unique_lock lock(m_mutex);
    const auto somethingQueued = [this] { return !m_queue.empty(); };
    if (m_state != RunState::Running)
        m_wake.wait(lock, stop, somethingQueued);
    else if (m_speed)
        m_wake.wait_until(lock, stop, m_due, somethingQueued);
    std::list<SimulationCommand> next;
    if (!m_queue.empty()) next.splice(next.begin(), m_queue, m_queue.begin());
    return next;
}

void SimulationThread::execute(const LoadCommand& command) {
    m_run = command.run;
    if (command.frame > 0) {
        if (m_world && m_shown && m_ghostWanted)
            m_ghost = {std::move(m_world), std::move(m_recording), false};
        begin(command.pipeline);
        if (m_state == RunState::Stopped) m_state = RunState::Paused;
        tell(); // what was said of the run before is dropped from now on
        seek(command.frame, false);
        return;
    }
    m_ghost.reset();
    m_state = RunState::Paused; // the GUI's side knows
    begin(command.pipeline);
    publish(true);
}

void SimulationThread::begin(const std::shared_ptr<const Pipeline>& pipeline) {
    m_world.reset(); // its memory is the new one's
    limitMemory();
    m_torn = false;
    m_world = std::make_unique<World>(pipeline);
    m_shown = false;
    applyBroadphase();
    m_recording = Recording(m_budget);
    shareBudget();
    m_recording.restart(*m_world);
    beginSamples();
    beginJudging();
    m_watch.begin(*m_world);
}

/// The guard needs the ledger: energy from position corrections of overlapping bodies is not counted as an
/// error.
void SimulationThread::beginSamples() {
    m_world->keepLedger(true);
    m_sampled = m_world->state().frame;
    m_guard.emplace(m_world->pipeline(), m_world->statistics());
}

/// They are judged once a run; a reset goes back in the same one.
void SimulationThread::beginJudging() {
    m_expectations.emplace(m_world->sharedPipeline());
    if (!m_expectations->empty()) m_expectations->begin(*m_world);
    m_judgedFrame = m_world->state().frame;
    m_judgedToTheEnd = false;
    m_judged.reset();
}

void SimulationThread::execute(const RunCommand&) {
    if (!m_world || m_state != RunState::Paused) return;
    m_due = Clock::now();
    m_watch.begin(*m_world);
    enter(RunState::Running);
}

void SimulationThread::execute(const PauseCommand&) {
    if (!m_world) return;
    if (m_state == RunState::Running) enter(RunState::Paused);
    publish(true); // also of an exchanged scene that is not where it was to go
}

void SimulationThread::execute(const StepCommand& command) {
    struct Made {
        std::atomic<int>& waiting;
        ~Made() { --waiting; } // also where memory runs out on the way
    } const made{m_stepsWaiting};
    if (!m_world || (m_state == RunState::Stopped && command.frames > 0)) return;
    if (m_state == RunState::Running) enter(RunState::Paused);
    seek(m_world->state().frame + command.frames, true);
}

void SimulationThread::execute(const SeekCommand& command) {
    if (m_world) seek(command.frame, true);
}

void SimulationThread::execute(const ResetCommand& command) {
    if (!m_world) return;
    m_run = command.run;
    if (m_ghost && !m_ghost->goesOn) m_ghost.reset();
    shareBudget();
    m_torn = false;
    m_world->reset();
    m_watch.begin(*m_world);
    beginSamples();
    m_state = RunState::Paused; // the GUI's side knows
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

void SimulationThread::execute(const BudgetCommand& command) {
    m_budget = command.bytes;
    shareBudget();
}

/// Two runs have half of it each.
void SimulationThread::shareBudget() {
    m_recording.setBudget(m_ghost ? m_budget / 2 : m_budget);
    if (m_ghost) m_ghost->recording.setBudget(m_budget / 2);
}

void SimulationThread::execute(const GhostCommand& command) {
    m_ghostWanted = command.wanted;
    if (m_ghostWanted || !m_ghost) return;
    m_ghost.reset();
    shareBudget();
    publish(true);
}

void SimulationThread::execute(const GhostRunCommand& command) {
    if (!m_world) return;
    m_ghost.reset();
    if (command.pipeline) {
        m_ghost = {std::make_unique<World>(command.pipeline), Recording(m_budget / 2), true};
        m_ghost->recording.restart(*m_ghost->world);
    }
    shareBudget();
    publish(true);
}

void SimulationThread::execute(const GuardCommand& command) { m_stopsAtRise = command.stops; }

void SimulationThread::execute(const BreakpointsCommand& command) {
    m_watch = BreakWatch(command.breakpoints);
    if (m_world) m_watch.begin(*m_world);
}

void SimulationThread::execute(const FindBackCommand&) {
    if (!m_world || m_watch.empty()) return;
    if (m_state == RunState::Running) enter(RunState::Paused);
    const std::int64_t now = m_world->state().frame;
    const std::optional<BreakHit> hit = lastHitBefore(now);
    if (superseded()) return;
    seek(hit ? hit->frame : now, true);
    m_listener.broke(hit);
}

void SimulationThread::execute(const ExplainCommand& command) {
    if (!m_world || command.frame <= m_recording.first()) return;
    if (m_state == RunState::Running) enter(RunState::Paused);
    const bool there = m_recording.seek(*m_world, command.frame - 1, [this](bool) {
        sample();
        return !superseded();
    });
    const Snapshot before = m_world->snapshot();
    seek(command.frame, true);
    if (!there || m_world->state().frame != command.frame || !m_listener.explained) return;
    m_listener.explained(m_run, storyOf(m_world->pipeline(), before, m_world->snapshot()));
}

/// From checkpoint to checkpoint backwards, each stretch simulated forwards to its end.
std::optional<BreakHit> SimulationThread::lastHitBefore(std::int64_t frame) {
    std::optional<BreakHit> last;
    std::int64_t end = frame - 1;
    while (!last && end > m_recording.first() && !superseded()) {
        const std::int64_t start = m_recording.keptBefore(end);
        m_recording.seek(*m_world, start, [](bool) { return true; });
        m_watch.begin(*m_world);
        while (m_world->state().frame < end && !superseded()) {
            m_world->step();
            const std::optional<std::size_t> breakpoint = m_watch.check(*m_world);
            if (breakpoint) last = {m_world->state().frame, *breakpoint};
        }
        end = start;
    }
    return last;
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
        judge();
        enter(RunState::Stopped);
        publish(true);
        return;
    }
    m_recording.note(*m_world);
    const bool gained = sample() && m_stopsAtRise;
    const double time = m_world->state().time;
    const bool reachedEnd =
        settings.duration && time >= *settings.duration && time - settings.step < *settings.duration;
    const std::optional<std::size_t> breakpoint = m_watch.check(*m_world);
    if (reachedEnd || breakpoint || gained) enter(RunState::Paused);
    if (breakpoint) m_listener.broke(BreakHit{m_world->state().frame, *breakpoint});
    publish(m_state != RunState::Running);
    schedule();
}

/// Waits until the samples in the queue are taken or a command comes: otherwise they would take unbounded
/// memory while the window is busy.
void SimulationThread::waitForRoom() {
    if (!m_samples.isFull()) return;
    m_listener.published();
    std::unique_lock lock(m_mutex);
    const std::stop_token stop = m_thread.get_stop_token();
    while (m_samples.isFull() && m_queue.empty() && !stop.stop_requested())
        m_wake.wait_for(lock, roomInterval);
}

/// Publishes each frame's statistics once, in order. Returns whether energy has risen without a cause in this
/// one.
bool SimulationThread::sample() {
    const std::int64_t frame = m_world->state().frame;
    judge();
    if (frame <= m_sampled || !m_world->health().finite) return false;
    m_sampled = frame;
    waitForRoom();
    m_samples.push(m_run, m_world->statistics());
    const std::optional<EnergyRise> rise = m_guard->look(m_world->statistics());
    if (rise && m_listener.gained) m_listener.gained(m_run, *rise);
    return rise.has_value();
}

/// Every frame once, in their order, as far as `carom test` would go.
void SimulationThread::judge() {
    const std::int64_t frame = m_world->state().frame;
    if (m_expectations->empty() || m_judgedToTheEnd || frame <= m_judgedFrame) return;
    m_judgedFrame = frame;
    const RunSettings& settings = m_world->pipeline().settings();
    m_expectations->look(*m_world);
    m_judged.reset();
    // A duration written as so many frames must not gain one by rounding.
    const double time = m_world->state().time + 1e-12 * settings.duration.value_or(0);
    m_judgedToTheEnd = !m_world->health().finite || (settings.duration && time >= *settings.duration);
    if (m_judgedToTheEnd) m_expectations->finish();
}

std::shared_ptr<const JudgedRun> SimulationThread::judged() {
    if (!m_judged && !m_expectations->empty())
        m_judged = std::make_shared<const JudgedRun>(
            JudgedRun{m_world->sharedPipeline(), m_expectations->judgements(), m_judgedFrame});
    return m_judged;
}

/// The frames of the seek are shown if `showing`. A command that comes meanwhile ends the seek, since the
/// newest command counts.
void SimulationThread::seek(std::int64_t frame, bool showing) {
    bool broken = false;
    const Clock::time_point began = Clock::now();
    if (std::exchange(m_torn, false)) // back to a whole frame first
        m_recording.seek(*m_world, std::max(m_recording.first(), std::min(frame, m_world->state().frame - 1)),
                         [](bool) { return true; });
    m_recording.seek(*m_world, std::max(frame, m_recording.first()), [&](bool) {
        sample();
        if (showing) publish(false);
        if (!m_seeking && Clock::now() - began > longSeek) {
            m_seeking = true;
            tell();
        }
        broken = superseded();
        return !broken;
    });
    if (std::exchange(m_seeking, false)) tell();
    if (!m_world->health().finite)
        enter(RunState::Stopped);
    else if (m_state == RunState::Stopped)
        enter(RunState::Paused);
    m_due = Clock::now();
    m_watch.begin(*m_world);
    if (showing || !broken) publish(true);
}

/// Whether a command waits that supersedes the present seek.
bool SimulationThread::superseded() {
    if (m_thread.get_stop_token().stop_requested()) return true;
    const std::lock_guard lock(m_mutex);
    return std::any_of(m_queue.begin(), m_queue.end(), [](const SimulationCommand& command) {
        return std::holds_alternative<LoadCommand>(command) || std::holds_alternative<SeekCommand>(command) ||
               std::holds_alternative<ResetCommand>(command) || std::holds_alternative<PauseCommand>(command);
    });
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
    m_shown = true;
    const std::size_t recorded = m_recording.bytes() + (m_ghost ? m_ghost->recording.bytes() : 0);
    m_snapshots.publish({m_run, std::make_shared<const Snapshot>(m_world->snapshot()), ghost(),
                         m_structureWanted ? m_world->broadphaseStructure() : std::vector<Aabb>(), recorded,
                         m_said, judged()});
    m_listener.published();
}

/// The other run where the one on screen is now; an old one as far as it went.
Ghost SimulationThread::ghost() {
    if (!m_ghost) return {};
    World& old = *m_ghost->world;
    const std::int64_t frame = std::llround(m_world->state().time / old.pipeline().settings().step);
    if (frame > m_ghost->recording.furthest() && !m_ghost->goesOn) return {};
    if (!old.health().finite && frame >= old.state().frame) return {};
    const bool there = m_ghost->recording.seek(old, frame, [this](bool) { return !superseded(); });
    if (!there) return {};
    return {old.sharedPipeline(), std::make_shared<const Snapshot>(old.snapshot())};
}

void SimulationThread::enter(RunState state) {
    if (state == m_state) return;
    m_state = state;
    tell();
}

void SimulationThread::tell() {
    say({m_state, m_world ? m_world->health() : Health{}, StopCause::Health, m_run, m_seeking});
}

void SimulationThread::say(RunStatus status) {
    status.number = m_said.number + 1;
    m_said = status;
    m_listener.stateChanged(m_said);
}

} // namespace carom
