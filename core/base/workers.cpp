// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/workers.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>
#ifdef CAROM_SANITIZE_THREAD
#    include <sanitizer/tsan_interface.h>
#endif

#include <algorithm>

namespace carom {

namespace {

using Range = oneapi::tbb::blocked_range<std::size_t>;

/// What oneTBB guarantees of a loop: its parts run after what came before the loop and before what comes
/// after it. The thread sanitizer must be told, because it does not see into a library that was not built
/// with it; it still checks the parts of one loop against each other.
class LoopOrder {
  public:
    LoopOrder() { happened(m_before); }
    ~LoopOrder() { after(m_parts); }
    LoopOrder(const LoopOrder&) = delete;
    LoopOrder& operator=(const LoopOrder&) = delete;

    template<class Part>
    void run(const Part& part) {
        after(m_before);
        part();
        happened(m_parts);
    }

  private:
#ifdef CAROM_SANITIZE_THREAD
    static void happened(char& what) { __tsan_release(&what); }
    static void after(char& what) { __tsan_acquire(&what); }
#else
    static void happened(char&) {}
    static void after(char&) {}
#endif

    char m_before = 0, m_parts = 0; // their addresses count
};

} // namespace

struct Workers::Arena {
    explicit Arena(int threads) : arena(threads) {}

    oneapi::tbb::task_arena arena;
};

Workers::Workers(int threads)
    : m_threads(std::clamp(threads, 1, oneapi::tbb::info::default_concurrency())),
      m_arena(std::make_unique<Arena>(m_threads)) {}

Workers::~Workers() = default;
Workers::Workers(Workers&&) noexcept = default;
Workers& Workers::operator=(Workers&&) noexcept = default;

Workers& Workers::alone() {
    static Workers workers(1);
    return workers;
}

void Workers::shareRanges(std::size_t count, std::size_t least, Call work) {
    LoopOrder order;
    m_arena->arena.execute([&] {
        oneapi::tbb::parallel_for(Range(0, count, least), [&](const Range& part) {
            order.run([&] { work.call(work.context, part.begin(), part.end()); });
        });
    });
}

void Workers::shareElements(std::size_t count, Call work) {
    LoopOrder order;
    m_arena->arena.execute([&] {
        oneapi::tbb::parallel_for(
            Range(0, count, 1),
            [&](const Range& part) {
                const int thread = oneapi::tbb::this_task_arena::current_thread_index();
                order.run([&] {
                    for (std::size_t i = part.begin(); i < part.end(); ++i)
                        work.call(work.context, static_cast<std::size_t>(thread), i);
                });
            },
            oneapi::tbb::simple_partitioner{});
    });
}

} // namespace carom
