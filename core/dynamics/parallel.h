// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cstddef>

namespace carom {

/// Threads for loops over bodies that do not know each other. Every element is computed by itself, so the
/// bits do not depend on the number of threads or on who took which part.
class Workers {
  public:
    /// `threads` includes the caller; 1 never starts another, and no more start than there are processors.
    explicit Workers(int threads)
        : m_threads(std::clamp(threads, 1, oneapi::tbb::info::default_concurrency())), m_arena(m_threads) {}

    int threads() const { return m_threads; }

    /// Calls work(begin, end) for parts that together cover [0, count), each element once.
    template<class Work>
    void forRanges(std::size_t count, const Work& work) {
        if (m_threads == 1 || count < 2 * grain) {
            work(std::size_t{0}, count);
            return;
        }
        using Range = oneapi::tbb::blocked_range<std::size_t>;
        m_arena.execute([&] {
            oneapi::tbb::parallel_for(Range(0, count, grain),
                                      [&](const Range& part) { work(part.begin(), part.end()); });
        });
    }

    /// Calls work(thread, i) for every i in [0, count) once; calls at the same time have different threads,
    /// all below threads(). For elements that take long and unequally so: a thread takes the next when it is
    /// done.
    template<class Work>
    void forEach(std::size_t count, const Work& work) {
        if (m_threads == 1 || count < 2) {
            for (std::size_t i = 0; i < count; ++i) work(std::size_t{0}, i);
            return;
        }
        using Range = oneapi::tbb::blocked_range<std::size_t>;
        m_arena.execute([&] {
            oneapi::tbb::parallel_for(
                Range(0, count, 1),
                [&](const Range& part) {
                    const int thread = oneapi::tbb::this_task_arena::current_thread_index();
                    for (std::size_t i = part.begin(); i < part.end(); ++i)
                        work(static_cast<std::size_t>(thread), i);
                },
                oneapi::tbb::simple_partitioner{});
        });
    }

  private:
    /// Bodies a part holds at least. Advancing one takes about 5 ns and waking a thread some microseconds:
    /// much smaller parts would cost more than they save.
    static constexpr std::size_t grain = 2048;

    int m_threads;
    oneapi::tbb::task_arena m_arena;
};

} // namespace carom
