// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/sweep_run.h"

#include "core/base/clock.h"
#include "core/simulation/world.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <limits>
#include <mutex>
#include <set>
#include <thread>

namespace carom {
namespace {

constexpr std::array<std::string_view, 3> outcomes = {"done", "lost", "faulty"};

double workOf(const World& world) {
    const FrameStatistics& frame = world.statistics();
    const WorkCounters& work = frame.work;
    const double moved = static_cast<double>(world.pipeline().bodies().mobileBodies.size()) *
                         world.pipeline().settings().substeps;
    return moved + work.operations +
           static_cast<double>(work.pairsCollided + work.rowsSwept + work.impacts + frame.events +
                               frame.contacts);
}

/// Hands out runs and collects what they gave.
class SweepWorkers {
  public:
    SweepWorkers(const Sweep& sweep, const ItemRange& part, const std::function<bool(std::size_t)>& isKnown,
                 const SweepListener& listener)
        : m_sweep(sweep), m_listener(listener), m_isKnown(isKnown), m_next(part.first), m_end(part.end) {}

    bool work(int threads) {
        {
            std::vector<std::jthread> workers;
            for (int i = 1; i < threads; ++i) workers.emplace_back([this] { workOne(); });
            workOne();
        }
        if (m_problem) std::rethrow_exception(m_problem);
        return !m_stopped;
    }

  private:
    void workOne() {
        while (const std::optional<std::size_t> run = next()) {
            std::optional<SweepResult> result;
            std::exception_ptr problem;
            try {
                result = runOf(m_sweep, *run, [this] { return goOn(); });
            } catch (...) {
                problem = std::current_exception();
            }
            end(*run, result, problem);
        }
    }

    bool goOn() {
        if (m_stopping) return false;
        if (m_listener.goOn && !m_listener.goOn()) m_stopping = true;
        return !m_stopping;
    }

    std::optional<std::size_t> next() {
        std::unique_lock lock(m_mutex);
        for (;;) {
            while (m_next < m_end && m_isKnown && m_isKnown(m_next)) ++m_next;
            if (m_next == m_end) return std::nullopt;
            if (!goOn()) {
                m_stopped = true;
                m_changed.notify_all();
                return std::nullopt;
            }
            if (m_running.empty() || m_next < *m_running.begin() + mostRunsAhead) break;
            m_changed.wait(lock);
        }
        m_running.insert(m_next);
        return m_next++;
    }

    void end(std::size_t run, const std::optional<SweepResult>& result, std::exception_ptr problem) {
        const std::lock_guard lock(m_mutex);
        m_running.erase(run);
        if (result && !m_problem && !problem) try {
                m_listener.ended(*result);
            } catch (...) {
                problem = std::current_exception();
            }
        if (!result) m_stopped = true;
        if (problem) {
            if (!m_problem) m_problem = problem;
            m_stopping = true;
        }
        m_changed.notify_all();
    }

    const Sweep& m_sweep;
    const SweepListener& m_listener;
    const std::function<bool(std::size_t)>& m_isKnown;
    std::mutex m_mutex; ///< guards all below but m_stopping
    std::condition_variable m_changed;
    std::size_t m_next, m_end;
    std::set<std::size_t> m_running;
    bool m_stopped = false; ///< before all runs were made
    std::exception_ptr m_problem;
    std::atomic<bool> m_stopping = false;
};

} // namespace

std::string_view nameOf(SweepOutcome outcome) { return outcomes[static_cast<std::size_t>(outcome)]; }

std::optional<SweepOutcome> outcomeNamed(std::string_view name) {
    const auto found = std::ranges::find(outcomes, name);
    if (found == outcomes.end()) return std::nullopt;
    return static_cast<SweepOutcome>(found - outcomes.begin());
}

std::optional<SweepResult> runOf(const Sweep& sweep, std::size_t run, const SweepGoOn& goOn) {
    const double start = processorTimeOfThread();
    SweepResult result;
    result.run = run;
    result.figures.assign(sweep.measures().size(), std::numeric_limits<double>::quiet_NaN());
    const auto ended = [&] {
        result.seconds = (processorTimeOfThread() - start) / 1000;
        return result;
    };
    const auto faulty = [&] {
        result.outcome = SweepOutcome::Faulty;
        return ended();
    };
    std::optional<std::string> text = sweep.textOf(run);
    if (!text) return faulty();
    SimulationSettings options;
    options.threads = 1;
    const Build built = build(std::move(*text), options);
    if (built.hasErrors()) return faulty();
    for (const SweepMeasure& measure : sweep.measures())
        if (objectionToMeasure(measure, *built.pipeline)) return faulty();

    World world(built.pipeline);
    MeasureWatch watch(sweep.measures(), built.pipeline);
    world.keepLedger(watch.needsLedger());
    watch.begin(world);
    const std::int64_t frames = sweep.definition().frames.value_or(framesOf(built.pipeline->settings()));
    while (world.state().frame < frames && world.health().finite) {
        if (goOn && !goOn()) return std::nullopt;
        world.step();
        if (!world.health().finite) break;
        watch.look(world);
        result.work += workOf(world);
    }
    result.outcome = world.health().finite ? SweepOutcome::Done : SweepOutcome::Lost;
    result.figures = watch.figures();
    if (world.health().finite) result.stateHash = world.stateHash();
    result.frames = world.state().frame;
    return ended();
}

bool runSweep(const Sweep& sweep, const ItemRange& part, int threads,
              const std::function<bool(std::size_t run)>& isKnown, const SweepListener& listener) {
    const auto most = static_cast<int>(std::clamp<std::size_t>(part.count(), 1, 1024));
    return SweepWorkers(sweep, part, isKnown, listener).work(std::clamp(threads, 1, most));
}

} // namespace carom
