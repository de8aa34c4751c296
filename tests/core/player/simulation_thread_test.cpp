// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/files.h"
#include "tests/support/test_class.h"

#include "core/expectations/scene_check.h"
#include "core/player/simulation_thread.h"
#include "core/simulation/build.h"
#include "core/simulation/world.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>

// The thread of the simulation with two others: one that commands, and one that takes what it sends, as the
// IDE does with its events. Here no Qt lies between them, so that the thread sanitizer sees all of it.

namespace carom::test {
namespace {

std::shared_ptr<const Pipeline> threeBalls() {
    return build("wall { normal 0,1,0 toOrig 0 }\n"
                 "sphere { radius .1 mass 1 centre 0,1,0 elastic .9 }\n"
                 "sphere { radius .1 mass 1 centre .15,2,0 elastic .9 }\n"
                 "sphere { radius .1 mass 1 centre 0,3,.1 elastic .9 }\n")
        .pipeline;
}

/// Collects what a SimulationThread sends, on a thread of its own.
class Player {
  public:
    Player() {
        post(SpeedCommand{std::nullopt});
        m_collector = std::jthread([this](const std::stop_token& stop) {
            while (!stop.stop_requested()) {
                collect();
                std::this_thread::yield();
            }
        });
    }
    ~Player() {
        m_collector.request_stop();
        m_collector.join();
    }

    void post(SimulationCommand command) { m_thread.post(std::move(command)); }

    /// Waits until this holds of what has come; false where it never does.
    template<class Condition>
    bool waitFor(Condition condition) {
        std::unique_lock lock(m_mutex);
        return m_changed.wait_for(lock, std::chrono::milliseconds(longestWait), condition);
    }

    // What has come; read in a condition of waitFor, or when nothing moves.
    std::shared_ptr<const Snapshot> newest;
    Ghost ghost;
    std::vector<std::int64_t> frames; ///< of the run of the last batch
    std::uint64_t run = 0;
    RunState state = RunState::Paused;
    bool seeking = false;
    std::size_t recorded = 0;               ///< [bytes]
    RunState shownState = RunState::Paused; ///< what the newest snapshot says
    std::vector<BreakHit> hits;
    std::vector<EnergyRise> rises;
    std::shared_ptr<const JudgedRun> judged;

    std::int64_t frame() const { return newest ? newest->frame : -1; }

  private:
    void collect() {
        std::optional<PublishedSnapshot> published = m_thread.snapshots().take();
        SampleQueue::Batch batch = m_thread.samples().takeAll(); // with the frames up to the snapshot
        if (batch.frames.empty() && !published) return;
        const std::lock_guard lock(m_mutex);
        if (batch.run != run) frames.clear();
        run = batch.run;
        for (const FrameStatistics& sample : batch.frames) frames.push_back(sample.frame);
        if (published) {
            newest = published->snapshot;
            ghost = published->ghost;
            recorded = published->recorded;
            shownState = published->status.state;
            judged = published->judged;
        }
        m_changed.notify_all();
    }

    std::mutex m_mutex;
    std::condition_variable m_changed;
    SimulationThread m_thread{{[this](RunStatus status) {
                                   const std::lock_guard lock(m_mutex);
                                   state = status.state;
                                   seeking = status.seeking;
                                   m_changed.notify_all();
                               },
                               [this](std::optional<BreakHit> hit) {
                                   const std::lock_guard lock(m_mutex);
                                   if (hit) hits.push_back(*hit);
                                   m_changed.notify_all();
                               },
                               [] {},
                               [this](std::uint64_t, const EnergyRise& rise) {
                                   const std::lock_guard lock(m_mutex);
                                   rises.push_back(rise);
                                   m_changed.notify_all();
                               }}};
    std::jthread m_collector;
};

bool areSame(const Snapshot& snapshot, const World& world) {
    for (std::size_t body = 0; body < snapshot.pose.size(); ++body)
        if (snapshot.pose[body].position != world.state().pose[body].position ||
            snapshot.velocity[body] != world.state().velocity[body])
            return false;
    return snapshot.frame == world.state().frame;
}

} // namespace

class SimulationThreadTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void samplesThatNobodyTakesAreWaitedWith() {
        // A ball alone makes half a million frames a second; the window that takes them may be busy.
        std::atomic<int> told = 0;
        SimulationThread thread({[](RunStatus) {}, [](std::optional<BreakHit>) {}, [&told] { ++told; }});
        thread.post(SpeedCommand{std::nullopt});
        thread.post(LoadCommand{build("sphere { radius .1 mass 1 centre 0,0,0 vel 1,0,0 }").pipeline, 1, 0});
        thread.post(RunCommand{});
        const auto fills = [&thread] {
            const std::chrono::steady_clock::time_point end =
                std::chrono::steady_clock::now() + std::chrono::milliseconds(longestWait);
            while (!thread.samples().isFull() && std::chrono::steady_clock::now() < end)
                std::this_thread::yield();
            return thread.samples().isFull();
        };
        QVERIFY(fills());
        const SampleQueue::Batch first = thread.samples().takeAll();
        QCOMPARE(first.frames.size(), SampleQueue::mostWaiting);
        QVERIFY(fills()); // it goes on
        QVERIFY(told > 0);
        const SampleQueue::Batch second = thread.samples().takeAll();
        QCOMPARE(second.frames.front().frame, first.frames.back().frame + 1);
    } // and ends while it waits

    void aRunThatGainsEnergyPausesThereUnlessItIsToGoOn() {
        // Euler's scheme blows a spring up; its frames come once, whether one goes back or not.
        const std::shared_ptr<const Pipeline> swings =
            build("simulation { method contacts  integrator euler }\ngravity { accel 0, 0, 0 }\n"
                  "sphere bob { radius 0.1  mass 1  centre 1.1, 0, 0 }\n"
                  "spring { from world  to bob  stiffness 1000  length 1 }\n")
                .pipeline;
        Player player;
        player.post(LoadCommand{swings, 1, 0});
        player.post(RunCommand{});
        QVERIFY(player.waitFor([&] { return player.rises.size() == 1 && player.state == RunState::Paused; }));
        const std::int64_t frame = player.rises.front().frame;
        QVERIFY(player.waitFor([&] { return player.frame() == frame; }));
        player.post(RunCommand{}); // from there on it is no news
        QVERIFY(player.waitFor([&] { return player.frame() > frame + 5; }));
        player.post(GuardCommand{false});
        player.post(ResetCommand{2});
        player.post(RunCommand{});
        QVERIFY(player.waitFor([&] { return player.rises.size() == 2 && player.frame() > frame + 5; }));
        QCOMPARE(player.rises.back().frame, frame);
        player.post(PauseCommand{});
        QVERIFY(player.waitFor([&] { return player.state != RunState::Running; }));
    }

    void expectationsAreJudgedOnceAFrameWhereverOneGoes() {
        // An elastic ball falls 5 m at 10 m/s²: it bounces after 1 s and after 3 s, and is then at 10 m/s.
        const std::shared_ptr<const Pipeline> pipeline =
            build("gravity { accel 0, -10, 0 }\nwall { normal 0, 1, 0  toOrig 0 }\n"
                  "sphere ball { radius 0.5  mass 1  centre 0, 5.5, 0 }\n"
                  "expect { quantity impacts  of ball  at 3.5  value 2  within 0 }\n"
                  "expect { quantity speed  max 5 }\n"
                  "expect { quantity y  of ball  at 100  value 0  within 1 }\n")
                .pipeline;
        const SceneCheck alone = *checkScene(pipeline, {}, 4.0);
        Player player;
        player.post(LoadCommand{pipeline, 1, 0});
        QVERIFY(player.waitFor([&] { return player.judged != nullptr; }));
        QCOMPARE(player.judged->frame, std::int64_t{0});
        for (const std::int64_t frame : {100, 30, 0, 200, 150, 240}) {
            player.post(SeekCommand{frame});
            QVERIFY(player.waitFor([&] { return player.frame() == frame; }));
            // Back at the start nothing of the run is forgotten, and what is played again is not judged
            // again.
            if (frame == 200) player.post(ResetCommand{2});
        }
        QVERIFY(player.waitFor([&] { return player.frame() == 240 && player.judged->frame == 240; }));
        const std::vector<Judgement>& judgements = player.judged->judgements;
        QCOMPARE(judgements[0].state, ExpectationState::Holds);
        QCOMPARE(judgements[0].figure, 2.0);
        QCOMPARE(judgements[1].state, ExpectationState::Fails);
        QCOMPARE(*judgements[1].failedAt, *alone.judgements[1].failedAt);
        QCOMPARE(*judgements[1].failedAt, std::int64_t{31}); // the speed is 10 t
        QCOMPARE(judgements[2].state, ExpectationState::Waiting);
        player.post(LoadCommand{threeBalls(), 3, 0}); // expects nothing
        QVERIFY(player.waitFor([&] { return player.judged == nullptr; }));
    }

    void whatTheEndOfARunLeavesUnjudgedHasFailed() {
        Player player;
        player.post(LoadCommand{build("simulation { duration 1 }\n"
                                      "sphere ball { radius 0.5  mass 1  centre 0, 5.5, 0 }\n"
                                      "expect late { quantity y  of ball  at 2  value 0  within 1e9 }\n"
                                      "expect kept { quantity energy  drift 1e-9 }\n")
                                    .pipeline,
                                1, 0});
        player.post(SeekCommand{59});
        QVERIFY(player.waitFor([&] { return player.frame() == 59; }));
        QCOMPARE(player.judged->judgements[0].state, ExpectationState::Waiting);
        player.post(SeekCommand{90});
        QVERIFY(player.waitFor([&] { return player.frame() == 90; }));
        QCOMPARE(player.judged->frame, std::int64_t{60}); // what comes behind the duration is not asked about
        QCOMPARE(player.judged->judgements[0].state, ExpectationState::Fails);
        QCOMPARE(player.judged->judgements[1].state, ExpectationState::Holds);
    }

    void everyFrameOfARunArrivesAndItsStatesAreTheWorlds() {
        const std::shared_ptr<const Pipeline> pipeline = threeBalls();
        Player player;
        player.post(LoadCommand{pipeline, 1, 0});
        player.post(RunCommand{});
        QVERIFY(player.waitFor([&] { return player.frame() > 200; }));
        QCOMPARE(player.shownState, RunState::Running); // though the word of it may be on its way
        player.post(PauseCommand{});
        player.post(SeekCommand{150});
        QVERIFY(player.waitFor([&] { return player.state == RunState::Paused && player.frame() == 150; }));
        for (std::size_t k = 0; k < player.frames.size(); ++k)
            QCOMPARE(player.frames[k], static_cast<std::int64_t>(k) + 1);
        QVERIFY(player.frames.size() > 200);
        World world(pipeline);
        while (world.state().frame < 150) world.step();
        QVERIFY(areSame(*player.newest, world));
    }

    void commandsInTheMiddleOfARunAreFollowedInTheirOrder() {
        const std::shared_ptr<const Pipeline> pipeline = threeBalls();
        Player player;
        for (std::uint64_t run = 1; run <= 20; ++run) {
            player.post(LoadCommand{pipeline, run, 0});
            player.post(BroadphaseCommand{&broadphases()[run % broadphases().size()]});
            player.post(StructureCommand{run % 2 == 0});
            player.post(RunCommand{});
            QVERIFY(player.waitFor([&] { return player.run == run && player.frames.size() > 5; }));
        }
        player.post(PauseCommand{});
        player.post(SeekCommand{40});
        player.post(StepCommand{-3});
        QVERIFY(player.waitFor([&] { return player.state == RunState::Paused && player.frame() == 37; }));
        World world(pipeline);
        while (world.state().frame < 37) world.step();
        QVERIFY(areSame(*player.newest, world));
    }

    void anExchangedSceneGoesOnWithTheRunBeforeAsItsGhost() {
        Player player;
        player.post(LoadCommand{threeBalls(), 1, 0});
        player.post(SeekCommand{30});
        QVERIFY(player.waitFor([&] { return player.frame() == 30; }));
        player.post(LoadCommand{threeBalls(), 2, 20});
        QVERIFY(player.waitFor([&] { return player.frame() == 20 && player.ghost.snapshot != nullptr; }));
        QCOMPARE(player.ghost.snapshot->frame, std::int64_t{20});
        player.post(GhostCommand{false});
        QVERIFY(player.waitFor([&] { return player.ghost.snapshot == nullptr; }));
    }

    void aRunThatIsAskedForIsAGhostFromItsStartAndGoesAlong() {
        Player player;
        player.post(LoadCommand{threeBalls(), 1, 0});
        player.post(SeekCommand{20});
        QVERIFY(player.waitFor([&] { return player.frame() == 20; }));
        const auto isThereWith = [&](std::int64_t frame) {
            return player.waitFor([&] {
                return player.frame() == frame && player.ghost.snapshot &&
                       player.ghost.snapshot->frame == frame;
            });
        };
        player.post(GhostRunCommand{threeBalls()});
        QVERIFY(isThereWith(20));
        player.post(SeekCommand{50}); // where neither has been
        QVERIFY(isThereWith(50));
        player.post(ResetCommand{2});
        QVERIFY(isThereWith(0));
        player.post(GhostRunCommand{nullptr});
        QVERIFY(player.waitFor([&] { return player.ghost.snapshot == nullptr; }));
        player.post(GhostRunCommand{threeBalls()});
        QVERIFY(isThereWith(0));
        player.post(LoadCommand{threeBalls(), 3, 0}); // another scene
        QVERIFY(player.waitFor([&] { return player.ghost.snapshot == nullptr; }));
    }

    void afterAResetTheRunIsStillAtHandAndItsFramesComeAgain() {
        const std::shared_ptr<const Pipeline> pipeline = threeBalls();
        Player player;
        player.post(LoadCommand{pipeline, 1, 0});
        player.post(SeekCommand{300});
        QVERIFY(player.waitFor([&] { return player.frame() == 300 && player.frames.size() == 300; }));
        const std::size_t recorded = player.recorded;
        player.post(ResetCommand{2});
        QVERIFY(player.waitFor([&] { return player.frame() == 0; }));
        QCOMPARE(player.recorded, recorded);
        // A checkpoint is at most 32 frames away: what was simulated is not simulated from the beginning.
        player.post(SeekCommand{300});
        QVERIFY(player.waitFor([&] { return player.frame() == 300 && player.run == 2; }));
        QVERIFY(player.frames.size() <= 32);
        QCOMPARE(player.frames.back(), std::int64_t{300});
        player.post(ResetCommand{3});
        player.post(RunCommand{});
        QVERIFY(player.waitFor([&] { return player.run == 3 && player.frames.size() > 100; }));
        QCOMPARE(player.frames.front(), std::int64_t{1});
    }

    void aPauseEndsASeekAtTheFrameItHasReached() {
        Player player;
        player.post(LoadCommand{threeBalls(), 1, 0});
        player.post(SeekCommand{1'000'000'000}); // hours
        QVERIFY(player.waitFor([&] { return player.seeking && player.frame() > 0; }));
        player.post(PauseCommand{});
        QVERIFY(player.waitFor([&] { return !player.seeking; }));
        player.post(SeekCommand{7});
        QVERIFY(player.waitFor([&] { return player.frame() == 7; }));
        // On the way of an exchanged scene, too, which is shown there.
        player.post(LoadCommand{threeBalls(), 2, 1'000'000'000});
        QVERIFY(player.waitFor([&] { return player.seeking; }));
        player.post(PauseCommand{});
        QVERIFY(player.waitFor([&] { return !player.seeking && player.frame() > 7; }));
    }

    void aRunAndItsGhostHaveOneBudget() {
        constexpr std::size_t budget = 64 * 1024;
        Player player;
        player.post(BudgetCommand{budget});
        player.post(LoadCommand{threeBalls(), 1, 0});
        player.post(SeekCommand{4000});
        QVERIFY(player.waitFor([&] { return player.frame() == 4000; }));
        QVERIFY(player.recorded <= budget && player.recorded > budget / 4);
        player.post(LoadCommand{threeBalls(), 2, 3000});
        QVERIFY(player.waitFor([&] { return player.frame() == 3000 && player.ghost.snapshot != nullptr; }));
        QVERIFY2(player.recorded <= budget, std::to_string(player.recorded).c_str());
    }

    void aRunStopsAtABreakpointAndIsFoundBackThere() {
        Player player;
        player.post(BreakpointsCommand{{Breakpoint{}}}); // any contact
        player.post(LoadCommand{threeBalls(), 1, 0});
        player.post(RunCommand{});
        QVERIFY(player.waitFor(
            [&] { return player.hits.size() == 1 && player.frame() == player.hits[0].frame; }));
        QCOMPARE(player.state, RunState::Paused);
        player.post(SeekCommand{player.hits[0].frame + 1});
        player.post(FindBackCommand{});
        QVERIFY(player.waitFor(
            [&] { return player.hits.size() == 2 && player.frame() == player.hits[0].frame; }));
        QCOMPARE(player.hits[1].frame, player.hits[0].frame);
    }
};

} // namespace carom::test

CAROM_TEST(simulation_thread_test, carom::test::SimulationThreadTest)
#include "simulation_thread_test.moc"
