// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/docks/broadphase_dock.h"

#include "ui/docks/broadphase_comparison.h"
#include "ui/widgets/text_of.h"

#include <QComboBox>
#include <QFontDatabase>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QScrollArea>
#include <QVBoxLayout>

#include <algorithm>
#include <array>

namespace carom {
namespace {

/// [ms]; at a tenth figures change too fast to be read, at ten times they lag.
constexpr qint64 refreshInterval = 120;
constexpr int mostColumns = 3;   // of figures
constexpr int valueWidth = 90;   // [px] of a figure
constexpr int betweenParts = 24; // [px]

QString count(std::uint64_t value) { return QLocale::c().toString(static_cast<qulonglong>(value)); }

QString pairsTestedPerPairFound(const FrameStatistics& s) {
    if (s.broad.pairs == 0) return QStringLiteral("–");
    const double ratio = static_cast<double>(s.broad.tested) / static_cast<double>(s.broad.pairs);
    return QString::number(ratio, 'f', 1);
}

QString testsSpared(const FrameStatistics& s) {
    if (s.axesTried == 0) return QStringLiteral("–");
    const double share = 100 * static_cast<double>(s.axesSpared) / static_cast<double>(s.axesTried);
    return QStringLiteral("%1 (%2 %)").arg(count(s.axesSpared)).arg(share, 0, 'f', 0);
}

struct FigureRow {
    const char* title;
    const char* help;
    QString (*value)(const FrameStatistics& statistics);
};

constexpr std::array figures = {
    FigureRow{QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Boxes"),
              QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Boxes looked at in the frame"),
              [](const FrameStatistics& s) { return count(s.broad.boxes); }},
    FigureRow{
        QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Overlapping pairs"),
        QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Pairs whose boxes overlap: what the narrow phase gets"),
        [](const FrameStatistics& s) { return count(s.broad.pairs); }},
    FigureRow{QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Pairs tested"),
              QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Pairs of boxes compared to find them"),
              [](const FrameStatistics& s) { return count(s.broad.tested); }},
    FigureRow{QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Tested / overlapping"),
              QT_TRANSLATE_NOOP("carom::BroadphaseDock", "1 would be perfect"), pairsTestedPerPairFound},
    FigureRow{QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Contacts"),
              QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Pairs found touching or overlapping"),
              [](const FrameStatistics& s) { return count(s.contacts); }},
    FigureRow{
        QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Swaps"),
        QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Exchanges of neighbouring end points (sweep and sort)"),
        [](const FrameStatistics& s) { return count(s.broad.swaps); }},
    FigureRow{QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Pairs added / removed"),
              QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Pairs that began and ceased to overlap"),
              [](const FrameStatistics& s) {
                  return QStringLiteral("%1 / %2").arg(count(s.broad.added), count(s.broad.removed));
              }},
    FigureRow{QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Cells or nodes"),
              QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Cells of a grid or nodes of a tree visited"),
              [](const FrameStatistics& s) { return count(s.broad.cells); }},
    FigureRow{QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Memory"),
              QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Held by the algorithm"),
              [](const FrameStatistics& s) {
                  return QLocale::c().formattedDataSize(static_cast<qint64>(s.broad.memoryBytes), 1);
              }},
    FigureRow{QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Axes tried"),
              QT_TRANSLATE_NOOP("carom::BroadphaseDock",
                                "Pairs tried along the direction that parted them in the frame before"),
              [](const FrameStatistics& s) { return count(s.axesTried); }},
    FigureRow{QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Full tests spared"),
              QT_TRANSLATE_NOOP("carom::BroadphaseDock",
                                "Of the axes tried, those that still part the pair: no full test was needed"),
              testsSpared},
    FigureRow{QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Time"),
              QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Wall time of the broad-phase in the frame"),
              [](const FrameStatistics& s) { return QStringLiteral("%1 ms").arg(s.broadphase, 0, 'f', 3); }},
    FigureRow{
        QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Pairs collided"),
        QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Pairs whose shapes the method of contacts compared"),
        [](const FrameStatistics& s) { return count(s.work.pairsCollided); }},
    FigureRow{QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Rows swept"),
              QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Contact points times passes of its velocity solve"),
              [](const FrameStatistics& s) { return count(s.work.rowsSwept); }},
    FigureRow{QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Factorisations"),
              QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Of matrices of contacts, for exact forces"),
              [](const FrameStatistics& s) { return count(s.work.factorisations); }},
    FigureRow{QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Impacts"),
              QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Impacts solved"),
              [](const FrameStatistics& s) { return count(s.work.impacts); }},
    FigureRow{QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Searches"),
              QT_TRANSLATE_NOOP("carom::BroadphaseDock",
                                "How often the broad-phase searched for the method of contacts"),
              [](const FrameStatistics& s) { return count(s.work.searches); }},
    FigureRow{
        QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Islands"),
        QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Groups of bodies that touch, summed over the substeps"),
        [](const FrameStatistics& s) { return count(s.work.islands); }},
    FigureRow{QT_TRANSLATE_NOOP("carom::BroadphaseDock", "Islands unfinished"),
              QT_TRANSLATE_NOOP(
                  "carom::BroadphaseDock",
                  "Islands whose forces are not exact, because the budget of the frame did not allow it"),
              [](const FrameStatistics& s) { return count(s.work.unfinished); }},
};

} // namespace

BroadphaseDock::BroadphaseDock(QWidget* parent)
    : Panel(tr("Broad-phase"), parent), m_algorithm(new QComboBox), m_reason(new QLabel),
      m_grid(new QGridLayout), m_comparison(new BroadphaseComparison) {
    setObjectName(QStringLiteral("broadphase"));
    m_algorithm->setObjectName(QStringLiteral("algorithm"));
    m_algorithm->setMaximumWidth(420);
    m_algorithm->setAccessibleName(tr("Algorithm"));
    m_algorithm->addItem(tr("As the scene asks"));
    for (const BroadphaseRow& row : broadphases()) {
        m_algorithm->addItem(textOf(row.title), QVariant::fromValue(textOf(row.name)));
        m_algorithm->setItemData(m_algorithm->count() - 1, textOf(row.cost) + u'\n' + textOf(row.source),
                                 Qt::ToolTipRole);
    }
    m_reason->setWordWrap(true);
    m_reason->setProperty("role", QStringLiteral("muted"));

    m_grid->setHorizontalSpacing(16);
    m_grid->setVerticalSpacing(6);
    for (std::size_t i = 0; i < figures.size(); ++i) {
        QLabel* title = new QLabel(tr(figures[i].title));
        title->setProperty("role", QStringLiteral("muted"));
        title->setToolTip(tr(figures[i].help));
        QLabel* value = new QLabel;
        value->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
        value->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
        value->setToolTip(tr(figures[i].help));
        value->setAccessibleDescription(tr(figures[i].title));
        m_titles.push_back(title);
        m_values.push_back(value);
    }
    setColumns(mostColumns);
    QVBoxLayout* live = new QVBoxLayout;
    live->setSpacing(8);
    live->addWidget(m_algorithm);
    live->addWidget(m_reason);
    live->addLayout(m_grid);
    live->addStretch();
    QWidget* content = new QWidget;
    QHBoxLayout* sideBySide = new QHBoxLayout(content);
    sideBySide->setContentsMargins(6, 4, 6, 6);
    sideBySide->setSpacing(betweenParts);
    sideBySide->addLayout(live);
    sideBySide->addWidget(m_comparison, 1);

    QScrollArea* scroll = new QScrollArea;
    scroll->setAccessibleName(tr("Broad-phase"));
    scroll->setWidget(content);
    scroll->setWidgetResizable(true);
    setWidget(scroll);
    setFocusProxy(m_algorithm);
    connect(m_algorithm, &QComboBox::currentIndexChanged, this, [this] { Q_EMIT algorithmChosen(chosen()); });
    connect(m_comparison, &BroadphaseComparison::reported, this, &BroadphaseDock::reported);
    m_comparison->installEventFilter(this); // what was compared takes more room than the button for it
    clear();
}

/// The figures in so many columns, read downwards.
void BroadphaseDock::setColumns(int columns) {
    if (columns == m_columns) return;
    const int count = static_cast<int>(m_values.size()), rows = (count + columns - 1) / columns;
    for (int i = 0; i < count; ++i) {
        const int row = i % rows, side = i / rows;
        m_grid->addWidget(m_titles[static_cast<std::size_t>(i)], row, side * 3);
        m_grid->addWidget(m_values[static_cast<std::size_t>(i)], row, side * 3 + 1);
    }
    for (int side = 0; side < mostColumns; ++side) {
        const bool used = side < columns;
        m_grid->setColumnMinimumWidth(side * 3 + 1, used ? valueWidth : 0);
        m_grid->setColumnMinimumWidth(side * 3 + 2, used && side + 1 < columns ? betweenParts : 0);
    }
    m_columns = columns;
}

/// As many columns as leave room for the comparison: the dock is wide and low where it usually stands. Beside
/// one column that leaves too little, the chart goes below the table.
void BroadphaseDock::fitColumns() {
    int titles = 0;
    for (const QLabel* title : m_titles) titles = std::max(titles, title->sizeHint().width());
    const int column = titles + valueWidth + 2 * m_grid->horizontalSpacing() + betweenParts;
    const int room = width() - m_comparison->widthSideBySide() - betweenParts;
    setColumns(std::clamp(room / column, 1, mostColumns));
    m_comparison->stack(room < column);
}

bool BroadphaseDock::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::LayoutRequest) fitColumns();
    return Panel::eventFilter(watched, event);
}

void BroadphaseDock::resizeEvent(QResizeEvent* event) {
    Panel::resizeEvent(event);
    fitColumns();
}

void BroadphaseDock::showPipeline(std::shared_ptr<const Pipeline> pipeline) {
    const RunSettings& settings = pipeline->settings();
    const QString name = settings.broadphase != nullptr ? textOf(settings.broadphase->title) : tr("none");
    m_algorithm->setItemText(0, tr("As the scene asks (%1)").arg(name));
    const QString reason = sentence(settings.broadphaseReason);
    m_reason->setText(reason.isEmpty() ? tr("The scene names it.") : tr("Chosen: %1").arg(reason));
    m_comparison->setPipeline(std::move(pipeline));
}

void BroadphaseDock::addSamples(std::span<const FrameSample> samples) {
    if (samples.empty()) return;
    m_newest = samples.back().statistics;
    if (m_sinceRefresh.isValid() && m_sinceRefresh.elapsed() < refreshInterval) return;
    m_sinceRefresh.start();
    refresh();
}

void BroadphaseDock::clear() {
    m_newest = {};
    m_sinceRefresh.invalidate();
    refresh();
}

const BroadphaseRow* BroadphaseDock::chosen() const {
    const QByteArray name = m_algorithm->currentData().toString().toUtf8();
    return name.isEmpty() ? nullptr
                          : findBroadphase({name.constData(), static_cast<std::size_t>(name.size())});
}

void BroadphaseDock::refresh() {
    for (std::size_t i = 0; i < figures.size(); ++i)
        m_values[i]->setText(m_newest.frame > 0 ? figures[i].value(m_newest) : QStringLiteral("–"));
}

} // namespace carom

#include "moc_broadphase_dock.cpp"
