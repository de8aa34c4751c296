// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/timed_session.h"

#include "app/errors.h"
#include "app/files.h"
#include "core/math/statistics.h"
#include "ui/base/file_output.h"
#include "ui/player/simulation.h"
#include "ui/viewport/viewport.h"
#include "ui/window/main_window.h"

#include <QCoreApplication>
#include <QPixmap>
#include <QTimer>

#include <cstdio>
#include <span>

namespace carom {
namespace {

void printRow(const char* name, std::span<const double> times) {
    if (times.empty()) {
        printOut(std::string(name) + "       no frame\n");
        return;
    }
    const Summary later = summarise(times.subspan(1));
    char row[160];
    std::snprintf(row, sizeof row, "%-10s %7zu %9.3f %9.3f %9.3f %9.3f %9.3f %9.3f\n", name, times.size(),
                  times.front(), later.mean, later.median, later.p95, later.p99, later.maximum);
    printOut(row);
}

} // namespace

TimedSession::TimedSession(const Workbench& workbench, std::int64_t frames,
                           std::optional<std::string> screenshot)
    : m_workbench(workbench), m_frames(frames), m_screenshot(std::move(screenshot)) {
    connect(&workbench.simulation(), &Simulation::framesArrived, this,
            [this](const std::vector<FrameStatistics>& batch) {
                for (const FrameStatistics& frame : batch) m_simulate.push_back(frame.simulate);
            });
    connect(&workbench.window().viewport(), &Viewport::frameRendered, this, &TimedSession::noteRendered);
    connect(&workbench.window().viewport(), &Viewport::failed, this, [this](const QString& problem) {
        printError("carom: " + problem.toStdString() + "\n");
        leave(exitcode::wrongUsage);
    });
    // A run that ends by itself renders no more frames: what there is counts.
    connect(&workbench.simulation(), &Simulation::stateChanged, this, [this](const RunStatus& status) {
        if (status.state == RunState::Stopped) leave(exitcode::unphysical);
        if (status.state == RunState::Paused) leave(exitcode::done);
    });
}

void TimedSession::noteRendered(double milliseconds) {
    if (m_left) return; // the picture for the file is drawn once more
    m_render.push_back(milliseconds);
    if (static_cast<std::int64_t>(m_render.size()) == m_frames)
        QTimer::singleShot(0, this, [this] { leave(exitcode::done); }); // not from inside a paint event
}

void TimedSession::leave(int exitCode) {
    if (m_left) return;
    m_left = true;
    const bool saved = !m_screenshot || saveWindow(m_workbench, *m_screenshot);
    try { // exceptions must not pass through Qt's event loop, which calls this
        printOut("[ms]        frames     first      mean    median       p95       p99       max\n");
        printRow("simulate", m_simulate);
        printRow("render", m_render);
        QCoreApplication::exit(saved ? exitCode : exitcode::fileError);
    } catch (const FileError& error) {
        if (!error.isBrokenPipe()) printError(std::string("carom: ") + error.what() + "\n");
        QCoreApplication::exit(exitcode::fileError);
    }
}

bool saveWindow(const Workbench& workbench, const std::string& path) {
    const QString problem = saveImage(QString::fromStdString(path), workbench.window().grab().toImage());
    if (!problem.isEmpty()) printError("carom: " + problem.toStdString() + "\n");
    return problem.isEmpty();
}

} // namespace carom
