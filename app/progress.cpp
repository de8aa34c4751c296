// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/progress.h"

#include <unistd.h>

#include <cstdio>

namespace carom {
namespace {

/// Before the first line, and between lines [ms]: short commands print none; at a tenth a terminal flickers,
/// at ten times the program seems to have stopped.
constexpr double firstDelay = 2000;
constexpr double interval = 200;

} // namespace

Progress::Progress(std::int64_t total, std::string_view things)
    : m_total(total), m_things(things), m_nextShow(firstDelay), m_isTerminal(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() { pause(); }

void Progress::pause() {
    if (m_shown) std::fputs("\r\x1b[K", stderr);
    m_shown = false;
}

void Progress::update(std::int64_t done) {
    if (!m_isTerminal) return;
    const double elapsed = m_watch.elapsed();
    if (elapsed < m_nextShow || done <= 0) return;
    m_nextShow = elapsed + interval;
    m_shown = true;
    const double left = elapsed * static_cast<double>(m_total - done) / static_cast<double>(done) / 1000;
    std::fprintf(stderr, "\r%lld of %lld %s, about %.0f s left\x1b[K", static_cast<long long>(done),
                 static_cast<long long>(m_total), m_things.c_str(), left);
}

} // namespace carom
