// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>

// Progress of long work, reported to the caller, who can cancel it:
//
//     const GoOn goOn = [&](double done) { show(done); return !cancelled; };
//     std::optional<Build> built = buildWhile(goOn, text, settings);
//
// Cancelled work unwinds with the exception Stopped, so that no incomplete value is ever returned; a loop
// becomes cancellable by one call of reach(). The function that offers the work catches Stopped.

namespace carom {

/// Called from the working thread with the part done, 0..1; false cancels the work. It must be quick.
using GoOn = std::function<bool(double done)>;

struct Stopped {};

/// One stage of the work: an interval of the whole.
class WorkStage {
  public:
    /// Reports to nobody.
    WorkStage() = default;
    /// The whole; `goOn` must live as long.
    explicit WorkStage(const GoOn& goOn) : m_goOn(&goOn) {}

    /// The interval of this stage between two parts of it, 0..1.
    WorkStage part(double from, double to) const {
        WorkStage stage = *this;
        stage.m_from = m_from + from * m_length;
        stage.m_length = (to - from) * m_length;
        return stage;
    }

    /// So much of this stage is done, 0..1. Throws Stopped where the work is to end.
    void reach(double done) const {
        if (m_goOn != nullptr && !(*m_goOn)(m_from + done * m_length)) throw Stopped{};
    }
    /// The same for loops of many short steps: every 4096th reports, so that a report costs little beside the
    /// steps and is still made some hundred times a second; `done` of `all`.
    void reach(std::size_t step, std::size_t done, std::size_t all) const {
        constexpr std::size_t between = 4096;
        if (step % between == 0 && all > 0) reach(static_cast<double>(done) / static_cast<double>(all));
    }

  private:
    const GoOn* m_goOn = nullptr;
    double m_from = 0, m_length = 1;
};

} // namespace carom
