// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/docks/outline_dock.h"

#include "ui/widgets/empty_state.h"

#include <QHeaderView>
#include <QKeyEvent>
#include <QLineEdit>
#include <QSortFilterProxyModel>
#include <QTreeView>
#include <QVBoxLayout>

#include <algorithm>

namespace carom {

OutlineDock::OutlineDock(const Theme& theme, QWidget* parent)
    : Panel(tr("Outline"), parent), m_model(new OutlineModel(theme, this)),
      m_filtered(new QSortFilterProxyModel(this)), m_filter(new QLineEdit), m_view(new QTreeView),
      m_state(nullptr) {
    setObjectName(QStringLiteral("outline"));
    m_filtered->setSourceModel(m_model);
    m_filtered->setFilterRole(OutlineModel::FilterRole);
    m_filtered->setFilterCaseSensitivity(Qt::CaseInsensitive);
    m_view->setModel(m_filtered);
    m_view->setRootIsDecorated(false);
    m_view->setUniformRowHeights(true);
    m_view->setAccessibleName(tr("Outline"));
    m_view->header()->setStretchLastSection(false);
    m_view->header()->setSectionResizeMode(OutlineModel::Name, QHeaderView::Stretch);
    for (const int column : {OutlineModel::Type, OutlineModel::Line})
        m_view->header()->setSectionResizeMode(column, QHeaderView::Fixed);
    m_filter->setObjectName(QStringLiteral("outlineFilter"));
    m_filter->setPlaceholderText(tr("Find a declaration"));
    m_filter->setAccessibleName(tr("Find a declaration"));
    m_filter->setClearButtonEnabled(true);
    m_filter->installEventFilter(this);

    QWidget* content = new QWidget;
    QVBoxLayout* column = new QVBoxLayout(content);
    column->setContentsMargins(6, 6, 6, 0);
    column->setSpacing(4);
    column->addWidget(m_filter);
    column->addWidget(m_view, 1);
    m_state = new EmptyState(content, tr("Nothing is declared yet.\nCtrl+J inserts a declaration."));
    setWidget(m_state);
    setFocusProxy(m_filter);

    connect(m_filter, &QLineEdit::textChanged, this, [this](const QString& words) {
        m_filtered->setFilterFixedString(words);
        markRow();
    });
    const auto activate = [this](const QModelIndex& index) {
        if (index.isValid()) Q_EMIT placeActivated(m_model->rangeAt(m_filtered->mapToSource(index).row()));
    };
    connect(m_view, &QTreeView::clicked, this, activate);
    connect(m_view, &QTreeView::activated, this, activate);
    connect(m_filter, &QLineEdit::returnPressed, this, [this, activate] {
        activate(m_view->currentIndex().isValid() ? m_view->currentIndex() : m_filtered->index(0, 0));
    });
}

void OutlineDock::show(const SharedBuild& result) {
    m_model->show(result);
    m_state->setEmpty(m_model->rowCount() == 0);
    fitColumns();
    markRow();
}

/// To what is longest in them. The view itself would measure a thousand rows, and not the last ones.
void OutlineDock::fitColumns() {
    constexpr int margins = 24; // [px], with what the theme adds
    const auto fit = [this](int column, const QStringList& texts) {
        int width = m_view->header()->sectionSizeHint(column);
        for (const QString& text : texts)
            width = std::max(width, m_view->fontMetrics().horizontalAdvance(text) + margins);
        m_view->header()->resizeSection(column, width);
    };
    const int last = m_model->rowCount() - 1;
    fit(OutlineModel::Type, m_model->typesWritten());
    if (last >= 0) fit(OutlineModel::Line, {m_model->index(last, OutlineModel::Line).data().toString()});
}

void OutlineDock::setTheme(const Theme& theme) { m_model->setTheme(theme); }

void OutlineDock::followCaret(std::uint32_t offset) {
    m_caret = offset;
    markRow();
}

void OutlineDock::markRow() {
    const int row = m_model->rowAt(m_caret);
    const QModelIndex index = row < 0 ? QModelIndex() : m_filtered->mapFromSource(m_model->index(row, 0));
    m_view->setCurrentIndex(index);
    if (index.isValid()) m_view->scrollTo(index);
}

/// The arrows go through the list while one writes in the line above it.
bool OutlineDock::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() != QEvent::KeyPress) return QDockWidget::eventFilter(watched, event);
    const int key = static_cast<QKeyEvent*>(event)->key();
    const int step = key == Qt::Key_Down ? 1 : key == Qt::Key_Up ? -1 : 0;
    if (step == 0) return QDockWidget::eventFilter(watched, event);
    const int row = m_view->currentIndex().isValid() ? m_view->currentIndex().row() + step : 0;
    const QModelIndex index = m_filtered->index(row, 0);
    if (index.isValid()) m_view->setCurrentIndex(index);
    return true;
}

} // namespace carom

#include "moc_outline_dock.cpp"
