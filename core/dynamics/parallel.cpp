// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dynamics/parallel.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>

namespace carom {

namespace {
using Range = oneapi::tbb::blocked_range<std::size_t>;
}

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

void Workers::shareRanges(std::size_t count, Call work) {
    m_arena->arena.execute([&] {
        oneapi::tbb::parallel_for(Range(0, count, grain), [&](const Range& part) {
            work.call(work.context, part.begin(), part.end());
        });
    });
}

void Workers::shareElements(std::size_t count, Call work) {
    m_arena->arena.execute([&] {
        oneapi::tbb::parallel_for(
            Range(0, count, 1),
            [&](const Range& part) {
                const int thread = oneapi::tbb::this_task_arena::current_thread_index();
                for (std::size_t i = part.begin(); i < part.end(); ++i)
                    work.call(work.context, static_cast<std::size_t>(thread), i);
            },
            oneapi::tbb::simple_partitioner{});
    });
}

} // namespace carom
