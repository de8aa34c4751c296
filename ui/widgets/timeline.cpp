// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/timeline.h"

#include "ui/base/numbers.h"

#include <QKeyEvent>
#include <QPainter>

#include <algorithm>
#include <cmath>
#include <utility>

namespace carom {
namespace {

constexpr double margin = 14;   // [px] left and right of the line
constexpr double lineY = 19;    // [px] from the top
constexpr double tallest = 12;  // [px] of the impacts above the line
constexpr double leastTime = 2; // [s] of the scale at least; at a tenth it changes all the time at the start
constexpr std::int64_t bigStep = 10; // frames that Page Up and Page Down move

/// The next of 1, 2, 5, 10, 20, … that is at least `value`.
double roundUp(double value) {
    const double power = std::pow(10, std::floor(std::log10(value)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= value) return factor * power;
    return 10 * power;
}

bool contains(const std::vector<std::int64_t>& frames, std::int64_t frame) {
    return std::find(frames.begin(), frames.end(), frame) != frames.end();
}

/// A run that is played again comes to its marks again.
void addOnce(std::vector<std::int64_t>& frames, std::int64_t frame) {
    if (!contains(frames, frame)) frames.push_back(frame);
}

} // namespace

Timeline::Timeline(QWidget* parent) : ScrubStrip(parent) {
    setObjectName(QStringLiteral("timeline"));
    setAccessibleName(tr("Timeline"));
    setFocusPolicy(Qt::ClickFocus);
    setMouseTracking(true);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void Timeline::restart(double step, std::optional<double> duration) {
    m_step = step;
    m_duration = duration;
    m_touching = 0;
    m_impacts.clear();
    m_warnings.clear();
    m_hits.clear();
    m_failures.clear();
    update();
}

void Timeline::addFrames(const std::vector<FrameStatistics>& frames) {
    for (const FrameStatistics& frame : frames) {
        if (frame.frame <= furthest()) continue;
        m_impacts.add(frame.contacts > m_touching ? static_cast<double>(frame.contacts - m_touching) : 0);
        m_touching = frame.contacts;
    }
    update();
}

void Timeline::showFrame(std::int64_t frame) {
    m_frame = frame;
    update();
}

void Timeline::markWarning(std::int64_t frame) {
    addOnce(m_warnings, frame);
    update();
}

void Timeline::markHit(std::int64_t frame) {
    addOnce(m_hits, frame);
    update();
}

void Timeline::setFailures(std::vector<std::int64_t> frames) {
    if (frames == m_failures) return;
    m_failures = std::move(frames);
    update();
}

void Timeline::setTheme(const Theme& theme) {
    m_theme = theme;
    update();
}

std::int64_t Timeline::end() const {
    const std::int64_t reached = std::max(furthest(), m_frame);
    const double scale = roundUp(std::max(leastTime, static_cast<double>(reached) * m_step));
    const double time = m_duration ? std::max(*m_duration, static_cast<double>(reached) * m_step) : scale;
    return std::max<std::int64_t>(1, std::llround(time / m_step));
}

std::uint64_t Timeline::impactsIn(std::int64_t frame) const {
    return frame < 1 || frame > furthest() ? 0 : static_cast<std::uint64_t>(m_impacts.at(frame - 1).high);
}

double Timeline::xOf(std::int64_t frame) const {
    return margin + (width() - 2 * margin) * static_cast<double>(frame) / static_cast<double>(end());
}

std::int64_t Timeline::frameAt(double x) const {
    const double share = (x - margin) / std::max(1.0, width() - 2 * margin);
    return std::llround(std::clamp(share, 0.0, 1.0) * static_cast<double>(end()));
}

void Timeline::seekTo(std::int64_t frame) {
    const std::int64_t wanted = std::clamp<std::int64_t>(frame, 0, end());
    if (wanted == m_frame) return;
    showFrame(wanted);
    Q_EMIT seeked(wanted);
}

/// The nearest bar above the line or mark below it, within reach of the mouse.
std::optional<std::int64_t> Timeline::eventAt(const QPointF& position) const {
    constexpr double reach = 5, lineHeight = 5; // [px]
    const double below = position.y() - lineY;
    if (std::abs(below) < lineHeight) return std::nullopt;
    std::optional<std::int64_t> nearest;
    double least = reach;
    const auto look = [&](std::int64_t frame) {
        const double distance = std::abs(xOf(frame) - position.x());
        if (distance >= least) return;
        least = distance;
        nearest = frame;
    };
    if (below > 0) {
        for (const std::vector<std::int64_t>* marks : {&m_failures, &m_warnings, &m_hits})
            for (const std::int64_t frame : *marks) look(frame);
    } else {
        for (const SeriesStretch& stretch : m_impacts.stretches())
            if (stretch.high > 0) look(stretch.highAt + 1);
    }
    return nearest;
}

void Timeline::mousePressEvent(QMouseEvent* event) {
    const std::optional<std::int64_t> mark =
        event->button() == Qt::LeftButton ? eventAt(event->position()) : std::nullopt;
    if (!mark) {
        ScrubStrip::mousePressEvent(event);
        return;
    }
    showFrame(*mark);
    if (contains(m_failures, *mark))
        Q_EMIT failureClicked(*mark);
    else
        Q_EMIT eventClicked(*mark);
}

void Timeline::keyPressEvent(QKeyEvent* event) {
    switch (event->key()) {
    case Qt::Key_Left:
        return seekTo(m_frame - 1);
    case Qt::Key_Right:
        return seekTo(m_frame + 1);
    case Qt::Key_PageUp:
        return seekTo(m_frame - bigStep);
    case Qt::Key_PageDown:
        return seekTo(m_frame + bigStep);
    case Qt::Key_Home:
        return seekTo(0);
    case Qt::Key_End:
        return seekTo(furthest());
    default:
        QWidget::keyPressEvent(event);
    }
}

QString Timeline::tellOf(double x) const {
    const std::int64_t frame = frameAt(x);
    QString text = tr("frame %1, %2 s").arg(frame).arg(static_cast<double>(frame) * m_step, 0, 'f', 3);
    if (frame > furthest()) text += tr(" (not simulated yet)");
    if (impactsIn(frame) > 0)
        text += (m_impacts.length() > 1 ? tr("\nup to %1 new contacts a frame") : tr("\n%1 new contacts"))
                    .arg(impactsIn(frame));
    if (contains(m_warnings, frame)) text += tr("\nthe run went wrong here");
    if (contains(m_hits, frame)) text += tr("\na breakpoint held");
    if (contains(m_failures, frame)) text += tr("\nan expectation failed");
    return text;
}

// One bar a column of pixels, as high as the most new contacts in the frames it stands for.
void Timeline::paintImpacts(QPainter& painter) const {
    std::vector<double> columns(static_cast<std::size_t>(std::max(1, width())), 0);
    double most = 1;
    for (const SeriesStretch& stretch : m_impacts.stretches()) {
        const double x = std::clamp(xOf(stretch.highAt + 1), 0.0, static_cast<double>(width() - 1));
        double& column = columns[static_cast<std::size_t>(x)];
        column = std::max(column, stretch.high);
        most = std::max(most, column);
    }
    painter.setPen(m_theme.hint);
    for (std::size_t x = 0; x < columns.size(); ++x) {
        if (columns[x] == 0) continue;
        const double share = std::log1p(columns[x]) / std::log1p(most);
        const QPointF foot(static_cast<double>(x) + 0.5, lineY - 3);
        painter.drawLine(foot, foot - QPointF(0, 3 + (tallest - 3) * share));
    }
}

void Timeline::paintMarks(QPainter& painter, const std::vector<std::int64_t>& frames,
                          const QColor& colour) const {
    painter.setPen(Qt::NoPen);
    painter.setBrush(colour);
    for (const std::int64_t frame : frames) {
        const double x = xOf(frame);
        const QPointF triangle[] = {{x, lineY + 3}, {x - 4.5, lineY + 11}, {x + 4.5, lineY + 11}};
        painter.drawPolygon(triangle, 3);
    }
}

/// Crosses, as in the editor's margin.
void Timeline::paintFailures(QPainter& painter) const {
    painter.setPen(QPen(m_theme.error, 2.2, Qt::SolidLine, Qt::RoundCap));
    for (const std::int64_t frame : m_failures) {
        const double x = xOf(frame), y = lineY + 8, arm = 3.5;
        painter.drawLine(QPointF(x - arm, y - arm), QPointF(x + arm, y + arm));
        painter.drawLine(QPointF(x - arm, y + arm), QPointF(x + arm, y - arm));
    }
}

void Timeline::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.fillRect(rect(), m_theme.panel);
    painter.fillRect(0, 0, width(), 1, m_theme.border);
    paintImpacts(painter);
    painter.setRenderHint(QPainter::Antialiasing);
    const auto line = [&](std::int64_t from, std::int64_t to, const QColor& colour, double thickness) {
        painter.setPen(QPen(colour, thickness, Qt::SolidLine, Qt::RoundCap));
        painter.drawLine(QPointF(xOf(from), lineY), QPointF(xOf(to), lineY));
    };
    line(0, end(), m_theme.border, 3);
    line(0, std::max(furthest(), m_frame), m_theme.mutedText, 3);
    line(0, m_frame, m_theme.accent, 3);
    paintMarks(painter, m_warnings, m_theme.error);
    paintMarks(painter, m_hits, m_theme.warning);
    paintFailures(painter);

    QFont small = font();
    small.setPointSizeF(small.pointSizeF() * 0.8);
    painter.setFont(small);
    painter.setPen(m_theme.mutedText);
    const QRectF below(margin - 4, lineY + 8, width() - 2 * margin + 8, height() - lineY - 8);
    painter.drawText(below, Qt::AlignLeft | Qt::AlignVCenter, tr("0 s"));
    painter.drawText(below, Qt::AlignRight | Qt::AlignVCenter,
                     tr("%1 s").arg(rounded(static_cast<double>(end()) * m_step, 4)));

    painter.setPen(QPen(m_theme.panel, 1.5));
    painter.setBrush(hasFocus() ? m_theme.accent : m_theme.text);
    painter.drawEllipse(QPointF(xOf(m_frame), lineY), 6, 6);
}

} // namespace carom

#include "moc_timeline.cpp"
