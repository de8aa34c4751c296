// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>

// How far long work is, told to whoever started it, who may want it to end:
//
//     const GoOn goOn = [&](double done) { show(done); return !cancelled; };
//     std::optional<Build> built = buildWhile(goOn, text, settings);
//
// Work that is told to end unwinds with Stopped, so that no half-made value is ever seen, and a stage that
// wants to be stoppable is a line in its loop. Whoever offers the work catches it; it goes no further up.

namespace carom {

/// Asked in between, from the thread that works, with the part done, 0..1; false ends the work. It must be
/// quick.
using GoOn = std::function<bool(double done)>;

struct Stopped {};

/// One stage of the work, which is a stretch of the whole.
class WorkStage {
  public:
    /// Nobody asks.
    WorkStage() = default;
    /// The whole; `goOn` must live as long.
    explicit WorkStage(const GoOn& goOn) : m_goOn(&goOn) {}

    /// The stretch of this one between two parts of it, 0..1.
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
    /// The same for loops of many short steps, of which every 4096th asks; `done` of `all`.
    void reach(std::size_t step, std::size_t done, std::size_t all) const {
        constexpr std::size_t between = 4096;
        if (step % between == 0 && all > 0) reach(static_cast<double>(done) / static_cast<double>(all));
    }

  private:
    const GoOn* m_goOn = nullptr;
    double m_from = 0, m_length = 1;
};

} // namespace carom
