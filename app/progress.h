// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/clock.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace carom {

/// A progress line on standard error, if that is a terminal and the work takes longer than two seconds;
/// otherwise nothing at all.
class Progress {
  public:
    /// `things` is what is counted: "frames".
    explicit Progress(std::int64_t total, std::string_view things = "frames");
    ~Progress(); ///< wipes the line

    void update(std::int64_t done);
    /// Wipes the line until the next update, so that something else can be printed.
    void pause();

  private:
    Stopwatch m_watch;
    std::int64_t m_total;
    std::string m_things;
    double m_nextShow; ///< [ms] since the start
    bool m_isTerminal;
    bool m_shown = false;
};

} // namespace carom
