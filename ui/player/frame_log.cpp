// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/player/frame_log.h"

#include <utility>

namespace carom {

void FrameLog::clear() {
    m_waiting.clear();
    m_rendered = 0;
}

void FrameLog::addFrames(const std::vector<FrameStatistics>& frames) {
    passOn();
    for (const FrameStatistics& frame : frames) m_waiting.push_back({frame, 0});
}

void FrameLog::noteRendered(double milliseconds) {
    m_rendered = milliseconds;
    passOn();
}

void FrameLog::passOn() {
    if (m_waiting.empty()) return;
    m_waiting.back().render = std::exchange(m_rendered, 0);
    Q_EMIT samplesReady(std::exchange(m_waiting, {}));
}

} // namespace carom

#include "moc_frame_log.cpp"
