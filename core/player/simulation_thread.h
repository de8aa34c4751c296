// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/player/ghost.h"
#include "core/player/judged_run.h"
#include "core/player/latest.h"
#include "core/player/sample_queue.h"

#include "core/broadphase/broadphase.h"
#include "core/expectations/expectation_watch.h"
#include "core/simulation/breakpoint.h"
#include "core/simulation/energy_guard.h"
#include "core/simulation/event_story.h"
#include "core/simulation/health.h"
#include "core/simulation/pipeline.h"
#include "core/simulation/recording.h"
#include "core/simulation/snapshot.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <variant>
#include <vector>

// The thread that owns the World. It receives commands through a queue and publishes snapshots, samples and
// changes of state. What the threads exchange is immutable or a small value, and neither waits for the other:
//
//     GUI ── Load Run Pause Step Seek Reset Speed … ─────────▶ queue ──▶ World, Recording
//     GUI ◀── Latest<PublishedSnapshot>, SampleQueue, state ───────────── World

namespace carom {

class World;

/// A breakpoint held for the first time in the step that led to a frame.
struct BreakHit {
    std::int64_t frame = 0;
    std::size_t breakpoint = 0; ///< of those set
};

enum class RunState : std::uint8_t { Paused, Running, Stopped };

/// Why a run has stopped: its state is lost, memory has run out, or the program itself is at fault.
enum class StopCause : std::uint8_t { Health, Memory, Error };

struct RunStatus {
    RunState state = RunState::Paused;
    Health health; ///< not finite where the state is Stopped for its own sake
    StopCause cause = StopCause::Health;
    std::uint64_t run = 0;    ///< of which this is said
    bool seeking = false;     ///< a seek has taken so long that it is shown
    std::uint64_t number = 0; ///< counts the statuses published, in order
};

struct LoadCommand {
    std::shared_ptr<const Pipeline> pipeline;
    std::uint64_t run = 0; ///< identifies the run in everything that is published
    /// The frame to which the new run is simulated before it is shown. At 0 it is paused; further on it plays
    /// if the run before did, which becomes its ghost.
    std::int64_t frame = 0;
};
struct RunCommand {};
/// Also ends a seek, at the frame that it has reached.
struct PauseCommand {};
/// One frame on, or back, and pause there.
struct StepCommand {
    std::int64_t frames = 1;
};
/// To a frame, re-simulated where there is no checkpoint; goes on playing if it did.
struct SeekCommand {
    std::int64_t frame = 0;
};
/// What checkpoints may take, those of a ghost among them [bytes].
struct BudgetCommand {
    std::size_t bytes = 0;
};
/// Whether the run that an exchanged scene replaces is kept as its ghost; it is simulated along.
struct GhostCommand {
    bool wanted = true;
};
/// A run to show as the ghost of the one on screen, simulated along as far as that goes, until another scene
/// is loaded; null: none any more.
struct GhostRunCommand {
    std::shared_ptr<const Pipeline> pipeline;
};
/// To frame 0, paused. Checkpoints are kept; statistics are published again as the run repeats.
struct ResetCommand {
    std::uint64_t run = 0;
};
/// Simulated seconds a second of wall time; nothing is "as fast as possible".
struct SpeedCommand {
    std::optional<double> speed;
};
/// Null is what the scene itself asks for.
struct BroadphaseCommand {
    const BroadphaseRow* row = nullptr;
};

/// Whether snapshots carry the broad-phase's cells or nodes from now on; they cost a copy each.
struct StructureCommand {
    bool wanted = false;
};

/// Whether a run that gains energy without a cause pauses there; it is reported in any case.
struct GuardCommand {
    bool stops = true;
};

/// Where the run stops while it plays.
struct BreakpointsCommand {
    std::vector<Breakpoint> breakpoints;
};
/// Back to the last frame before this one at which a breakpoint held, and pause there.
struct FindBackCommand {};

/// To a frame, paused there, and what happened in it.
struct ExplainCommand {
    std::int64_t frame = 0;
};

using SimulationCommand =
    std::variant<LoadCommand, RunCommand, PauseCommand, StepCommand, SeekCommand, ResetCommand, SpeedCommand,
                 BroadphaseCommand, StructureCommand, BudgetCommand, GhostCommand, GhostRunCommand,
                 GuardCommand, BreakpointsCommand, FindBackCommand, ExplainCommand>;

struct PublishedSnapshot {
    std::uint64_t run = 0;
    std::shared_ptr<const Snapshot> snapshot;
    Ghost ghost;
    std::vector<Aabb> structure;             ///< World::broadphaseStructure(), empty unless asked for
    std::size_t recorded = 0;                ///< memory of the checkpoints [bytes]
    RunStatus status;                        ///< what was said last: it may come before the word of it
    std::shared_ptr<const JudgedRun> judged; ///< the same pointer until there is something new; null without
                                             ///< expectations
};

class SimulationThread {
  public:
    /// Called on the simulation's thread; they must only post to the GUI thread.
    struct Listener {
        std::function<void(RunStatus)> stateChanged;
        /// A breakpoint held; or the one looked for backwards was not found.
        std::function<void(std::optional<BreakHit>)> broke;
        std::function<void()> published; ///< a snapshot or samples are there to be taken
        /// Energy has risen without a cause, for the first time in that run.
        std::function<void(std::uint64_t run, EnergyRise)> gained = {};
        std::function<void(std::uint64_t run, EventStory)> explained = {};
    };

    explicit SimulationThread(Listener listener);
    ~SimulationThread();
    SimulationThread(const SimulationThread&) = delete;
    SimulationThread& operator=(const SimulationThread&) = delete;

    /// Memory of checkpoints at most, until a BudgetCommand changes it [bytes]. At half, they are twice as
    /// far apart and a seek takes twice as long.
    static constexpr std::size_t defaultBudget = std::size_t{512} << 20;

    void post(SimulationCommand command);
    /// Whether a step that was asked for has not been made yet.
    bool stepWaits() const { return m_stepsWaiting > 0; }
    Latest<PublishedSnapshot>& snapshots() { return m_snapshots; }
    SampleQueue& samples() { return m_samples; }

  private:
    using Clock = std::chrono::steady_clock;

    void run(const std::stop_token& stop);
    std::list<SimulationCommand> nextCommand(const std::stop_token& stop);
    void execute(const LoadCommand& command);
    void execute(const RunCommand& command);
    void execute(const PauseCommand& command);
    void execute(const StepCommand& command);
    void execute(const SeekCommand& command);
    void execute(const ResetCommand& command);
    void execute(const SpeedCommand& command);
    void execute(const BroadphaseCommand& command);
    void execute(const StructureCommand& command);
    void execute(const BudgetCommand& command);
    void execute(const GhostCommand& command);
    void execute(const GhostRunCommand& command);
    void execute(const GuardCommand& command);
    void execute(const BreakpointsCommand& command);
    void execute(const FindBackCommand& command);
    void execute(const ExplainCommand& command);

    void begin(const std::shared_ptr<const Pipeline>& pipeline);
    Ghost ghost();
    std::optional<BreakHit> lastHitBefore(std::int64_t frame);
    void advance();
    void seek(std::int64_t frame, bool showing);
    bool sample();
    void beginJudging();
    void judge();
    std::shared_ptr<const JudgedRun> judged();
    void waitForRoom();
    void beginSamples();
    void shareBudget();
    bool superseded();
    void schedule();
    void applyBroadphase();
    void publish(bool always);
    void enter(RunState state);
    void tell();
    void say(RunStatus status);
    void act(const std::stop_token& stop);
    void giveUp(StopCause cause);

    Listener m_listener;
    Latest<PublishedSnapshot> m_snapshots;
    SampleQueue m_samples;

    std::mutex m_mutex; ///< of the queue only
    std::condition_variable_any m_wake;
    std::list<SimulationCommand> m_queue;
    std::atomic<int> m_stepsWaiting = 0;

    // Everything below belongs to the thread.
    struct Past {
        std::unique_ptr<World> world;
        Recording recording;
        bool goesOn = false; ///< further than it has been
    };
    std::unique_ptr<World> m_world;
    std::size_t m_budget = defaultBudget;
    Recording m_recording{defaultBudget};
    std::optional<Past> m_ghost;
    BreakWatch m_watch;
    std::optional<EnergyGuard> m_guard;             ///< of the frames whose statistics went up
    std::optional<ExpectationWatch> m_expectations; ///< of the frames up to m_judgedFrame
    std::int64_t m_judgedFrame = 0;
    bool m_judgedToTheEnd = false;             ///< the scene's duration is over, or its state lost
    std::shared_ptr<const JudgedRun> m_judged; ///< what went up; null where it is old
    bool m_stopsAtRise = true;
    bool m_ghostWanted = true;
    bool m_torn = false;  ///< a frame was interrupted: the world must be restored
    bool m_shown = false; ///< the world has been on screen, so it can become a ghost
    bool m_seeking = false;
    RunStatus m_said;
    std::int64_t m_sampled = 0; ///< the last frame whose statistics went up
    std::uint64_t m_run = 0;
    RunState m_state = RunState::Paused;
    std::optional<double> m_speed = 1.0;
    const BroadphaseRow* m_broadphase = nullptr;
    bool m_structureWanted = false;
    Clock::time_point m_due;         ///< when the next frame begins
    Clock::time_point m_nextPublish; ///< no snapshot goes up before

    std::jthread m_thread; ///< last: it starts when everything else is there
};

} // namespace carom
