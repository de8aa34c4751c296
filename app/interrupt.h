// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <mutex>
#include <thread>

namespace carom {

/// From now on Ctrl-C, a request to end (SIGTERM) and a terminal that is closed (SIGHUP, unless it is
/// ignored, as under nohup) only set a flag; the loop that computes looks at it once a frame, writes what
/// there is and ends. A second one ends the program at once.
void catchInterrupts();
bool interrupted();

/// Work that Ctrl-C ends within half a second, however long one of its frames takes:
///
///     InterruptibleWork work([&] { ... write what there is ... });
///     while (!interrupted()) {
///         work.step([&] { world.step(); });
///         ... add what it gave to what there is ...
///     }
///
/// Where the loop has not ended 0.2 s after the signal because it is inside a step, a thread of this class's
/// own calls the function given and ends the program with 130.
class InterruptibleWork {
  public:
    explicit InterruptibleWork(std::function<void()> writeWhatThereIs);
    ~InterruptibleWork();
    InterruptibleWork(const InterruptibleWork&) = delete;
    InterruptibleWork& operator=(const InterruptibleWork&) = delete;

    /// The mutex is held outside of steps, so that results are never written half changed.
    template<class Function>
    auto step(Function&& function) {
        const Release released(m_held);
        return function();
    }
    /// Within a step it is released.
    template<class Function>
    void change(Function&& function) {
        const std::lock_guard lock(m_mutex);
        function();
    }

  private:
    struct Release {
        explicit Release(std::unique_lock<std::mutex>& lock) : held(lock) { held.unlock(); }
        ~Release() { held.lock(); }
        Release(const Release&) = delete;
        Release& operator=(const Release&) = delete;
        std::unique_lock<std::mutex>& held;
    };

    void watch(const std::stop_token& stop);

    std::function<void()> m_writeWhatThereIs;
    std::mutex m_mutex; ///< its owner may access the results
    std::unique_lock<std::mutex> m_held{m_mutex};
    std::jthread m_watcher;
};

} // namespace carom
