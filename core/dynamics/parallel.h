// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>

namespace carom {

/// Threads for loops over bodies that do not know each other. Every element is computed by itself, so the
/// bits do not depend on the number of threads or on who took which part.
class Workers {
  public:
    /// `threads` includes the caller; 1 never starts another, and no more start than there are processors.
    explicit Workers(int threads);
    ~Workers();
    Workers(Workers&&) noexcept;
    Workers& operator=(Workers&&) noexcept;

    int threads() const { return m_threads; }

    /// Calls work(begin, end) for parts that together cover [0, count), each element once.
    template<class Work>
    void forRanges(std::size_t count, const Work& work) {
        if (m_threads == 1 || count < 2 * grain)
            work(std::size_t{0}, count);
        else
            shareRanges(count, {&work, [](const void* context, std::size_t begin, std::size_t end) {
                                    (*static_cast<const Work*>(context))(begin, end);
                                }});
    }

    /// Calls work(thread, i) for every i in [0, count) once; calls at the same time have different threads,
    /// all below threads(). For elements that take long and unequally so: a thread takes the next when it is
    /// done.
    template<class Work>
    void forEach(std::size_t count, const Work& work) {
        if (m_threads == 1 || count < 2)
            for (std::size_t i = 0; i < count; ++i) work(std::size_t{0}, i);
        else
            shareElements(count, {&work, [](const void* context, std::size_t thread, std::size_t i) {
                                      (*static_cast<const Work*>(context))(thread, i);
                                  }});
    }

  private:
    /// A function of two numbers that lives with the caller.
    struct Call {
        const void* context = nullptr;
        void (*call)(const void* context, std::size_t, std::size_t) = nullptr;
    };
    void shareRanges(std::size_t count, Call work);
    void shareElements(std::size_t count, Call work);

    /// Bodies a part holds at least. Advancing one takes about 5 ns and waking a thread some microseconds:
    /// much smaller parts would cost more than they save.
    static constexpr std::size_t grain = 2048;

    struct Arena; // oneTBB stays out of this header: nearly every file includes it, and would parse a second
                  // longer
    int m_threads;
    std::unique_ptr<Arena> m_arena;
};

} // namespace carom
