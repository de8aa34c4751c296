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

/// The first line, with its end.
std::string sweepColumns(const Sweep& sweep);
/// The line of a run, with its end.
std::string sweepRow(const Sweep& sweep, const SweepResult& result);

/// The run of a line; nothing where it does not begin with a whole number below `runs`.
std::optional<std::size_t> runOfRow(std::string_view line, std::size_t runs);
/// What a line says, its values apart; nothing where it is no line of this sweep.
std::optional<SweepResult> resultOfRow(const Sweep& sweep, std::string_view line);

/// Puts lines that come in any order into that of the runs. It holds those that wait for an earlier one.
class RowSorter {
  public:
    using Sink = std::function<void(std::size_t run, std::string_view line)>;
    /// The first line handed on is that of run `first`.
    RowSorter(std::size_t first, Sink sink) : m_next(first), m_sink(std::move(sink)) {}

    /// A run that was there before is left out.
    void add(std::size_t run, std::string_view line);
    /// Hands on what waits, over the gaps.
    void finish();
    /// The first run that has not come.
    std::size_t next() const { return m_next; }

  private:
    std::size_t m_next;
    Sink m_sink;
    std::map<std::size_t, std::string> m_waiting;
};

/// What a folder of results says of itself, so that nothing else is added to it: the definition, and what the
/// rows depend on besides.
std::string sweepRecord(const Sweep& sweep, std::string_view version);
/// The definition of such a record; nothing where it is none.
std::optional<SweepDefinition> definitionInRecord(std::string_view record);

} // namespace carom
