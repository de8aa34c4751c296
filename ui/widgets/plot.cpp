// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/plot.h"

#include "ui/base/file_output.h"
#include "ui/widgets/plot_drawing.h"
#include "ui/widgets/qcustomplot_header.h"

#include <QBuffer>
#include <QCoreApplication>
#include <QEvent>
#include <QFileInfo>
#include <QFont>
#include <QFontMetrics>
#include <QLocale>
#include <QPdfWriter>
#include <QSvgGenerator>
#include <QToolTip>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace carom {

namespace {

/// [px] from a point at which the mouse is over it; at half it is hard to hit.
constexpr double pointReach = 12;
constexpr double clickSlack = 4; ///< [px] a click may move; at a quarter clicks are taken for drags
const QString cursorLayer = QStringLiteral("overlay"); // of QCustomPlot
/// Pixels of a PNG along a unit of the chart: sharp in print; at 1 letters are coarse.
constexpr int pngScale = 2;

struct PlotTexts {
    Q_DECLARE_TR_FUNCTIONS(Plot)
};

/// The font of charts in files: one that depends on no desktop, screen or setting, so that the same chart is
/// the same file whoever writes it.
QFont fontOfFiles() {
    constexpr int height = 12; // [units of the chart]
    QFont font(QStringLiteral("Sans Serif"));
    font.setPixelSize(height);
    font.setHintingPreference(QFont::PreferNoHinting);
    font.setStyleStrategy(QFont::NoSubpixelAntialias);
    font.setResolveMask(
        QFont::AllPropertiesResolved); // what is not said here is not the application's either
    return font;
}

QByteArray encoded(QCustomPlot& plot, const QString& ending, const QSize& size) {
    QByteArray bytes;
    QBuffer buffer(&bytes);
    buffer.open(QIODevice::WriteOnly);
    if (ending == QLatin1StringView("png")) {
        plot.toPixmap(size.width(), size.height(), pngScale).save(&buffer, "PNG");
    } else if (ending == QLatin1StringView("svg")) {
        QSvgGenerator svg;
        svg.setOutputDevice(&buffer);
        svg.setSize(size);
        svg.setViewBox(QRect(QPoint(0, 0), size));
        QCPPainter painter;
        painter.begin(&svg);
        painter.setFont(plot.font()); // else the application's, which the file names
        painter.setMode(QCPPainter::pmVectorized);
        painter.setMode(QCPPainter::pmNoCaching);
        plot.toPainter(&painter, size.width(), size.height());
        painter.end();
    } else {
        QPdfWriter pdf(&buffer);
        constexpr double pointsPerUnit = 0.75; // a unit is 1/96 inch
        pdf.setPageSize(QPageSize(QSizeF(size) * pointsPerUnit, QPageSize::Point));
        pdf.setPageMargins(QMarginsF());
        pdf.setResolution(96);
        QCPPainter painter;
        painter.begin(&pdf);
        painter.setMode(QCPPainter::pmVectorized);
        painter.setMode(QCPPainter::pmNoCaching);
        plot.toPainter(&painter, size.width(), size.height());
        painter.end();
    }
    return bytes;
}

} // namespace

QString writeChart(const ChartSpec& spec, const QString& path, const QSize& size) {
    const QString ending = QFileInfo(path).suffix().toLower();
    if (ending != QLatin1StringView("png") && ending != QLatin1StringView("svg") &&
        ending != QLatin1StringView("pdf"))
        return PlotTexts::tr("`%1` has no ending of a chart; name it .png, .svg or .pdf").arg(path);
    QCustomPlot plot;
    plot.setFont(fontOfFiles());
    plot.setLocale(QLocale::c());
    plot.resize(size);
    drawChart(plot, spec, {Qt::white, QColor(0x202428), QColor(0xDADDE2)});
    const QByteArray bytes = encoded(plot, ending, size);
    return saveFile(path, bytes);
}

PlotWidget::PlotWidget(QWidget* parent) : QWidget(parent), m_plot(new QCustomPlot(this)) {
    QVBoxLayout* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(m_plot);
    m_plot->setInteractions(QCP::iRangeDrag | QCP::iRangeZoom);
    m_plot->setMinimumSize(160, 100);
    connect(m_plot, &QCustomPlot::mouseDoubleClick, this, [this] {
        fitAxes(*m_plot, m_spec);
        m_plot->replot();
    });
    m_plot->setMouseTracking(true);
    connect(m_plot, &QCustomPlot::mouseMove, this, [this](const QMouseEvent* event) {
        const Hit hit = pointNear(event->position());
        if (const std::optional<Cell> cell = cellAt(event->position())) {
            QToolTip::showText(event->globalPosition().toPoint(), describe(*cell), m_plot);
            return;
        }
        if (hit.series < 0) {
            QToolTip::hideText();
            return;
        }
        const ChartSeries& series = m_spec.series[static_cast<std::size_t>(hit.series)];
        QToolTip::showText(event->globalPosition().toPoint(),
                           series.notes[static_cast<std::size_t>(hit.point)], m_plot);
    });
    connect(m_plot, &QCustomPlot::mousePress, this,
            [this](const QMouseEvent* event) { m_pressed = event->position(); });
    connect(m_plot, &QCustomPlot::mouseRelease, this, [this](const QMouseEvent* event) {
        if ((event->position() - m_pressed).manhattanLength() > clickSlack) return; // dragged
        const Hit hit = pointNear(event->position());
        if (const std::optional<Cell> cell = cellAt(event->position()))
            Q_EMIT cellClicked(static_cast<int>(cell->column), static_cast<int>(cell->row));
        else if (hit.series >= 0)
            Q_EMIT pointClicked(hit.series, hit.point);
        else if (event->button() == Qt::LeftButton && m_plot->axisRect()->rect().contains(event->pos()))
            Q_EMIT placeClicked(m_plot->xAxis->pixelToCoord(event->position().x()));
    });
    connect(m_plot, &QCustomPlot::afterLayout, this, [this] {
        const QRect axes = m_plot->axisRect()->rect();
        for (const auto& [axis, spec, length] : {std::tuple(m_plot->xAxis, &m_spec.x, axes.width()),
                                                 std::tuple(m_plot->yAxis, &m_spec.y, axes.height())})
            axis->setLabel(titleWithin(*spec, QFontMetrics(axis->labelFont()), length));
    });
    setChart({});
}

PlotWidget::Hit PlotWidget::pointNear(const QPointF& place) const {
    Hit nearest;
    double least = pointReach;
    for (std::size_t s = 0; s < m_spec.series.size(); ++s) {
        const ChartSeries& series = m_spec.series[s];
        for (std::size_t k = 0; k < std::min(series.notes.size(), series.x.size()); ++k) {
            if (!shows(m_spec.x, series.x[k]) || !shows(m_spec.y, series.y[k])) continue;
            const QPointF point(m_plot->xAxis->coordToPixel(series.x[k]),
                                m_plot->yAxis->coordToPixel(series.y[k]));
            const double away = std::hypot(point.x() - place.x(), point.y() - place.y());
            if (away >= least) continue;
            least = away;
            nearest = {static_cast<int>(s), static_cast<int>(k)};
        }
    }
    return nearest;
}

std::optional<PlotWidget::Cell> PlotWidget::cellAt(const QPointF& place) const {
    if (!m_spec.map || !m_plot->axisRect()->rect().contains(place.toPoint())) return std::nullopt;
    const double x = std::round(m_plot->xAxis->pixelToCoord(place.x()));
    const double y = std::round(m_plot->yAxis->pixelToCoord(place.y()));
    if (!(x >= 0 && y >= 0 && x < static_cast<double>(m_spec.map->columns) &&
          y < static_cast<double>(m_spec.map->rows)))
        return std::nullopt;
    return Cell{static_cast<std::size_t>(x), static_cast<std::size_t>(y)};
}

QString PlotWidget::describe(const Cell& cell) const {
    const ChartMap& map = *m_spec.map;
    const auto named = [](const ChartAxis& axis, std::size_t index) {
        return axis.label + u' ' + (index < axis.names.size() ? axis.names[index] : QString::number(index));
    };
    const double value = map.values[cell.row * map.columns + cell.column];
    QString figure = PlotTexts::tr("no value");
    if (!std::isnan(value))
        figure = QString::number(value) + (map.scale.unit.isEmpty() ? QString() : u' ' + map.scale.unit);
    return named(m_spec.x, cell.column) + u'\n' + named(m_spec.y, cell.row) + u'\n' + map.scale.label + u' ' +
           figure;
}

void PlotWidget::setChart(const ChartSpec& spec) {
    m_spec = spec;
    const QColor ground = palette().color(QPalette::Base);
    const QColor text = palette().color(QPalette::Text);
    QColor grid = text;
    grid.setAlpha(40);
    drawChart(*m_plot, m_spec, {ground, text, grid});
    m_cursorLine = nullptr;
    showCursor();
    m_plot->replot(QCustomPlot::rpQueuedReplot);
}

void PlotWidget::setCursor(std::optional<double> x) {
    if (x == m_cursor) return;
    m_cursor = x;
    showCursor();
    if (isVisible()) m_plot->layer(cursorLayer)->replot(); // one that is hidden would be drawn as a whole
}

void PlotWidget::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    m_plot->replot(QCustomPlot::rpQueuedReplot); // the cursor may have moved
}

/// On a layer with a picture of its own: a run moves it sixty times a second.
void PlotWidget::showCursor() {
    if (m_cursorLine == nullptr) {
        m_cursorLine = new QCPItemStraightLine(m_plot);
        m_cursorLine->setLayer(cursorLayer);
        m_cursorLine->setSelectable(false);
    }
    m_cursorLine->setVisible(m_cursor.has_value());
    if (!m_cursor) return;
    m_cursorLine->setPen(QPen(palette().color(QPalette::Highlight), 1.5));
    m_cursorLine->point1->setCoords(*m_cursor, 0);
    m_cursorLine->point2->setCoords(*m_cursor, 1);
}

/// Another size may have room for the names of the series, or none.
void PlotWidget::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    const bool named = legendPlaceOf(*m_plot, m_spec) != LegendPlace::None;
    if (named != showsLegend()) setChart(ChartSpec(m_spec));
}

bool PlotWidget::showsLegend() const { return m_plot->legend->visible(); }

QString PlotWidget::labelOfY() const { return m_plot->yAxis->label(); }

double PlotWidget::xOf(double x) const { return m_plot->xAxis->coordToPixel(x); }

void PlotWidget::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange) setChart(ChartSpec(m_spec));
}

} // namespace carom

#include "moc_plot.cpp"
