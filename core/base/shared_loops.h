// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/workers.h"

#include <atomic>
#include <cstddef>
#include <vector>

// Loops that threads share, where what they compute is put together in one order, or is one answer.

namespace carom {

/// Calls add(term) for what termOf(i) gives of every i in [0, count), in this order and by the calling
/// thread, so that sums of them have the same bits whatever the threads. A part has at least `least` terms;
/// the caller keeps them.
template<class Term, class TermOf, class Add>
void forTerms(std::size_t count, std::size_t least, std::vector<Term>& kept, Workers& workers,
              const TermOf& termOf, const Add& add) {
    if (workers.threads() == 1 || count < 2 * least) {
        for (std::size_t i = 0; i < count; ++i) add(termOf(i));
        return;
    }
    kept.resize(count);
    workers.forRanges(count, least, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) kept[i] = termOf(i);
    });
    for (const Term& term : kept) add(term);
}

/// Whether is(i) holds for any i in [0, count). Of a part, none is asked after one of which it does.
template<class Is>
bool holdsForAny(std::size_t count, std::size_t least, Workers& workers, const Is& is) {
    std::atomic<bool> found = false;
    workers.forRanges(count, least, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            if (is(i)) {
                found = true;
                return;
            }
    });
    return found;
}

} // namespace carom
