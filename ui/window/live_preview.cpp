// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/live_preview.h"

#include "ui/simulation/simulation.h"
#include "ui/viewport/viewport.h"

#include <algorithm>
#include <utility>

namespace carom {
namespace {

int errorCount(const SharedBuild& result) {
    const std::vector<Diagnostic>& all = result->build.diagnostics;
    return static_cast<int>(std::count_if(
        all.begin(), all.end(), [](const Diagnostic& d) { return d.severity() == Severity::Error; }));
}

} // namespace

LivePreview::LivePreview(Simulation& simulation, Viewport& viewport, QObject* parent)
    : QObject(parent), m_simulation(simulation), m_viewport(viewport) {}

void LivePreview::take(const SharedBuild& result) {
    const int errors = errorCount(result);
    if (errors > 0 && !result->fresh) {
        const QString badge = errors == 1 ? tr("1 error: the last scene without is shown")
                                          : tr("%1 errors: the last scene without is shown").arg(errors);
        m_viewport.setDimmed(true, badge);
        Q_EMIT noticeChanged(badge);
        return;
    }
    m_viewport.setDimmed(false, {});
    if (result->fresh || m_simulation.isAtStart()) {
        show(result);
        Q_EMIT noticeChanged(errors == 0 ? QString()
                             : errors == 1
                                 ? tr("1 error: the declaration it is in is left out")
                                 : tr("%1 errors: the declarations they are in are left out").arg(errors));
        return;
    }
    m_waiting = result;
    Q_EMIT noticeChanged(tr("The text has changed: Reset (Shift+F5) shows it"));
}

void LivePreview::reset() {
    if (!m_waiting) {
        m_simulation.reset();
        return;
    }
    show(m_waiting);
    Q_EMIT noticeChanged({});
}

void LivePreview::show(SharedBuild result) {
    m_shown = std::move(result);
    m_waiting.reset();
    m_viewport.showPipeline(m_shown->build.pipeline);
    m_simulation.load(m_shown->build.pipeline);
    Q_EMIT shownChanged(m_shown);
}

} // namespace carom
