// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/sweep_run.h"

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

// The table of a sweep as CSV, a row a run:
//
//     run,cue.vel.z,seed,final y of ball,outcome,frames,state_hash,work,seconds
//
// Everything but the seconds is the same whatever the machine's threads, shards and interruptions.

namespace carom {

/// The first line, with its line end.
std::string sweepColumns(const Sweep& sweep);
/// The line of a run, with its line end.
std::string sweepRow(const Sweep& sweep, const SweepResult& result);

/// The number of a line's run; nothing if it does not begin with a whole number below `runs`.
std::optional<std::size_t> runOfRow(std::string_view line, std::size_t runs);
/// The result in a line, without its parameter values; nothing if it is no line of this sweep.
std::optional<SweepResult> resultOfRow(const Sweep& sweep, std::string_view line);

/// Sorts lines that arrive in any order into the order of the runs. It stores those that wait for an earlier
/// one.
class RowSorter {
  public:
    using Sink = std::function<void(std::size_t run, std::string_view line)>;
    /// The first line passed on is that of run `first`.
    RowSorter(std::size_t first, Sink sink) : m_next(first), m_sink(std::move(sink)) {}

    /// A run that has been added before is ignored.
    void add(std::size_t run, std::string_view line);
    /// Passes on all lines that still wait, although earlier ones are missing.
    void finish();
    /// The first run that has not been added.
    std::size_t next() const { return m_next; }

  private:
    std::size_t m_next;
    Sink m_sink;
    std::map<std::size_t, std::string> m_waiting;
};

/// The record in a folder of results, so that no results of another sweep are added: the definition, and what
/// else the rows depend on.
std::string sweepRecord(const Sweep& sweep, std::string_view version);
/// The definition in such a record; nothing if the text is none.
std::optional<SweepDefinition> definitionInRecord(std::string_view record);

} // namespace carom
