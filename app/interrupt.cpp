// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/interrupt.h"

#include "app/errors.h"
#include "app/files.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cerrno>
#include <condition_variable>
#include <csignal>
#include <cstdlib>
#include <exception>

namespace carom {
namespace {

std::atomic<bool> signalled = false; ///< the handler runs on any thread, and the watching one reads it
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may touch nothing else");
std::array<int, 2> wakePipe{-1, -1}; ///< written to by the handler and at the end of the watching

extern "C" void noteSignal(int) {
    signalled = true;
    const char byte = 0;
    if (wakePipe[1] >= 0 && ::write(wakePipe[1], &byte, 1) < 0) return; // full: it wakes all the same
}

void catchSignal(int number) {
    struct sigaction before = {};
    if (sigaction(number, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) return;
    struct sigaction action = {};
    action.sa_handler = noteSignal;
    // SA_RESETHAND: the second signal has the default action, which ends the program.
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(number, &action, nullptr);
}

} // namespace

void catchInterrupts() {
    if (wakePipe[0] < 0 && ::pipe2(wakePipe.data(), O_CLOEXEC | O_NONBLOCK) != 0) wakePipe = {-1, -1};
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) catchSignal(number);
}

bool interrupted() { return signalled; }

InterruptibleWork::InterruptibleWork(std::function<void()> writeWhatThereIs)
    : m_writeWhatThereIs(std::move(writeWhatThereIs)),
      m_watcher([this](const std::stop_token& stop) { watch(stop); }) {}

InterruptibleWork::~InterruptibleWork() {
    m_watcher.request_stop();
    const char byte = 0;
    if (wakePipe[1] >= 0 && ::write(wakePipe[1], &byte, 1) < 0) {
    } // full: it wakes all the same
    m_held.unlock();
    m_watcher.join();
}

void InterruptibleWork::watch(const std::stop_token& stop) {
    using namespace std::chrono_literals;
    pollfd wake{.fd = wakePipe[0], .events = POLLIN, .revents = 0};
    std::array<char, 16> bytes{};
    while (!stop.stop_requested() && !interrupted()) {
        if (::poll(&wake, 1, -1) < 0 && errno != EINTR) return;
        if (!interrupted() && ::read(wakePipe[0], bytes.data(), bytes.size()) < 0 && errno != EAGAIN) return;
    }
    std::mutex mutex;
    std::unique_lock lock(mutex);
    std::condition_variable_any never;
    never.wait_for(lock, stop, 200ms, [] { return false; }); // or until the work has ended by itself
    const std::unique_lock held(m_mutex);
    if (stop.stop_requested()) return;
    try {
        m_writeWhatThereIs();
    } catch (const std::exception& error) {
        printError(std::string("carom: ") + error.what() + "\n");
        std::_Exit(exitcode::fileError);
    }
    std::_Exit(exitcode::interrupted); // no destructor waits for the work
}

} // namespace carom
