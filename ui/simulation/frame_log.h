// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/simulation/sample_queue.h"

#include <QObject>

#include <cstdint>
#include <vector>

namespace carom {

/// Brings together what the two threads measured of a frame: the simulation's samples and the time it took to
/// draw those that were drawn. A batch is passed on once its picture is on screen, or when the next one
/// comes.
class FrameLog : public QObject {
    Q_OBJECT
  public:
    using QObject::QObject;

    void clear();
    void addFrames(const std::vector<FrameStatistics>& frames);
    /// This frame is what the viewport draws next.
    void noteShown(std::int64_t frame) { m_shown = frame; }
    void noteRendered(double milliseconds);

  Q_SIGNALS:
    void samplesReady(const std::vector<carom::FrameSample>& samples);

  private:
    void passOn();

    std::vector<FrameSample> m_waiting;
    std::int64_t m_shown = 0;
};

} // namespace carom
