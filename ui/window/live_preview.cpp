// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/live_preview.h"

#include "ui/player/simulation.h"
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
    : QObject(parent), m_simulation(simulation), m_viewport(viewport) {
    connect(&simulation, &Simulation::landed, this, &LivePreview::land);
}

void LivePreview::take(const SharedBuild& result) {
    const int errors = errorCount(result);
    if (errors > 0 && !result->fresh) {
        const QString badge = errors == 1
                                  ? tr("1 error: the last scene without errors is shown")
                                  : tr("%1 errors: the last scene without errors is shown").arg(errors);
        m_viewport.setDimmed(true, badge);
        Q_EMIT noticeChanged(badge);
        return;
    }
    m_viewport.setDimmed(false, {});
    const SharedBuild& newest = m_coming ? m_coming : m_shown;
    if (!result->fresh && newest && newest->meaning == result->meaning) {
        m_viewport.forgetDrag(); // one that was taken back
        if (!m_coming) Q_EMIT noticeChanged({});
        return;
    }
    if (result->fresh || m_simulation.isAtStart()) {
        show(result);
        Q_EMIT noticeChanged(errors == 0 ? QString()
                             : errors == 1
                                 ? tr("1 error: the declaration it is in is left out")
                                 : tr("%1 errors: the declarations they are in are left out").arg(errors));
        return;
    }
    m_coming = result;
    Q_EMIT noticeChanged(tr("Simulating the changed scene to %1 s…").arg(m_simulation.time(), 0, 'f', 3));
    m_simulation.exchange(result->build.pipeline);
}

void LivePreview::noteCancelled() {
    const QString badge = tr("Building was cancelled: this is the scene before it");
    m_viewport.setDimmed(true, badge);
    Q_EMIT noticeChanged(badge);
}

void LivePreview::giveUpComing() {
    if (!m_coming) return;
    show(std::exchange(m_coming, nullptr));
    Q_EMIT noticeChanged({});
}

void LivePreview::reset() {
    if (!m_coming) {
        m_simulation.reset();
        return;
    }
    show(m_coming);
    Q_EMIT noticeChanged({});
}

void LivePreview::show(SharedBuild result) {
    m_shown = std::move(result);
    m_coming.reset();
    m_viewport.showPipeline(m_shown->build.pipeline);
    m_simulation.load(m_shown->build.pipeline);
    Q_EMIT shownChanged(m_shown);
}

void LivePreview::land() {
    if (!m_coming) return; // somebody else exchanged the scene for itself
    m_shown = std::move(m_coming);
    m_coming.reset();
    m_viewport.showPipeline(m_shown->build.pipeline);
    Q_EMIT shownChanged(m_shown);
    Q_EMIT noticeChanged({});
}

} // namespace carom

#include "moc_live_preview.cpp"
