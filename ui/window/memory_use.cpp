// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/memory_use.h"

#include "ui/base/pauses.h"
#include "ui/docks/plots_dock.h"
#include "ui/docks/timing_dock.h"
#include "ui/player/simulation.h"
#include "ui/widgets/timeline.h"
#include "ui/window/main_window.h"

#include <algorithm>

namespace carom {
namespace {

constexpr int refreshInterval = 500; // [ms]; at a tenth the figure changes too fast to be read

/// The part of the budget for frame times, one in so many: no other panel needs memory without a bound. At
/// half (one in two) checkpoints have less room; at twice the strip forgets sooner.
constexpr std::size_t timingShare = 4;
/// Memory of checkpoints at least, whatever the panels take [bytes]; at 0 there would be no seeking back.
constexpr std::size_t leastRecording = mebibyte;

QString inMebibytes(std::size_t bytes) {
    return QString::number(static_cast<double>(bytes) / static_cast<double>(mebibyte), 'f',
                           bytes < 10 * mebibyte ? 1 : 0);
}

} // namespace

MemoryUse::MemoryUse(MainWindow& window, Simulation& simulation)
    : QObject(&window), m_window(window), m_simulation(simulation) {
    m_refresh.setSingleShot(true);
    m_refresh.setInterval(pauseOf(refreshInterval));
    connect(&m_refresh, &QTimer::timeout, this, &MemoryUse::refresh);
    connect(&simulation, &Simulation::snapshotArrived, this, [this] {
        if (!m_refresh.isActive()) m_refresh.start();
    });
}

void MemoryUse::setBudget(std::size_t bytes) {
    m_budget = bytes;
    m_given = 0;
    m_window.timing().setBudget(m_budget / timingShare);
    refresh();
}

std::size_t MemoryUse::panels() const {
    return m_window.timing().bytes() + m_window.plots().bytes() + m_window.timeline().bytes();
}

std::size_t MemoryUse::inUse() const { return m_simulation.recorded() + panels(); }

std::size_t MemoryUse::left() const {
    return std::max(leastRecording, m_budget - std::min(m_budget, panels() + SampleQueue::mostBytes));
}

void MemoryUse::refresh() {
    const std::size_t whole = left() / mebibyte * mebibyte; // told when it has changed by as much
    if (whole != m_given) m_simulation.setMemoryBudget(whole);
    m_given = whole;
    m_window.showMemory(
        tr("%1 of %2 MiB").arg(inMebibytes(inUse()), inMebibytes(m_budget)),
        tr("Memory that this run takes, of the most it may (Preferences):\n"
           "states to go back to: %1 MiB\ntimes of frames: %2 MiB\ncurves: %3 MiB\ntimeline: %4 MiB\n"
           "When it is used up, states are kept further apart: nothing is lost, but going back takes longer.")
            .arg(inMebibytes(m_simulation.recorded()), inMebibytes(m_window.timing().bytes()),
                 inMebibytes(m_window.plots().bytes()), inMebibytes(m_window.timeline().bytes())));
}

} // namespace carom

#include "moc_memory_use.cpp"
