// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/docks/effects_dock.h"

#include "ui/widgets/empty_state.h"
#include "ui/widgets/frame_parts.h"

#include "core/base/catalogue.h"
#include "core/effects/effect.h"
#include "ui/base/pauses.h"
#include "ui/widgets/text_of.h"

#include <QCoreApplication>
#include <QScrollBar>
#include <QTextBrowser>
#include <QUrl>

#include <algorithm>

namespace carom {
namespace {

/// States of core, which speaks English. packaging/translate takes titles and sentences out of its sources.
[[maybe_unused]] constexpr const char* wordsOfCore[] = {
    QT_TRANSLATE_NOOP("carom::Core", "on"),
    QT_TRANSLATE_NOOP("carom::Core", "absent"),
    QT_TRANSLATE_NOOP("carom::Core", "not simulated yet"),
};

QString translatedHtml(std::string_view text) {
    return QCoreApplication::translate("carom::Core", std::string(text).c_str()).toHtmlEscaped();
}

QColor colourOf(EffectStatus status, const Theme& theme) {
    switch (status) {
    case EffectStatus::On:
        return theme.good;
    case EffectStatus::Absent:
        return theme.mutedText;
    case EffectStatus::NotSimulatedYet:
        return theme.warning;
    }
    return theme.text;
}

constexpr int refreshInterval = 500;      ///< [ms]; at a tenth times change too fast to be read
constexpr std::size_t framesCounted = 60; ///< of a second, at the default step; at a tenth means vary visibly

} // namespace

EffectsDock::EffectsDock(const Theme& theme, QWidget* parent)
    : Panel(tr("Effects"), parent), m_theme(theme), m_text(new QTextBrowser),
      m_state(new EmptyState(m_text, tr("The scene is empty.\nOnce there are bodies in it, this says which "
                                        "effects they call for, and why."))) {
    setObjectName(QStringLiteral("effects"));
    m_text->setOpenLinks(false);
    m_text->document()->setDocumentMargin(10);
    m_text->setAccessibleName(tr("Effects"));
    connect(m_text, &QTextBrowser::anchorClicked, this, [this](const QUrl& link) {
        const std::size_t number = link.toString().toULongLong();
        const std::optional<SourceRange>& source = m_result->build.pipeline->effects()[number].source;
        if (source) Q_EMIT placeActivated(*source);
    });
    setWidget(m_state);
    setFocusProxy(m_text);
    m_refresh.setSingleShot(true);
    m_refresh.setInterval(pauseOf(refreshInterval));
    connect(&m_refresh, &QTimer::timeout, this, [this] {
        if (m_result && isVisible()) fill();
    });
    connect(this, &QDockWidget::visibilityChanged, this, [this](bool visible) {
        if (visible && m_result) fill();
    });
}

void EffectsDock::show(const SharedBuild& result) {
    m_result = result;
    fill();
}

void EffectsDock::addSamples(std::span<const FrameSample> samples) {
    for (const FrameSample& sample : samples.last(std::min(samples.size(), framesCounted)))
        if (sample.statistics.frame > 1)
            m_frames.push_back(sample); // the first also pays for what is made once
    while (m_frames.size() > framesCounted) m_frames.pop_front();
    if (!m_refresh.isActive()) m_refresh.start();
}

void EffectsDock::clear() {
    m_frames.clear();
    if (!m_refresh.isActive()) m_refresh.start();
}

void EffectsDock::setTheme(const Theme& theme) {
    m_theme = theme;
    if (m_result) fill();
}

/// Title and state on one line, the reason below it, and where the text calls for the effect as a link.
QString EffectsDock::entry(const EffectDecision& decision, std::size_t number) const {
    const EffectRow* row = findByName(effects(), decision.effect);
    const QColor titleColour = decision.status == EffectStatus::Absent ? m_theme.mutedText : m_theme.text;
    QString html =
        QStringLiteral("<p style='margin:0 0 12px 0'><b style='color:%1'>%2</b>&nbsp; "
                       "<span style='color:%3'>%4</span><br><span style='color:%5'>%6</span>")
            .arg(titleColour.name(), translatedHtml(row != nullptr ? row->title : decision.effect),
                 colourOf(decision.status, m_theme).name(), translatedHtml(nameOf(decision.status)),
                 m_theme.mutedText.name(), sentences(decision.reason).toHtmlEscaped());
    if (decision.source) {
        const std::uint32_t line = m_result->build.analysis.positionOf(decision.source->offset).line;
        html += QStringLiteral(" <a style='color:%1;text-decoration:none' href='%2'>%3</a>")
                    .arg(m_theme.accent.name())
                    .arg(number)
                    .arg(tr("line %1").arg(line));
    }
    return html + QStringLiteral("</p>");
}

/// Means of the newest frames: the whole step, and each of its parts.
QString EffectsDock::frameTimes() const {
    if (m_frames.empty()) return {};
    const auto mean = [this](double (*milliseconds)(const FrameSample&)) {
        double sum = 0;
        for (const FrameSample& frame : m_frames) sum += milliseconds(frame);
        return QString::number(sum / static_cast<double>(m_frames.size()), 'f', 3);
    };
    QStringList parts;
    for (const FramePart& part : frameParts())
        if (!part.ofShownFrames)
            parts += QStringLiteral("%1&nbsp;%2").arg(nameOf(part).toHtmlEscaped(), mean(part.milliseconds));
    const QString whole = mean([](const FrameSample& frame) { return frame.statistics.simulate; });
    return QStringLiteral("<p><b style='color:%1'>%2</b><br><span style='color:%3'>%4</span></p>")
        .arg(m_theme.text.name(), tr("A frame takes %1 ms").arg(whole), m_theme.mutedText.name(),
             tr("%1; what is absent takes nothing").arg(parts.join(QStringLiteral(", "))));
}

void EffectsDock::fill() {
    QString html;
    const std::vector<EffectDecision>& decisions = m_result->build.pipeline->effects();
    for (std::size_t i = 0; i < decisions.size(); ++i) html += entry(decisions[i], i);
    html += frameTimes();
    const int scrolled = m_text->verticalScrollBar()->value();
    m_text->setHtml(html);
    m_text->verticalScrollBar()->setValue(scrolled);
    m_state->setEmpty(m_result->scene().bodies.empty());
}

} // namespace carom

#include "moc_effects_dock.cpp"
