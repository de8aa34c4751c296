// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/docks/checks_dock.h"

#include "ui/widgets/empty_state.h"

#include <QHeaderView>
#include <QLabel>
#include <QTreeWidget>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

QIcon iconOf(CheckState state, const Theme& theme) {
    switch (state) {
    case CheckState::Holds:
        return theme.icon(QStringLiteral("check_held"), theme.good);
    case CheckState::Fails:
        return theme.icon(QStringLiteral("check_failed"), theme.error);
    case CheckState::Waiting:
    case CheckState::NotJudged:
        break;
    }
    return theme.icon(QStringLiteral("check_waiting"), theme.mutedText);
}

} // namespace

ChecksDock::ChecksDock(const Theme& theme, QWidget* parent)
    : Panel(tr("Checks"), parent), m_theme(theme), m_table(new QTreeWidget), m_sum(new QLabel) {
    setObjectName(QStringLiteral("checks"));
    m_table->setObjectName(QStringLiteral("checkTable"));
    m_table->setAccessibleName(tr("Expectations"));
    m_table->setHeaderLabels({tr("Expected"), tr("Measured"), tr("To spare"), tr("First failed")});
    m_table->setRootIsDecorated(false);
    m_table->setUniformRowHeights(true);
    m_table->setAllColumnsShowFocus(true);
    m_table->header()->setStretchLastSection(false);
    m_table->header()->setSectionResizeMode(Expected, QHeaderView::Stretch);
    m_table->header()->setSectionResizeMode(Measured, QHeaderView::Stretch);
    for (const int column : {Spare, FailedAt})
        m_table->header()->setSectionResizeMode(column, QHeaderView::ResizeToContents);
    m_sum->setObjectName(QStringLiteral("checkSum"));
    m_sum->setProperty("role", QStringLiteral("muted"));
    m_sum->setContentsMargins(8, 5, 8, 5);
    QWidget* page = new QWidget;
    QVBoxLayout* column = new QVBoxLayout(page);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(m_sum);
    column->addWidget(m_table, 1);
    m_state =
        new EmptyState(page, tr("The scene expects nothing.\nAn `expect` declaration says what must come "
                                "out of the run; it is judged here as the run goes on. The manual has a "
                                "page about it: State what must happen."));
    setWidget(m_state);
    setFocusProxy(m_table);
    const auto rowOf = [this](QTreeWidgetItem* item) -> const CheckRow& {
        return m_rows[static_cast<std::size_t>(m_table->indexOfTopLevelItem(item))];
    };
    connect(m_table, &QTreeWidget::itemClicked, this,
            [this, rowOf](QTreeWidgetItem* item) { Q_EMIT placeActivated(rowOf(item).declaration); });
    connect(m_table, &QTreeWidget::itemActivated, this, [this, rowOf](QTreeWidgetItem* item) {
        const CheckRow& row = rowOf(item);
        if (row.failedAt)
            Q_EMIT frameActivated(*row.failedAt);
        else
            Q_EMIT placeActivated(row.declaration);
    });
    show({}, 0);
}

void ChecksDock::show(const std::vector<CheckRow>& rows, double step) {
    m_rows = rows;
    m_step = step;
    const int count = static_cast<int>(m_rows.size());
    while (m_table->topLevelItemCount() > count) delete m_table->takeTopLevelItem(count);
    while (m_table->topLevelItemCount() < count) new QTreeWidgetItem(m_table);
    for (int i = 0; i < count; ++i) fill(*m_table->topLevelItem(i), m_rows[static_cast<std::size_t>(i)]);
    m_state->setEmpty(m_rows.empty());
    sumUp();
}

void ChecksDock::fill(QTreeWidgetItem& item, const CheckRow& row) {
    const auto set = [&item](Column column, const QString& text, const QString& tip) {
        item.setText(column, text);
        item.setToolTip(column, tip);
    };
    const bool labelled = !row.wish.startsWith(row.title);
    item.setIcon(Expected, iconOf(row.state, m_theme));
    set(Expected, labelled ? row.title + QStringLiteral(": ") + row.wish : row.wish,
        tr("line %1: %2").arg(row.line).arg(row.wish));
    const QString measured = row.state == CheckState::Waiting ? tr("not judged yet") : row.measured;
    set(Measured, measured, measured);
    const QString spare = row.spare.isEmpty() && row.state == CheckState::Holds ? tr("holds") : row.spare;
    set(Spare, spare, spare);
    item.setText(FailedAt, row.failedAt ? tr("frame %1, %2 s")
                                              .arg(*row.failedAt)
                                              .arg(static_cast<double>(*row.failedAt) * m_step, 0, 'f', 3)
                                        : QString());
    item.setToolTip(FailedAt, row.failedAt ? tr("A double click goes there") : QString());
}

void ChecksDock::sumUp() {
    const auto count = [this](CheckState state) {
        return std::count_if(m_rows.begin(), m_rows.end(),
                             [state](const CheckRow& row) { return row.state == state; });
    };
    const auto failed = count(CheckState::Fails), held = count(CheckState::Holds);
    m_sum->setText(tr("%1 of %2 hold, %3 failed, %4 not judged yet")
                       .arg(held)
                       .arg(m_rows.size())
                       .arg(failed)
                       .arg(count(CheckState::Waiting)));
    setWindowTitle(failed == 0 ? tr("Checks") : tr("Checks (%1 failed)").arg(failed));
}

void ChecksDock::setTheme(const Theme& theme) {
    m_theme = theme;
    show(m_rows, m_step);
}

} // namespace carom

#include "moc_checks_dock.cpp"
