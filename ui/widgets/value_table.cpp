// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/value_table.h"

#include <QClipboard>
#include <QGuiApplication>
#include <QHeaderView>
#include <QKeyEvent>
#include <QPixmap>

#include <cmath>

namespace carom {

ValueTable::ValueTable(const QStringList& rows, const QStringList& columns, QWidget* parent)
    : QTableWidget(static_cast<int>(rows.size()), static_cast<int>(columns.size()), parent) {
    for (int row = 0; row < rowCount(); ++row) setVerticalHeaderItem(row, new QTableWidgetItem(rows[row]));
    setHorizontalHeaderLabels(columns);
    for (int row = 0; row < rowCount(); ++row) {
        for (int column = 0; column < columnCount(); ++column) {
            QTableWidgetItem* cell = new QTableWidgetItem(QStringLiteral("–"));
            cell->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
            setItem(row, column, cell);
        }
    }
    setEditTriggers(NoEditTriggers);
    setAlternatingRowColors(true);
    setShowGrid(false);
    setTabKeyNavigation(false);
    horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
    horizontalHeader()->setHighlightSections(false);
    verticalHeader()->setHighlightSections(false);
    verticalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    verticalHeader()->setSectionResizeMode(QHeaderView::Fixed);
    verticalHeader()->setDefaultSectionSize(fontMetrics().height() + 5);
}

void ValueTable::setValue(int row, int column, double value, int decimals) {
    item(row, column)
        ->setText(std::isnan(value) ? QStringLiteral("–") : QString::number(value, 'f', decimals));
}

void ValueTable::setRowColour(int row, const QColor& colour) {
    QPixmap square(12, 12);
    square.fill(colour);
    verticalHeaderItem(row)->setIcon(QIcon(square));
}

QString ValueTable::asText() const {
    const bool some = selectedItems().size() > 1;
    QString text;
    for (int column = 0; column < columnCount(); ++column)
        text += QLatin1Char('\t') + horizontalHeaderItem(column)->text();
    for (int row = 0; row < rowCount(); ++row) {
        QString line;
        bool any = !some;
        for (int column = 0; column < columnCount(); ++column) {
            const bool wanted = !some || item(row, column)->isSelected();
            any = any || wanted;
            line += QLatin1Char('\t') + (wanted ? item(row, column)->text() : QString());
        }
        if (any) text += QLatin1Char('\n') + verticalHeaderItem(row)->text() + line;
    }
    return text;
}

QSize ValueTable::sizeHint() const {
    const int height = horizontalHeader()->sizeHint().height() + rowCount() * rowHeight(0) + 2 * frameWidth();
    return {90 + 70 * columnCount(), height};
}

void ValueTable::keyPressEvent(QKeyEvent* event) {
    if (event->matches(QKeySequence::Copy))
        QGuiApplication::clipboard()->setText(asText());
    else
        QTableWidget::keyPressEvent(event);
}

} // namespace carom
