// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/engines.h"

#include "app/errors.h"
#include "app/programs.h"
#include "core/base/clock.h"
#include "core/base/figures.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <system_error>
#include <vector>

extern char** environ;

namespace carom {
namespace {

namespace fs = std::filesystem;

/// Interval at which a waiting read checks for cancellation [ms]; at ten times cancelling lags.
constexpr int pollInterval = 50;

/// A child whose output is read, and that does not outlive this object.
class Child {
  public:
    explicit Child(const std::vector<std::string>& words) {
        std::array<int, 2> ends{};
        if (pipe2(ends.data(), O_CLOEXEC) != 0) return;
        m_output = ends[0];
        std::vector<char*> arguments;
        for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
        arguments.push_back(nullptr);
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
        posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
        if (posix_spawn(&m_process, arguments[0], &actions, nullptr, arguments.data(), environ) != 0)
            m_process = 0;
        posix_spawn_file_actions_destroy(&actions);
        close(ends[1]);
    }
    ~Child() {
        if (m_process > 0) {
            kill(m_process, SIGKILL);
            wait();
        }
        if (m_output >= 0) close(m_output);
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    bool isStarted() const { return m_process > 0; }
    /// What there is within a moment; nothing at the end.
    std::optional<std::string> read() {
        pollfd ready{m_output, POLLIN, 0};
        if (poll(&ready, 1, pollInterval) == 0) return std::string();
        std::string piece(1 << 16, '\0');
        const ssize_t count = ::read(m_output, piece.data(), piece.size());
        if (count < 0 && errno == EINTR) return std::string();
        if (count <= 0) return std::nullopt;
        piece.resize(static_cast<std::size_t>(count));
        return piece;
    }
    /// Its exit code, or -1.
    int wait() {
        int status = 0;
        while (waitpid(m_process, &status, 0) < 0)
            if (errno != EINTR) break;
        m_process = 0;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

  private:
    pid_t m_process = 0;
    int m_output = -1;
};

} // namespace

std::string engineProgram(const std::string& engine) {
    const std::string name = "carom-engine-" + engine;
    std::vector<fs::path> folders = {fs::path(ownProgram()).parent_path()};
    if (const char* const path = std::getenv("PATH")) {
        std::istringstream parts(path);
        for (std::string part; std::getline(parts, part, ':');) folders.emplace_back(part);
    }
    for (const fs::path& folder : folders)
        if (access((folder / name).c_str(), X_OK) == 0) return (folder / name).string();
    throw UsageError(
        "`--engines` has `" + engine + "`, and there is no program `" + name +
        "` beside carom or on the PATH; `packaging/build release tools` builds those of Bullet and "
        "ODE where Debian's libbullet-dev and libode-dev are installed");
}

std::string runEngineProgram(const std::string& scene, const EngineRequest& request) {
    const Stopwatch watch;
    std::vector<std::string> words = argumentsFor(scene, request);
    words.insert(words.begin(), engineProgram(request.engine));
    Child child(words);
    if (!child.isStarted()) return "its program could not be started";
    while (const std::optional<std::string> piece = child.read()) {
        request.read(*piece);
        if (!request.goOn()) return "it was ended";
        if (watch.elapsed() > 1000 * request.limit)
            return "it took longer than the " + figure(request.limit, 2) + " s that were left for it";
    }
    const int code = child.wait();
    return code == 0 ? std::string() : "its program ended with " + std::to_string(code);
}

} // namespace carom
