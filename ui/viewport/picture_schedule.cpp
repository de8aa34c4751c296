// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/picture_schedule.h"

#include <algorithm>
#include <utility>

namespace carom {

namespace {

/// [ms] without a change until a still picture is drawn in full; at a tenth mid-gesture.
constexpr int restAfter = 250;

} // namespace

PictureSchedule::PictureSchedule(std::function<bool()> isWanted) : m_isWanted(std::move(isWanted)) {
    m_rest.setSingleShot(true);
    m_rest.setInterval(restAfter);
    connect(&m_rest, &QTimer::timeout, this, [this] {
        m_atRest = m_stale = true;
        schedule();
    });
    m_pause.setSingleShot(true);
    connect(&m_pause, &QTimer::timeout, this, &PictureSchedule::due);
}

void PictureSchedule::setReady(bool software) {
    m_ready = true;
    m_software = software;
    changed();
}

void PictureSchedule::changed() {
    m_atRest = false;
    m_stale = true;
    if (m_software) m_rest.start();
    schedule();
}

/// At once would draw every change of several that come together.
void PictureSchedule::schedule() {
    if (!m_ready || m_underWay || m_pause.isActive() || !m_isWanted()) return;
    m_pause.start(std::max(0, static_cast<int>(m_pace.pause() - m_sincePicture.elapsed())));
}

bool PictureSchedule::begin() {
    if (m_underWay || !m_stale || !m_isWanted()) return false;
    m_wasSmooth = isSmooth();
    m_hurried = !m_wasSmooth && m_pace.leavesShadowsOut();
    m_stale = false;
    m_underWay = true;
    return true;
}

void PictureSchedule::ended(double milliseconds) {
    m_underWay = false;
    m_sincePicture.lap();
    if (milliseconds > 0 && !m_wasSmooth) m_pace.note(milliseconds, !m_hurried);
    if (m_stale) schedule();
}

} // namespace carom

#include "moc_picture_schedule.cpp"
