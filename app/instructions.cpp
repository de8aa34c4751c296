// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/instructions.h"

#include "app/errors.h"
#include "app/programs.h"
#include "app/temporary_file.h"
#include "core/base/text.h"
#include "core/integrators/integrator.h"
#include "core/solvers/solver.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <vector>

extern char** environ;

namespace carom {
namespace {

namespace fs = std::filesystem;

/// Runs a program of the PATH, its output dropped; whether it ended with 0.
bool succeeds(const std::vector<std::string>& words) {
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0);
    pid_t child = 0;
    const int problem = posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (problem != 0) return false;
    int status = 0;
    while (waitpid(child, &status, 0) < 0)
        if (errno != EINTR) return false;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// The total of a callgrind file: its line "totals: N", or "summary: N" in files that have no totals.
double totalIn(const std::string& path) {
    std::ifstream lines(path);
    double total = 0;
    for (std::string line; std::getline(lines, line);)
        for (const std::string_view name : {"totals: ", "summary: "})
            if (line.starts_with(name)) total = numberIn(line.substr(name.size())).value_or(0);
    return total;
}

std::string temporaryFolder() {
    std::error_code problem;
    const fs::path folder = fs::temp_directory_path(problem);
    if (!problem) return folder.string();
    const char* const wanted = std::getenv("TMPDIR");
    throw FileError(std::string("there is no folder for temporary files at `") +
                    (wanted != nullptr ? wanted : "/tmp") + "`; set TMPDIR to one");
}

double instructionsOf(const AccuracyStudy& study, const AccuracySetting& setting, const std::string& scene,
                      std::int64_t frames) {
    const TemporaryFile counts(temporaryFolder() + "/carom");
    std::vector<std::string> words = {"valgrind",
                                      "--tool=callgrind",
                                      "--callgrind-out-file=" + counts.path(),
                                      ownProgram(),
                                      "run",
                                      "--frames=" + std::to_string(frames),
                                      "--step=" + shortest(study.settings.step),
                                      "--threads=1",
                                      "--method=" + std::string(setting.method->name),
                                      "--substeps=" + std::to_string(setting.substeps)};
    if (setting.integrator != nullptr)
        words.push_back("--integrator=" + std::string(setting.integrator->name));
    if (setting.preset != nullptr) words.push_back("--preset=" + std::string(setting.preset->name));
    if (setting.tolerance > 0) words.push_back("--tolerance=" + shortest(setting.tolerance));
    words.insert(words.end(), {"--", scene}); // whatever it is called
    return succeeds(words) ? totalIn(counts.path()) : 0;
}

} // namespace

void needValgrind() {
    if (!succeeds({"valgrind", "--version"}))
        throw UsageError(
            "`--instructions` needs valgrind, which is not on the PATH; on Debian: apt install valgrind");
}

void countInstructions(AccuracyStudy& study, const std::string& scenePath,
                       const std::function<bool(std::size_t done)>& counted) {
    const double seconds = study.duration, step = study.settings.step;
    const auto frames =
        std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(seconds / step * (1 - 1e-12))));
    std::size_t done = 0;
    for (AccuracyPoint& point : study.points) {
        if (!counted(done++)) return;
        if (!point.finished() || point.instructions > 0 || !point.setting.engine.empty()) continue;
        const double first = instructionsOf(study, point.setting, scenePath, 1);
        const double all = instructionsOf(study, point.setting, scenePath, frames + 1);
        if (!counted(done)) return;
        if (!(all > first && first > 0))
            throw FileError("valgrind could not run", point.setting.name() + " of " + scenePath, EIO);
        point.instructions = (all - first) / (static_cast<double>(frames) * step);
    }
}

} // namespace carom
