// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/docks/plots_dock.h"

#include "core/base/csv.h"
#include "core/expectations/expectation_proposals.h"
#include "ui/widgets/body_box.h"
#include "ui/widgets/empty_state.h"
#include "ui/widgets/expect_menu.h"
#include "ui/base/export_menu.h"
#include "ui/widgets/panel_parts.h"
#include "ui/base/file_output.h"
#include "ui/base/pauses.h"
#include "ui/widgets/text_of.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QMenu>
#include <QShortcut>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <utility>

namespace carom {
namespace {

/// [ms]; at half, drawing takes twice the time; at twice, curves move in steps.
constexpr int refreshInterval = 200;
constexpr int listWidth = 230;            // [px]
constexpr std::int64_t worthSaying = 240; // frames behind the run from which the panel says so: four seconds

} // namespace

PlotsDock::PlotsDock(QWidget* parent)
    : Panel(tr("Plots"), parent), m_bodies(new BodyBox(tr("the whole scene"), BodyBox::Offers::Bounded)),
      m_quantities(new QComboBox), m_list(new QListWidget),
      m_add(wordButton("plotAdd", tr("Add"), tr("Draw this quantity over time"))),
      m_remove(wordButton("plotRemove", tr("Remove"), tr("Take the selected curve off the chart (Delete)"))),
      m_expect(wordButton("plotExpect", tr("Expect this"),
                          tr("Write what the selected curve shows into the text, as an expectation"))),
      m_plot(new PlotWidget),
      m_state(new EmptyState(m_plot, tr("Choose a body and a quantity at the left and "
                                        "press Add to see it over time."))),
      m_progress(new QLabel) {
    setObjectName(QStringLiteral("plots"));
    m_bodies->setObjectName(QStringLiteral("plotBody"));
    m_quantities->setObjectName(QStringLiteral("plotQuantity"));
    m_bodies->setAccessibleName(tr("Body"));
    m_quantities->setAccessibleName(tr("Quantity"));
    m_list->setAccessibleName(tr("Curves"));
    m_progress->setObjectName(QStringLiteral("plotProgress"));
    m_progress->setProperty("role", QStringLiteral("muted"));
    m_progress->setWordWrap(true);
    m_progress->hide();
    QShortcut* remove =
        new QShortcut(QKeySequence(Qt::Key_Delete), m_list, nullptr, nullptr, Qt::WidgetShortcut);
    connect(remove, &QShortcut::activated, this, &PlotsDock::removeCurve);
    layOut();
    m_refresh.setSingleShot(true);
    m_refresh.setInterval(pauseOf(refreshInterval));
    connect(&m_refresh, &QTimer::timeout, this, &PlotsDock::redraw);
    connect(&m_run, &ProbeRun::measured, this, &PlotsDock::take);
    connect(m_bodies, &QComboBox::currentIndexChanged, this, &PlotsDock::fillQuantities);
    connect(m_add, &QToolButton::clicked, this, &PlotsDock::addCurve);
    connect(m_remove, &QToolButton::clicked, this, &PlotsDock::removeCurve);
    m_expect->setPopupMode(QToolButton::InstantPopup);
    m_expect->setMenu(new QMenu(m_expect));
    connect(m_expect->menu(), &QMenu::aboutToShow, this, &PlotsDock::offerExpectations);
    connect(m_plot, &PlotWidget::placeClicked, this, &PlotsDock::pickAt);
    connect(this, &QDockWidget::visibilityChanged, this, &PlotsDock::extend);
    fillQuantities();
    redraw();
}

void PlotsDock::layOut() {
    QHBoxLayout* buttons = new QHBoxLayout;
    buttons->addWidget(m_add);
    buttons->addWidget(m_remove);
    buttons->addStretch();
    buttons->addWidget(makeExportMenu(QStringLiteral("plot")));
    QVBoxLayout* column = new QVBoxLayout;
    column->addWidget(m_bodies);
    column->addWidget(m_quantities);
    column->addLayout(buttons);
    column->addWidget(m_list, 1);
    column->addWidget(m_expect, 0, Qt::AlignLeft);
    column->addWidget(m_progress);
    setWidget(besideControls(column, listWidth, m_state));
    setFocusProxy(m_bodies);
}

void PlotsDock::showPipeline(std::shared_ptr<const Pipeline> pipeline) {
    if (pipeline == m_pipeline) return;
    m_pipeline = std::move(pipeline);
    m_reached = 0;
    m_bodies->showPipeline(m_pipeline);
    restart();
    tellProgress();
}

void PlotsDock::reach(std::int64_t frame) {
    m_reached = std::max(m_reached, frame);
    extend();
    tellProgress();
}

void PlotsDock::showFrame(std::int64_t frame) {
    m_shown = frame;
    if (m_pipeline) m_plot->setCursor(static_cast<double>(frame) * step());
}

void PlotsDock::pickAt(double time) {
    if (!m_pipeline || m_curves.empty()) return;
    Q_EMIT framePicked(std::clamp<std::int64_t>(std::llround(time / step()), 0, m_reached));
}

double PlotsDock::step() const { return m_pipeline->settings().step; }

/// Frames that the curves have figures of.
std::int64_t PlotsDock::measured() const { return m_curves.empty() ? 0 : m_curves.front().figures.count(); }

void PlotsDock::tellProgress() {
    const bool behind = !m_curves.empty() && m_reached - measured() > worthSaying;
    m_progress->setVisible(behind);
    if (behind) m_progress->setText(tr("filling in: frame %1 of %2").arg(measured()).arg(m_reached));
}

std::size_t PlotsDock::bytes() const {
    std::size_t sum = 0;
    for (const Curve& curve : m_curves) sum += curve.figures.bytes();
    return sum;
}

/// Only what is looked at is measured.
void PlotsDock::extend() {
    if (isVisible()) m_run.extendTo(m_reached);
}

void PlotsDock::offerBody(BodyIndex body) { m_bodies->choose(body); }

void PlotsDock::fillQuantities() {
    const QString before = m_quantities->currentText();
    m_quantities->clear();
    const bool whole = m_bodies->currentIndex() <= 0;
    for (const QuantityRow& row : whole ? wholeQuantities() : bodyQuantities())
        m_quantities->addItem(textOf(row.name));
    m_quantities->setCurrentIndex(std::max(0, m_quantities->findText(before)));
}

void PlotsDock::addCurve() {
    if (m_quantities->currentIndex() < 0) return;
    const bool whole = m_bodies->currentIndex() <= 0;
    const std::span<const QuantityRow> rows = whole ? wholeQuantities() : bodyQuantities();
    const QuantityRow& row = rows[static_cast<std::size_t>(m_quantities->currentIndex())];
    add({&row, whole, whole ? QString() : m_bodies->currentText(), {}});
}

void PlotsDock::plotWhole(std::string_view quantity) {
    for (const QuantityRow& row : wholeQuantities())
        if (row.name == quantity) add({&row, true, {}, {}});
}

void PlotsDock::add(Curve curve) {
    m_curves.push_back(std::move(curve));
    m_list->addItem(titleOf(m_curves.back()));
    restart();
}

void PlotsDock::removeCurve() {
    const int row = m_list->currentRow();
    if (row < 0) return;
    m_curves.erase(m_curves.begin() + row);
    delete m_list->takeItem(row);
    restart();
}

QString PlotsDock::titleOf(const Curve& curve) const {
    const QString of = curve.ofWhole ? tr("whole") : curve.body;
    return QStringLiteral("%1: %2").arg(of, textOf(curve.quantity->name));
}

/// noBody for the whole; a body the scene no longer has is one it does not have.
BodyIndex PlotsDock::bodyOf(const Curve& curve) const {
    if (curve.ofWhole) return noBody;
    const int row = m_bodies->findText(curve.body);
    return row > 0 ? m_bodies->bodyAt(row) : noBody - 1;
}

/// Of the selected curve, else the first, at the frame on screen and up to there.
void PlotsDock::offerExpectations() {
    std::vector<Expectation> proposals;
    const std::size_t row = static_cast<std::size_t>(std::max(0, m_list->currentRow()));
    const Curve* curve = row < m_curves.size() ? &m_curves[row] : nullptr;
    const bool there = curve != nullptr && m_pipeline && m_shown < curve->figures.count() &&
                       (curve->ofWhole || bodyOf(*curve) < m_pipeline->bodies().count());
    if (there) {
        const SeriesStretch& now = curve->figures.at(m_shown);
        Observed seen{.quantity = curve->quantity,
                      .body = bodyOf(*curve),
                      .time = static_cast<double>(m_shown) * step(),
                      .low = now.low,
                      .high = now.high,
                      .until = static_cast<double>(m_shown) * step(),
                      .least = now.low,
                      .most = now.high};
        for (const SeriesStretch& stretch : curve->figures.stretches()) {
            if (stretch.first > m_shown) break;
            seen.least = std::fmin(seen.least, stretch.low); // passes over what is no number
            seen.most = std::fmax(seen.most, stretch.high);
        }
        proposals = proposalsFor(seen);
    }
    const Scene none;
    fillExpectMenu(*m_expect->menu(), m_pipeline ? m_pipeline->scene() : none, proposals,
                   [this](const Expectation& chosen) { Q_EMIT expectationWanted(chosen); });
}

/// All curves from the start: the same scene gives the same figures.
void PlotsDock::restart() {
    std::vector<Probe> probes;
    for (Curve& curve : m_curves) {
        curve.figures.clear();
        probes.push_back({curve.quantity, bodyOf(curve)}); // without a body it has no figures
    }
    m_run.start(m_pipeline, std::move(probes));
    extend();
    redraw();
}

void PlotsDock::take(const std::vector<ProbeRow>& rows) {
    for (const ProbeRow& row : rows)
        for (std::size_t i = 0; i < m_curves.size(); ++i) m_curves[i].figures.add(row.figures[i]);
    tellProgress();
    if (!m_refresh.isActive()) m_refresh.start();
}

void PlotsDock::redraw() {
    m_chart = {};
    m_chart.x = {tr("time"), QStringLiteral("s"), false};
    const bool sameUnit = std::all_of(m_curves.begin(), m_curves.end(), [this](const Curve& curve) {
        return curve.quantity->unit == m_curves.front().quantity->unit;
    });
    if (!m_curves.empty()) {
        const QuantityRow& first = *m_curves.front().quantity;
        m_chart.y = {m_curves.size() == 1 ? titleOf(m_curves.front()) : tr("value"),
                     sameUnit ? textOf(first.unit) : QString(), false};
    }
    for (std::size_t i = 0; i < m_curves.size(); ++i) {
        const Curve& curve = m_curves[i];
        QString name = titleOf(curve);
        if (!sameUnit && !curve.quantity->unit.empty())
            name += QStringLiteral(" [%1]").arg(textOf(curve.quantity->unit));
        ChartSeries series{name, {}, {}, SeriesStyle::Line, seriesColour(i)};
        for (const SeriesPoint& point : curve.figures.points()) {
            series.x.push_back(static_cast<double>(point.place) * step());
            series.y.push_back(point.value);
        }
        m_chart.series.push_back(std::move(series));
        QPixmap square(10, 10);
        square.fill(seriesColour(i));
        m_list->item(static_cast<int>(i))->setIcon(QIcon(square));
    }
    m_plot->setChart(m_chart);
    m_state->setEmpty(m_curves.empty());
    m_remove->setEnabled(!m_curves.empty());
    m_expect->setEnabled(!m_curves.empty());
}

QString PlotsDock::writeCsv(const QString& path) const {
    const bool everyFrame = m_curves.front().figures.length() == 1;
    QString columns = QStringLiteral("time_s");
    const auto addColumn = [&columns](QString title) {
        columns += QStringLiteral(",\"") + title.replace(u'"', QStringLiteral("\"\"")) + u'"';
    };
    for (const Curve& curve : m_curves) {
        const QString title = QStringLiteral("%1 [%2]").arg(titleOf(curve), textOf(curve.quantity->unit));
        if (everyFrame) {
            addColumn(title);
            continue;
        }
        addColumn(tr("least %1").arg(title));
        addColumn(tr("greatest %1").arg(title));
    }
    CsvTable table(columns.toStdString());
    for (const SeriesStretch& stretch : m_curves.front().figures.stretches()) {
        table.add(static_cast<double>(stretch.first) * step());
        for (const Curve& curve : m_curves) {
            const SeriesStretch& its = curve.figures.at(stretch.first);
            table.add(its.low);
            if (!everyFrame) table.add(its.high);
        }
        table.endRow();
    }
    return saveFile(path, table.take());
}

QString PlotsDock::exportTo(const QString& path) const {
    if (m_curves.empty()) return tr("there are no curves yet; add one first");
    if (isCsv(path)) return writeCsv(path);
    return writeChart(m_chart, path);
}

} // namespace carom

#include "moc_plots_dock.cpp"
