// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/window/workbench.h"

#include <QObject>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace carom {

/// Leaves the IDE after so many rendered frames, with the window as a picture where one is asked for and the
/// times of simulating and rendering on standard output. The first of each is counted apart: it pays for
/// memory, caches and shaders that every later one finds ready.
class TimedSession : public QObject {
    Q_OBJECT
  public:
    TimedSession(const Workbench& workbench, std::int64_t frames, std::optional<std::string> screenshot);

  private:
    void noteRendered(double milliseconds);
    void leave(int exitCode);

    const Workbench& m_workbench;
    std::int64_t m_frames;
    std::optional<std::string> m_screenshot;
    std::vector<double> m_simulate; ///< [ms] a frame
    std::vector<double> m_render;   ///< [ms] a frame
    bool m_left = false;
};

/// False, and a message on standard error, where the file cannot be written.
bool saveWindow(const Workbench& workbench, const std::string& path);

} // namespace carom
