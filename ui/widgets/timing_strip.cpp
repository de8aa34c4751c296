// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/timing_strip.h"

#include <QImage>
#include <QKeyEvent>
#include <QPainter>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

/// Frames that are kept with the smallest budget: a wide screen shows as many; at half it would be half
/// empty.
constexpr std::size_t leastSamples = 4000;
/// The upper end of the scale of Budget [ms]: a fifth above the line of 1/30 s; below it the line is not
/// shown.
constexpr double budgetScale = 40;
constexpr int labelMargin = 4;   // [px]
constexpr int widestColumn = 16; // [px]
constexpr int notch = 120;       // [eighths of a degree] of a wheel

/// The next of 1, 2, 5 times a power of ten that is not below x.
double roundedUp(double x) {
    const double power = std::pow(10, std::floor(std::log10(x)));
    for (const double step : {1.0, 2.0, 5.0})
        if (step * power >= x) return step * power;
    return 10 * power;
}

QString milliseconds(double value) { return QString::number(value, 'f', value < 10 ? 3 : 1); }

} // namespace

std::array<int, framePartCount> stackedRows(const FrameSample& sample, double fullScale, int height,
                                            const HiddenParts& hidden) {
    std::array<int, framePartCount> rows{};
    double sum = 0;
    int below = 0;
    for (std::size_t i = 0; i < framePartCount; ++i) {
        if (!hidden[i]) sum += frameParts()[i].milliseconds(sample);
        const int boundary = static_cast<int>(std::lround(std::clamp(sum / fullScale, 0.0, 1.0) * height));
        rows[i] = boundary - below;
        below = boundary;
    }
    return rows;
}

QString breakdownOf(const FrameSample& sample) {
    QString text = TimingStrip::tr("frame %1, %2 s: %3 ms")
                       .arg(sample.statistics.frame)
                       .arg(sample.statistics.time, 0, 'f', 3)
                       .arg(milliseconds(totalOf(sample)));
    for (const FramePart& part : frameParts())
        text += QStringLiteral("\n%1 %2 ms").arg(nameOf(part), milliseconds(part.milliseconds(sample)));
    return text;
}

TimingStrip::TimingStrip(QWidget* parent) : ScrubStrip(parent) {
    setFocusPolicy(Qt::StrongFocus);
    setAttribute(Qt::WA_OpaquePaintEvent);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    setAccessibleName(tr("Frame times"));
}

void TimingStrip::addSamples(std::span<const FrameSample> samples) {
    if (samples.empty()) return;
    samples = samples.last(std::min(samples.size(), m_most));
    makeRoom(samples.size());
    m_samples.insert(m_samples.end(), samples.begin(), samples.end());
    // Who has scrolled back keeps looking at the same frames.
    if (m_scrolledBack > 0) m_scrolledBack += static_cast<std::ptrdiff_t>(samples.size());
    scrollTo(m_scrolledBack);
}

/// The oldest half goes where there would be too many; never is there room for more than may be.
void TimingStrip::makeRoom(std::size_t more) {
    if (m_samples.size() + more > m_most) {
        const std::size_t kept = std::min({m_samples.size(), m_most / 2, m_most - more});
        const std::ptrdiff_t dropped = static_cast<std::ptrdiff_t>(m_samples.size() - kept);
        m_samples.erase(m_samples.begin(), m_samples.begin() + dropped);
        m_picked = std::max(m_picked - dropped, noFrame);
    }
    const std::size_t needed = m_samples.size() + more;
    if (needed > m_samples.capacity())
        m_samples.reserve(std::min(m_most, std::max(needed, 2 * m_samples.capacity())));
}

void TimingStrip::scrollTo(std::ptrdiff_t back) {
    const std::ptrdiff_t most = std::max<std::ptrdiff_t>(count() - columns() * m_perColumn, 0);
    m_scrolledBack = std::clamp<std::ptrdiff_t>(back, 0, most);
    rescale();
    update();
}

void TimingStrip::zoom(bool in, int x) {
    const auto back = [&] { return (width() - 1 - x) / m_columnWidth * m_perColumn; };
    const std::ptrdiff_t place = m_scrolledBack + back(); // frames from the newest to x
    if (in && m_perColumn > 1)
        m_perColumn /= 2;
    else if (in)
        m_columnWidth = std::min(2 * m_columnWidth, widestColumn);
    else if (m_columnWidth > 1)
        m_columnWidth /= 2;
    else if (columns() * m_perColumn < count())
        m_perColumn *= 2;
    // Who looks at the newest frames goes on seeing them come.
    scrollTo(m_scrolledBack == 0 && !in ? 0 : place - back());
}

void TimingStrip::setBudget(std::size_t bytes) {
    m_most = std::clamp(bytes / sizeof(FrameSample), leastSamples, mostSamples);
    if (m_samples.capacity() <= m_most) return;
    if (m_samples.size() > m_most) makeRoom(0);
    m_samples.shrink_to_fit();
    scrollTo(m_scrolledBack);
}

void TimingStrip::showFrame(std::int64_t frame) {
    if (frame == m_frame) return;
    m_frame = frame;
    update();
}

std::optional<int> TimingStrip::cursor() const {
    // Frames ascend, but need not follow each other.
    const auto place = std::lower_bound(
        m_samples.begin(), m_samples.end(), m_frame,
        [](const FrameSample& sample, std::int64_t frame) { return sample.statistics.frame < frame; });
    if (place == m_samples.end() || place->statistics.frame != m_frame) return std::nullopt;
    const std::ptrdiff_t fromRight = lastColumn() - (place - m_samples.begin()) / m_perColumn;
    const std::ptrdiff_t x = width() - 1 - fromRight * m_columnWidth - m_columnWidth / 2;
    if (fromRight < 0 || x < 0) return std::nullopt;
    return static_cast<int>(x);
}

void TimingStrip::clear() {
    m_samples = std::vector<FrameSample>(); // its memory goes, too
    m_picked = noFrame;
    m_scrolledBack = 0;
    rescale();
    update();
}

void TimingStrip::setScale(Scale scale) {
    m_scale = scale;
    rescale();
    update();
}

void TimingStrip::showPart(std::size_t part, bool shown) {
    m_hidden[part] = !shown;
    rescale();
    update();
}

/// Height of its column [ms].
double TimingStrip::shownOf(const FrameSample& sample) const {
    double sum = 0;
    for (std::size_t i = 0; i < framePartCount; ++i)
        if (!m_hidden[i]) sum += frameParts()[i].milliseconds(sample);
    return sum;
}

void TimingStrip::setColumnWidth(int pixels) {
    m_columnWidth = std::clamp(pixels, 1, widestColumn);
    m_perColumn = 1;
    scrollTo(m_scrolledBack);
}

void TimingStrip::pick(std::ptrdiff_t index) {
    if (index < 0 || index >= static_cast<std::ptrdiff_t>(m_samples.size())) index = noFrame;
    if (index == m_picked) return;
    m_picked = index;
    update();
    Q_EMIT framePicked(index);
}

/// Columns are counted from the right edge, so that a width that is no multiple leaves its rest at the left.
std::ptrdiff_t TimingStrip::frameAt(int x) const {
    if (x < 0 || x >= width() || m_samples.empty()) return noFrame;
    const std::ptrdiff_t column = lastColumn() - (width() - 1 - x) / m_columnWidth;
    return column < 0 ? noFrame : slowestOf(column);
}

std::ptrdiff_t TimingStrip::slowestOf(std::ptrdiff_t column) const {
    const std::ptrdiff_t first = column * m_perColumn;
    if (m_perColumn == 1) return first;
    const auto begin = m_samples.begin() + first,
               end = m_samples.begin() + std::min(first + m_perColumn, count());
    const auto isSlower = [this](const FrameSample& a, const FrameSample& b) {
        return shownOf(a) < shownOf(b);
    };
    return std::max_element(begin, end, isSlower) - m_samples.begin();
}

void TimingStrip::rescale() {
    double highest = 0;
    const std::ptrdiff_t last = m_samples.empty() ? -1 : lastColumn();
    const std::ptrdiff_t first = std::max<std::ptrdiff_t>((last + 1 - columns()) * m_perColumn, 0);
    for (std::ptrdiff_t i = first; i < std::min((last + 1) * m_perColumn, count()); ++i) {
        const FrameSample& sample = m_samples[static_cast<std::size_t>(i)];
        // The first frame also pays for what is made once; it may leave the picture.
        if (sample.statistics.frame > 1) highest = std::max(highest, shownOf(sample));
    }
    const double needed = std::max(1.05 * highest, 1e-3);
    m_fullScale = m_scale == Scale::Budget && needed <= budgetScale ? budgetScale : roundedUp(needed);
}

void TimingStrip::paintColumns(QImage& image, double pixelRatio) const {
    const int columnWidth = std::max(1, static_cast<int>(std::lround(m_columnWidth * pixelRatio)));
    std::array<QRgb, framePartCount> colours{};
    for (std::size_t i = 0; i < framePartCount; ++i) colours[i] = frameParts()[i].colour.rgb();
    const QRgb pickedColour = palette().color(QPalette::Text).rgb();

    std::ptrdiff_t column = m_samples.empty() ? -1 : lastColumn();
    for (int right = image.width(); right > 0 && column >= 0; right -= columnWidth, --column) {
        const int left = std::max(0, right - columnWidth);
        const std::ptrdiff_t index = slowestOf(column);
        const std::array<int, framePartCount> rows =
            stackedRows(m_samples[static_cast<std::size_t>(index)], m_fullScale, image.height(), m_hidden);
        int y = image.height();
        for (std::size_t part = 0; part < framePartCount; ++part) {
            for (int row = 0; row < rows[part]; ++row) {
                QRgb* line = reinterpret_cast<QRgb*>(image.scanLine(--y));
                std::fill(line + left, line + right, colours[part]);
            }
        }
        if (m_picked != noFrame && m_picked / m_perColumn == column)
            while (y > 0) {
                QRgb* line = reinterpret_cast<QRgb*>(image.scanLine(--y));
                std::fill(line + left, line + right, pickedColour);
            }
    }
}

void TimingStrip::paintLines(QPainter& painter) const {
    const QColor text = palette().color(QPalette::Text);
    QColor line = text;
    line.setAlpha(170);
    const QFontMetrics metrics = painter.fontMetrics();
    // On a large scale the lines lie close together: a label that would cover another stands beside it.
    QRect last;
    const auto label = [&](const QString& words, int y) {
        QRect box(labelMargin, std::max(y - metrics.height() - 1, 0), metrics.horizontalAdvance(words) + 6,
                  metrics.height());
        if (box.intersects(last)) box.moveLeft(last.right() + labelMargin);
        last = box;
        QColor ground = palette().color(QPalette::Base);
        ground.setAlpha(190);
        painter.fillRect(box, ground);
        painter.setPen(text);
        painter.drawText(box, Qt::AlignCenter, words);
    };
    for (const FrameBudget& budget : frameBudgets) {
        if (budget.milliseconds > m_fullScale) continue;
        const int y = static_cast<int>(std::lround(height() * (1 - budget.milliseconds / m_fullScale)));
        painter.setPen(QPen(line, 1, Qt::DashLine));
        painter.drawLine(0, y, width(), y);
        label(QStringLiteral("%1  %2 ms")
                  .arg(QLatin1StringView(budget.name))
                  .arg(budget.milliseconds, 0, 'f', 1),
              y);
    }
    if (m_fullScale < frameBudgets.front().milliseconds)
        label(tr("%1 ms; the line of 1/60 s lies %2 times higher")
                  .arg(m_fullScale)
                  .arg(frameBudgets.front().milliseconds / m_fullScale, 0, 'g', 2),
              0);
}

void TimingStrip::paintEvent(QPaintEvent*) {
    const double pixelRatio = devicePixelRatioF();
    QImage image(size() * pixelRatio, QImage::Format_RGB32);
    image.fill(palette().color(QPalette::Base));
    paintColumns(image, pixelRatio);
    image.setDevicePixelRatio(pixelRatio);
    QPainter painter(this);
    painter.drawImage(0, 0, image);
    paintLines(painter);
    if (const std::optional<int> x = cursor()) {
        painter.setPen(QPen(palette().color(QPalette::Highlight), 1));
        painter.drawLine(*x, 0, *x, height());
    }
    if (m_samples.empty()) {
        painter.setPen(palette().color(QPalette::PlaceholderText));
        painter.drawText(rect().adjusted(8, 4, -8, -4), Qt::AlignRight | Qt::AlignBottom,
                         tr("Run the simulation to see the time of every frame"));
    }
    if (hasFocus()) {
        painter.setPen(palette().color(QPalette::Highlight));
        painter.drawRect(rect().adjusted(0, 0, -1, -1));
    }
}

void TimingStrip::wheelEvent(QWheelEvent* event) {
    const bool along = event->modifiers().testFlag(Qt::ShiftModifier) ||
                       event->angleDelta().x() != 0; // of a wheel that tilts, or a touch pad
    const int turned = event->angleDelta().y() + event->angleDelta().x();
    constexpr std::ptrdiff_t columnsANotch = 30;
    if (along)
        scrollTo(m_scrolledBack + turned * columnsANotch * m_perColumn / notch);
    else if (turned != 0)
        zoom(turned > 0, static_cast<int>(event->position().x()));
    event->accept();
}

void TimingStrip::mousePressEvent(QMouseEvent* event) {
    if (event->button() == Qt::RightButton || event->button() == Qt::MiddleButton) {
        m_moving.emplace(event->position().x(), m_scrolledBack);
        setCursor(Qt::ClosedHandCursor);
    } else if (!m_moving) {
        ScrubStrip::mousePressEvent(event);
    }
}

void TimingStrip::mouseMoveEvent(QMouseEvent* event) {
    if (!m_moving) return ScrubStrip::mouseMoveEvent(event);
    const double columns = (event->position().x() - m_moving->first) / m_columnWidth;
    scrollTo(m_moving->second + std::llround(columns * static_cast<double>(m_perColumn)));
}

void TimingStrip::mouseReleaseEvent(QMouseEvent* event) {
    if (m_moving && (event->buttons() & (Qt::RightButton | Qt::MiddleButton)) == 0) {
        m_moving.reset();
        unsetCursor();
    }
    ScrubStrip::mouseReleaseEvent(event);
}

void TimingStrip::resizeEvent(QResizeEvent* event) {
    ScrubStrip::resizeEvent(event);
    scrollTo(m_scrolledBack);
}

void TimingStrip::keyPressEvent(QKeyEvent* event) {
    const std::ptrdiff_t last = count() - 1, page = columns() * m_perColumn;
    switch (event->key()) {
    case Qt::Key_Left:
        return pick(m_picked == noFrame ? last : std::max<std::ptrdiff_t>(m_picked - 1, 0));
    case Qt::Key_Right:
        return pick(m_picked == noFrame ? last : std::min(m_picked + 1, last));
    case Qt::Key_Plus:
    case Qt::Key_Minus:
        return zoom(event->key() == Qt::Key_Plus);
    case Qt::Key_PageUp:
        return scrollTo(m_scrolledBack + page);
    case Qt::Key_PageDown:
        return scrollTo(m_scrolledBack - page);
    case Qt::Key_Home:
        return scrollTo(count());
    case Qt::Key_End:
        return scrollTo(0);
    default:
        QWidget::keyPressEvent(event);
    }
}

QString TimingStrip::tellOf(double x) const {
    const std::ptrdiff_t index = frameAt(static_cast<int>(x));
    return index == noFrame ? QString() : breakdownOf(m_samples[static_cast<std::size_t>(index)]);
}

} // namespace carom

#include "moc_timing_strip.cpp"
