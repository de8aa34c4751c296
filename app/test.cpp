// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/command.h"
#include "app/errors.h"
#include "app/files.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/test_report.h"
#include "core/scene/schema.h"
#include "core/simulation/build.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>

namespace carom {

CommandRow testCommand();

namespace {

/// One run that is to be made.
struct Job {
    TestedScene tested;
    std::string text;
    SimulationSettings options;
    bool unreadable = false;
    std::exception_ptr problem;
};

/// The presets that a scene says something of: each that an expectation names, all where one names none.
std::vector<std::string> presetsAskedOf(const Scene& scene) {
    std::vector<std::string> presets;
    for (const std::string_view preset : presetWords())
        if (std::ranges::any_of(scene.expectations, [&](const Expectation& asked) {
                return asked.preset.empty() || asked.preset == preset;
            }))
            presets.emplace_back(preset);
    return presets;
}

std::vector<Job> jobsFor(const Arguments& arguments) {
    const std::optional<std::string> preset = arguments.word("preset", presetWords());
    const bool all = arguments.has("all-presets");
    if (preset && all) throw UsageError("`--preset` and `--all-presets` exclude each other");
    std::vector<Job> jobs;
    for (const std::string& path : arguments.operands) {
        Job job;
        job.tested.file = displayName(path);
        try {
            job.text = readText(path);
        } catch (const UnreadableFile& error) { // the other scenes are judged all the same
            job.tested.faults = {std::string("carom test: ") + error.what()};
            job.unreadable = true;
        } catch (const TextTooLarge& error) {
            job.tested.faults = {std::string("carom test: ") + error.what()};
            job.tested.hasErrors = true;
        }
        std::vector<std::string> presets;
        if (all && job.tested.faults.empty()) presets = presetsAskedOf(analyse(job.text).scene);
        job.options.preset = preset;
        if (presets.empty()) jobs.push_back(job);
        for (std::string& word : presets) {
            job.options.preset = std::move(word);
            jobs.push_back(job);
        }
    }
    return jobs;
}

void runJob(Job& job) {
    TestedScene& tested = job.tested;
    if (!tested.faults.empty()) return;
    const Build built = build(std::move(job.text), job.options);
    tested.hasErrors = built.hasErrors();
    tested.preset = built.pipeline->settings().preset->name;
    for (const Diagnostic& diagnostic : built.diagnostics)
        if (diagnostic.severity() == Severity::Error || diagnostic.code == DiagnosticCode::ExpectationTooLate)
            tested.faults.push_back(formatDiagnostic(built.analysis, diagnostic, tested.file));
    tested.check = checkRepeated(built, job.options, [] { return !interrupted(); });
    if (!tested.check) return;
    for (const Judgement& judgement : tested.check->judgements)
        tested.lines.push_back(
            built.analysis.positionOf(judgement.expectation->source.declaration.offset).line);
    tested.skipped = built.pipeline->scene().expectations.size() - tested.lines.size();
}

/// Runs jobs on threads of its own; they are handed on in the order given, whichever is done first.
class JobRunner {
  public:
    JobRunner(std::vector<Job>& jobs, std::size_t threads) : m_jobs(jobs), m_done(jobs.size(), false) {
        for (std::size_t i = 0; i < std::min(threads, jobs.size()); ++i)
            m_threads.emplace_back([this] { work(); });
    }

    void waitFor(std::size_t job) {
        std::unique_lock lock(m_mutex);
        m_changed.wait(lock, [&] { return m_done[job]; });
    }

  private:
    void work() {
        for (std::size_t i = m_next++; i < m_jobs.size(); i = m_next++) {
            try {
                runJob(m_jobs[i]);
            } catch (...) {
                m_jobs[i].problem = std::current_exception();
            }
            const std::lock_guard lock(m_mutex);
            m_done[i] = true;
            m_changed.notify_all();
        }
    }

    std::vector<Job>& m_jobs;
    std::vector<bool> m_done;
    std::mutex m_mutex;
    std::condition_variable m_changed;
    std::atomic<std::size_t> m_next = 0;
    std::vector<std::jthread> m_threads; // last: they use the others
};

int exitCodeOf(std::span<const TestedScene> tested, bool unreadable) {
    if (std::ranges::any_of(tested, [](const TestedScene& one) { return one.failing() > 0; }))
        return exitcode::expectationFailed;
    if (unreadable) return exitcode::fileError;
    return std::ranges::any_of(tested, &TestedScene::hasErrors) ? exitcode::sceneHasErrors : exitcode::done;
}

int runTest(const Arguments& arguments) {
    constexpr std::int64_t mostSideBySide = 1024; // threads: more than a machine has; a mistake is reported
    const auto processors = static_cast<std::int64_t>(std::max(1U, std::thread::hardware_concurrency()));
    const std::int64_t threads = arguments.wholeNumber("threads", 1, mostSideBySide).value_or(processors);
    const std::optional<std::string> file = arguments.text("junit");
    std::vector<NamedFile> files = {{"`--junit`", file.value_or("")}};
    for (const std::string& path : arguments.operands) files.push_back({"the scene", path});
    for (std::size_t i = 1; i < files.size(); ++i) refuseSharedFiles({files[0], files[i]});
    const bool tap = arguments.has("tap");
    std::vector<Job> jobs = jobsFor(arguments);
    catchInterrupts();

    std::vector<TestedScene> tested; // in order, as far as they are done
    bool unreadable = false;
    std::size_t lines = 0;
    const auto conclude = [&] {
        if (tap)
            printOut("1.." + std::to_string(lines) + "\n");
        else
            printOut(summaryOf(tested) + "\n");
        if (file) replaceFile(*file, asJUnit(tested));
    };
    if (tap) printOut("TAP version 13\n");
    {
        InterruptibleWork work(conclude);
        Progress progress(static_cast<std::int64_t>(jobs.size()), "runs");
        JobRunner runner(jobs, static_cast<std::size_t>(threads));
        for (std::size_t i = 0; i < jobs.size() && !interrupted(); ++i) {
            work.step([&] { runner.waitFor(i); });
            if (jobs[i].problem) std::rethrow_exception(jobs[i].problem);
            if (interrupted()) break;
            progress.pause();
            TestedScene& one = jobs[i].tested;
            printOut(tap ? asTap(one, lines + 1) : describe(one));
            lines += tapLines(one);
            unreadable = unreadable || jobs[i].unreadable;
            tested.push_back(std::move(one));
            progress.update(static_cast<std::int64_t>(i + 1));
        }
    }
    conclude();
    return interrupted() ? exitcode::interrupted : exitCodeOf(tested, unreadable);
}

} // namespace

CommandRow testCommand() {
    return {.name = "test",
            .summary = "Run scenes and judge their `expect` declarations",
            .operands = "SCENE...",
            .example = "carom test scenes/hard/*.sdl\n"
                       "carom test --all-presets --junit report.xml scenes/hard/07_flat_cube.sdl",
            .options = {{"preset", 'p', "P", "run with this preset instead of the scene's"},
                        {"all-presets", 0, "", "run once with every preset that expectations ask for"},
                        {"junit", 0, "FILE", "write a report in JUnit's XML as well"},
                        {"tap", 0, "", "print in the Test Anything Protocol"},
                        {"threads", 0, "T", "scenes to run side by side; the output is the same"}},
            .details =
                "A line an expectation: whether it holds, what was measured when it was nearest to failing, "
                "and how many "
                "digits of what is allowed are to spare. A scene runs for its duration; without one, until "
                "the last moment that an expectation names, and for ten seconds where one asks for all that "
                "follows. Expectations never change the motion.\n\n"
                "The exit code is 0 if all hold, 5 if one fails, 3 if a scene cannot be read and 1 if one "
                "has "
                "errors. Ctrl-C ends the runs: what was judged is written, and the exit code is 130.",
            .leastOperands = 1,
            .mostOperands = std::numeric_limits<std::size_t>::max(),
            .run = runTest};
}

} // namespace carom
