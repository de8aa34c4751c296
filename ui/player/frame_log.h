// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/player/sample_queue.h"

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
    /// A picture is there. It was drawn while the newest frames were simulated, and counts for the newest.
    void noteRendered(double milliseconds);

  Q_SIGNALS:
    void samplesReady(const std::vector<carom::FrameSample>& samples);

  private:
    void passOn();

    std::vector<FrameSample> m_waiting;
    double m_rendered = 0; ///< [ms], by a picture that no frame has been given yet
};

} // namespace carom
