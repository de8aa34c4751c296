// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/value_table.h"

#include <QClipboard>
#include <QGuiApplication>
#include <QHeaderView>
#include <QKeyEvent>
#include <QPixmap>

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

/// The columns of the widget: names, then the figures.
constexpr int names = 0;
constexpr int firstFigures = 1;
const QString nothing = QStringLiteral("–");

} // namespace

ValueTable::ValueTable(const QStringList& rows, const QStringList& columns, QWidget* parent)
    : QTableWidget(static_cast<int>(rows.size()), static_cast<int>(columns.size()) + 1, parent) {
    setHorizontalHeaderLabels(QStringList{QString()} + columns);
    for (int row = 0; row < rowCount(); ++row) {
        setItem(row, names, new QTableWidgetItem(rows[row]));
        for (int column = 0; column < columns.size(); ++column) {
            QTableWidgetItem* cell = new QTableWidgetItem(nothing);
            cell->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
            setItem(row, firstFigures + column, cell);
        }
    }
    setEditTriggers(NoEditTriggers);
    connect(this, &QTableWidget::itemChanged, this, [this](const QTableWidgetItem* item) {
        if (item->column() == names && item->data(Qt::CheckStateRole).isValid())
            Q_EMIT checked(item->row(), item->checkState() == Qt::Checked);
    });
    setAlternatingRowColors(true);
    setShowGrid(false);
    setTabKeyNavigation(false);
    setIconSize({10, 10});
    verticalHeader()->hide();
    verticalHeader()->setMinimumSectionSize(1);
    verticalHeader()->setSectionResizeMode(QHeaderView::Fixed);
    verticalHeader()->setDefaultSectionSize(fontMetrics().height() + 3);
    horizontalHeader()->setHighlightSections(false);
    horizontalHeader()->setDefaultAlignment(Qt::AlignRight | Qt::AlignVCenter);
    horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
    horizontalHeader()->setSectionResizeMode(names, QHeaderView::ResizeToContents);
}

void ValueTable::setValue(int row, int column, double value, int decimals) {
    item(row, firstFigures + column)
        ->setText(std::isnan(value) ? nothing : QString::number(value, 'f', decimals));
}

QString ValueTable::text(int row, int column) const { return item(row, firstFigures + column)->text(); }

void ValueTable::setColumnTitle(int column, const QString& title) {
    horizontalHeaderItem(firstFigures + column)->setText(title);
    updateGeometry();
}

void ValueTable::setRowColour(int row, const QColor& colour) {
    QPixmap square(10, 10);
    square.fill(colour);
    item(row, names)->setIcon(QIcon(square));
}

void ValueTable::makeCheckable(int row) {
    item(row, names)->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
    item(row, names)->setCheckState(Qt::Checked);
}

void ValueTable::setChecked(int row, bool checked) {
    item(row, names)->setCheckState(checked ? Qt::Checked : Qt::Unchecked);
}

bool ValueTable::isChecked(int row) const { return item(row, names)->checkState() == Qt::Checked; }

QString ValueTable::asText() const {
    const bool some = selectedItems().size() > 1;
    QString lines;
    for (int column = firstFigures; column < columnCount(); ++column)
        lines += QLatin1Char('\t') + horizontalHeaderItem(column)->text();
    for (int row = 0; row < rowCount(); ++row) {
        QString line;
        bool any = !some;
        for (int column = firstFigures; column < columnCount(); ++column) {
            const bool wanted = !some || item(row, column)->isSelected();
            any = any || wanted;
            line += QLatin1Char('\t') + (wanted ? item(row, column)->text() : QString());
        }
        if (any) lines += QLatin1Char('\n') + item(row, names)->text() + line;
    }
    return lines;
}

QSize ValueTable::sizeHint() const {
    const int height = horizontalHeader()->sizeHint().height() + rowCount() * rowHeight(0) + 2 * frameWidth();
    int widest = horizontalHeader()->minimumSectionSize();
    for (int column = firstFigures; column < columnCount(); ++column)
        widest = std::max({widest, horizontalHeader()->sectionSizeHint(column), sizeHintForColumn(column)});
    const int figures = (columnCount() - firstFigures) * widest;
    return {sizeHintForColumn(names) + figures + 2 * frameWidth(), height};
}

/// No figure is cut off; rows may be scrolled to.
QSize ValueTable::minimumSizeHint() const {
    return {sizeHint().width(), QTableWidget::minimumSizeHint().height()};
}

void ValueTable::keyPressEvent(QKeyEvent* event) {
    if (event->matches(QKeySequence::Copy))
        QGuiApplication::clipboard()->setText(asText());
    else
        QTableWidget::keyPressEvent(event);
}

} // namespace carom

#include "moc_value_table.cpp"
