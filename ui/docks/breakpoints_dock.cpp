// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/docks/breakpoints_dock.h"

#include "ui/widgets/body_box.h"
#include "ui/widgets/empty_state.h"
#include "ui/widgets/panel_parts.h"
#include "ui/widgets/text_of.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QToolButton>
#include <QVBoxLayout>

namespace carom {
namespace {

constexpr int formWidth = 300; // [px]

} // namespace

BreakpointsDock::BreakpointsDock(QWidget* parent)
    : Panel(tr("Breakpoints"), parent), m_kind(new QComboBox),
      m_a(new BodyBox(tr("any body"), BodyBox::Offers::All)),
      m_b(new BodyBox(tr("any body"), BodyBox::Offers::All)), m_axis(new QComboBox), m_limitName(new QLabel),
      m_limit(new QDoubleSpinBox),
      m_add(wordButton("breakAdd", tr("Add"), tr("Stop the run when this happens"))),
      m_remove(wordButton("breakRemove", tr("Remove"), tr("Forget the selected breakpoint"))),
      m_back(
          wordButton("breakBack", tr("Back to the last one"),
                     tr("Go back to the last frame before this one at which a breakpoint held (Shift+F9)"))),
      m_list(new QListWidget),
      m_state(new EmptyState(m_list, tr("Choose an event at the left and press Add: the run stops when it "
                                        "happens.\nShift+F9 finds the last one backwards."))) {
    setObjectName(QStringLiteral("breakpoints"));
    m_kind->setObjectName(QStringLiteral("breakKind"));
    m_a->setObjectName(QStringLiteral("breakA"));
    m_b->setObjectName(QStringLiteral("breakB"));
    m_axis->setObjectName(QStringLiteral("breakAxis"));
    m_limit->setObjectName(QStringLiteral("breakLimit"));
    m_kind->setAccessibleName(tr("Event"));
    m_a->setAccessibleName(tr("Body"));
    m_b->setAccessibleName(tr("Other body"));
    m_axis->setAccessibleName(tr("Axis"));
    m_limit->setAccessibleName(tr("Limit"));
    m_list->setAccessibleName(tr("Breakpoints"));
    for (const BreakKindRow& row : breakKinds()) m_kind->addItem(textOf(row.name));
    for (const char* axis : {"x", "y", "z"}) m_axis->addItem(QLatin1StringView(axis));
    m_limit->setDecimals(6);
    m_limit->setRange(-1e6, 1e6);
    m_limit->setSingleStep(0.1);
    layOut();
    connect(m_kind, &QComboBox::currentIndexChanged, this, &BreakpointsDock::showFields);
    connect(m_add, &QToolButton::clicked, this, &BreakpointsDock::add);
    connect(m_remove, &QToolButton::clicked, this, &BreakpointsDock::remove);
    connect(m_back, &QToolButton::clicked, this, &BreakpointsDock::backWanted);
    connect(m_list, &QListWidget::itemChanged, this, &BreakpointsDock::report);
    showFields();
    m_state->setEmpty(true);
}

void BreakpointsDock::layOut() {
    QFormLayout* form = new QFormLayout;
    form->setContentsMargins(0, 0, 0, 0);
    form->addRow(tr("stop at"), m_kind);
    form->addRow(tr("of"), m_a);
    form->addRow(tr("and"), m_b);
    form->addRow(tr("axis"), m_axis);
    form->addRow(m_limitName, m_limit);
    QHBoxLayout* buttons = new QHBoxLayout;
    buttons->addWidget(m_add);
    buttons->addWidget(m_remove);
    buttons->addStretch();
    buttons->addWidget(m_back);
    QVBoxLayout* column = new QVBoxLayout;
    column->addLayout(form);
    column->addLayout(buttons);
    column->addStretch();
    setWidget(besideControls(column, formWidth, m_state));
    setFocusProxy(m_kind);
}

void BreakpointsDock::showPipeline(std::shared_ptr<const Pipeline> pipeline) {
    if (pipeline != m_pipeline) {
        m_pipeline = std::move(pipeline);
        m_a->showPipeline(m_pipeline);
        m_b->showPipeline(m_pipeline);
    }
    report();
}

void BreakpointsDock::showFields() {
    const BreakKindRow& row = breakKinds()[static_cast<std::size_t>(m_kind->currentIndex())];
    m_a->setEnabled(row.bodies > 0);
    m_b->setEnabled(row.bodies > 1);
    m_axis->setEnabled(row.kind == BreakKind::PlaneCrossed);
    m_limit->setEnabled(!row.limit.empty());
    m_limitName->setText(row.limit.empty() ? tr("limit") : textOf(row.limit));
}

void BreakpointsDock::add() {
    const BreakKindRow& row = breakKinds()[static_cast<std::size_t>(m_kind->currentIndex())];
    Entry entry;
    entry.breakpoint.kind = row.kind;
    entry.breakpoint.limit = m_limit->value();
    entry.breakpoint.axis = m_axis->currentIndex();
    if (row.bodies > 0 && m_a->currentIndex() > 0) entry.a = m_a->currentText();
    if (row.bodies > 1 && m_b->currentIndex() > 0) entry.b = m_b->currentText();
    m_entries.push_back(entry);
    QListWidgetItem* item = new QListWidgetItem(wordsOf(entry));
    item->setFlags(item->flags() | Qt::ItemIsUserCheckable);
    item->setCheckState(Qt::Checked);
    m_list->addItem(item);
    report();
}

void BreakpointsDock::remove() {
    const int row = m_list->currentRow();
    if (row < 0) return;
    m_entries.erase(m_entries.begin() + row);
    delete m_list->takeItem(row);
    report();
}

BodyIndex BreakpointsDock::bodyNamed(const QString& name) const {
    return name.isEmpty() ? noBody : m_a->bodyAt(m_a->findText(name));
}

void BreakpointsDock::report() {
    m_set.clear();
    std::vector<Breakpoint> active;
    for (std::size_t i = 0; i < m_entries.size(); ++i) {
        const QListWidgetItem* item = m_list->item(static_cast<int>(i));
        if (item == nullptr || item->checkState() != Qt::Checked) continue;
        Breakpoint one = m_entries[i].breakpoint;
        one.a = bodyNamed(m_entries[i].a);
        one.b = bodyNamed(m_entries[i].b);
        const bool missing =
            (!m_entries[i].a.isEmpty() && one.a == noBody) || (!m_entries[i].b.isEmpty() && one.b == noBody);
        if (missing) continue;
        active.push_back(one);
        m_set.push_back(i);
    }
    m_back->setEnabled(!active.empty());
    m_remove->setEnabled(!m_entries.empty());
    m_state->setEmpty(m_entries.empty());
    Q_EMIT changed(active);
}

QString BreakpointsDock::titleOf(std::size_t breakpoint) const {
    return breakpoint < m_set.size() ? wordsOf(m_entries[m_set[breakpoint]]) : QString();
}

QString BreakpointsDock::wordsOf(const Entry& entry) const {
    const QString a = entry.a.isEmpty() ? tr("any body") : entry.a;
    const QString b = entry.b.isEmpty() ? tr("any body") : entry.b;
    const QString limit = QString::number(entry.breakpoint.limit);
    switch (entry.breakpoint.kind) {
    case BreakKind::Contact:
        return tr("contact of %1 and %2").arg(a, b);
    case BreakKind::Penetration:
        return tr("penetration over %1 m").arg(limit);
    case BreakKind::EnergyDrift:
        return tr("energy drift over %1").arg(limit);
    case BreakKind::Speed:
        return tr("%1 faster than %2 m/s").arg(a, limit);
    case BreakKind::PlaneCrossed:
        return tr("%1 crosses %2 = %3 m").arg(a, QString(QChar(u'x' + entry.breakpoint.axis)), limit);
    }
    return {};
}

} // namespace carom

#include "moc_breakpoints_dock.cpp"
