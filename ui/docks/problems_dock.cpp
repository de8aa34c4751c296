// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/docks/problems_dock.h"

#include "ui/widgets/empty_state.h"

#include <QHeaderView>
#include <QSortFilterProxyModel>
#include <QTreeView>

namespace carom {

ProblemsDock::ProblemsDock(const Theme& theme, QWidget* parent)
    : Panel(tr("Problems"), parent), m_model(new ProblemsModel(theme, this)),
      m_sorted(new QSortFilterProxyModel(this)), m_view(new QTreeView),
      m_state(new EmptyState(m_view, tr("No problems.\nWhat is wrong in the text is listed here as you type; "
                                        "F8 goes from one to the next."))) {
    setObjectName(QStringLiteral("problems"));
    m_sorted->setSourceModel(m_model);
    m_sorted->setSortRole(ProblemsModel::SortRole);
    m_view->setModel(m_sorted);
    m_view->setRootIsDecorated(false);
    m_view->setUniformRowHeights(true);
    m_view->setAlternatingRowColors(false);
    m_view->setSortingEnabled(true);
    m_view->sortByColumn(ProblemsModel::Line, Qt::AscendingOrder);
    m_view->setAccessibleName(tr("Problems"));
    m_view->header()->setStretchLastSection(false);
    m_view->header()->setSectionResizeMode(ProblemsModel::Message, QHeaderView::Stretch);
    for (const int column : {ProblemsModel::Line, ProblemsModel::Column, ProblemsModel::Code})
        m_view->header()->setSectionResizeMode(column, QHeaderView::ResizeToContents);
    const auto activate = [this](const QModelIndex& index) {
        const int row = m_sorted->mapToSource(index).row();
        if (const std::optional<std::int64_t> frame = m_model->frameAt(row))
            Q_EMIT frameActivated(*frame);
        else
            Q_EMIT placeActivated(m_model->rangeAt(row));
    };
    connect(m_view, &QTreeView::clicked, this, activate);
    connect(m_view, &QTreeView::activated, this, activate);
    setWidget(m_state);
    setFocusProxy(m_view);
}

void ProblemsDock::show(const SharedBuild& result) {
    m_model->show(result);
    showCount();
}

void ProblemsDock::showRun(const std::optional<RunProblem>& problem) {
    m_model->showRun(problem);
    showCount();
}

void ProblemsDock::showCount() {
    const int count = m_model->rowCount();
    m_state->setEmpty(count == 0);
    setWindowTitle(count == 0 ? tr("Problems") : tr("Problems (%1)").arg(count));
}

void ProblemsDock::setTheme(const Theme& theme) { m_model->setTheme(theme); }

} // namespace carom

#include "moc_problems_dock.cpp"
