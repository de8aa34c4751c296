// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/docks/stability_dock.h"

#include "core/study/stability_report.h"
#include "ui/base/export_menu.h"
#include "ui/base/file_output.h"
#include "ui/widgets/text_of.h"

#include <QCheckBox>
#include <QCoreApplication>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSysInfo>
#include <QTreeWidget>
#include <QVBoxLayout>

#include <algorithm>

namespace carom {
namespace {

enum Column { Case, Answer, FirstVerdict };

constexpr int caseRole = Qt::UserRole;

QString spoken(const HardCase& hardCase) { return QString::fromStdString(spokenName(hardCase)); }

int columnOf(StudyColumn column) { return FirstVerdict + static_cast<int>(column); }

} // namespace

StabilityDock::StabilityDock(const Theme& theme, QWidget* parent)
    : Panel(tr("Stability"), parent), m_theme(theme), m_button(new QPushButton),
      m_export(new QPushButton(tr("Export…"))), m_long(new QCheckBox(tr("long forms"))),
      m_progress(new QProgressBar), m_state(new QLabel), m_table(new QTreeWidget) {
    setObjectName(QStringLiteral("stability"));
    m_button->setObjectName(QStringLiteral("runStability"));
    m_export->setObjectName(QStringLiteral("exportStability"));
    m_export->setToolTip(tr("Write every figure as CSV"));
    m_long->setToolTip(tr("The cases as published, which take hours in all; otherwise their short forms"));
    m_progress->setTextVisible(false);
    m_progress->setMaximumSize(120, 12);
    m_state->setObjectName(QStringLiteral("stabilityState"));
    m_state->setTextFormat(Qt::PlainText); // names of files, too
    m_state->setProperty("role", QStringLiteral("muted"));
    m_table->setAccessibleName(tr("Hard cases"));
    m_table->setSelectionMode(QAbstractItemView::ExtendedSelection);
    m_table->setHeaderLabels({tr("Case"), tr("Right answer"), tr("Default"), tr("Accurate"), tr("Exact")});
    m_table->setToolTip(tr("Double-click a case to open it as a scene, in the column's setting"));
    m_table->setUniformRowHeights(true);
    m_table->setRootIsDecorated(false);
    m_table->setAllColumnsShowFocus(true);
    fillCases();

    QHBoxLayout* top = new QHBoxLayout;
    for (QWidget* widget : std::initializer_list<QWidget*>{m_button, m_long, m_progress})
        top->addWidget(widget);
    top->addWidget(m_state, 1);
    top->addWidget(m_export);
    QWidget* page = new QWidget;
    QVBoxLayout* column = new QVBoxLayout(page);
    column->setContentsMargins(6, 4, 6, 6);
    column->addLayout(top);
    column->addWidget(m_table, 1);
    setWidget(page);
    setFocusProxy(m_table);

    connect(m_button, &QPushButton::clicked, this, &StabilityDock::startOrStop);
    connect(&m_runner, &StudyRunner::failed, this, [this](const QString& sentence) {
        updateControls();
        m_state->setText(sentence);
        Q_EMIT reported(sentence);
    });
    connect(m_export, &QPushButton::clicked, this,
            [this] { askForExport(QStringLiteral("stability"), QStringLiteral("csv")); });
    connect(m_table, &QTreeWidget::itemSelectionChanged, this, &StabilityDock::updateControls);
    connect(m_table, &QTreeWidget::itemActivated, this, &StabilityDock::open);
    updateControls();
}

void StabilityDock::fillCases() {
    for (const HardCase& row : hardCases()) {
        QTreeWidgetItem* item = new QTreeWidgetItem(m_table);
        item->setText(Case, QStringLiteral("%1 %2").arg(row.number, 2).arg(spoken(row)));
        item->setToolTip(Case, textOf(row.title));
        item->setText(Answer, textOf(row.answer));
        item->setToolTip(Answer, textOf(row.title) + QStringLiteral(": ") + textOf(row.answer));
        item->setData(Case, caseRole, row.number);
        for (const StudyColumn column : studyColumns) {
            const std::string_view limit = column == StudyColumn::Default ? row.byDefault : row.accurate;
            item->setText(columnOf(column), row.has(column) ? QString() : QStringLiteral("–"));
            item->setToolTip(columnOf(column), row.has(column)
                                                   ? tr("not run yet; it must hold: %1").arg(textOf(limit))
                                                   : tr("does not apply"));
        }
    }
    m_table->header()->setSectionResizeMode(Case, QHeaderView::ResizeToContents);
    m_table->header()->setSectionResizeMode(Answer, QHeaderView::Stretch);
    for (const StudyColumn column : studyColumns)
        m_table->header()->setSectionResizeMode(columnOf(column), QHeaderView::ResizeToContents);
    m_table->header()->setStretchLastSection(false);
}

QTreeWidgetItem* StabilityDock::itemOf(const HardCase& hardCase) const {
    for (int row = 0; row < m_table->topLevelItemCount(); ++row)
        if (m_table->topLevelItem(row)->data(Case, caseRole).toInt() == hardCase.number)
            return m_table->topLevelItem(row);
    return nullptr;
}

void StabilityDock::updateControls() {
    const qsizetype selected = m_table->selectedItems().size();
    m_button->setText(m_runner.isRunning() ? tr("Stop")
                      : selected > 0       ? tr("Run the %n selected", nullptr, static_cast<int>(selected))
                                           : tr("Run all"));
    m_long->setEnabled(!m_runner.isRunning());
    m_progress->setVisible(m_runner.isRunning());
    m_export->setEnabled(!m_study.results.empty());
}

void StabilityDock::startOrStop() {
    if (m_runner.isRunning()) {
        m_runner.stop();
        return;
    }
    std::vector<const HardCase*> cases;
    for (const HardCase& row : hardCases()) {
        const QTreeWidgetItem* item = itemOf(row);
        if (item->isSelected() || m_table->selectedItems().isEmpty()) cases.push_back(&row);
    }
    run(std::move(cases));
}

void StabilityDock::run(std::vector<const HardCase*> cases) {
    if (m_runner.isRunning() || cases.empty()) return;
    StabilityPlan plan;
    plan.cases = std::move(cases);
    plan.length = m_long->isChecked() ? StudyLength::Long : StudyLength::Short;
    m_progress->setRange(0, static_cast<int>(plan.cases.size() * plan.columns.size()));
    m_progress->setValue(0);
    m_runner.start([this, plan](const std::stop_token& stop) { return work(stop, plan); });
    updateControls();
}

// On the thread: whatever touches a widget is handed to the GUI's.
StudyRunner::Finish StabilityDock::work(const std::stop_token& stop, const StabilityPlan& plan) {
    StabilityListener listener;
    listener.goOn = [&stop] { return !stop.stop_requested(); };
    listener.starts = [this](const HardCase& hardCase, StudyColumn column) {
        const QString text = tr("%1, %2").arg(spoken(hardCase), textOf(nameOf(column)));
        QMetaObject::invokeMethod(
            this, [this, text] { m_state->setText(text); }, Qt::QueuedConnection);
    };
    listener.ends = [this](const TrialResult& result) {
        QMetaObject::invokeMethod(
            this, [this, result] { take(result); }, Qt::QueuedConnection);
    };
    const bool complete = runStability(plan, listener).complete;
    return [this, complete] { finish(complete); };
}

void StabilityDock::take(const TrialResult& result) {
    m_progress->setValue(m_progress->value() + 1);
    const auto isOld = [&](const TrialResult& old) {
        return old.hardCase == result.hardCase && old.column == result.column;
    };
    std::erase_if(m_study.results, isOld);
    m_study.results.push_back(result);
    showResult(result);
}

void StabilityDock::showResult(const TrialResult& result) {
    if (result.verdict == Verdict::NotApplicable) return;
    const bool holds = result.verdict == Verdict::Holds;
    QTreeWidgetItem* item = itemOf(*result.hardCase);
    const int column = columnOf(result.column);
    QString text = holds ? tr("holds") : tr("fails");
    if (const Figure* figure = result.decisive(); figure != nullptr)
        text += QStringLiteral(": ") + QString::fromStdString(describe(*figure));
    item->setText(column, text);
    item->setForeground(column, holds ? m_theme.good : m_theme.error);
    QString all = tr("%1 s").arg(result.seconds, 0, 'g', 2);
    for (const Figure& figure : result.figures)
        all += QStringLiteral("\n") + (figure.holds() ? QStringLiteral("  ") : QStringLiteral("! ")) +
               QString::fromStdString(describe(figure));
    item->setToolTip(column, all);
}

void StabilityDock::finish(bool complete) {
    QStringList tallies;
    for (const StudyColumn column : studyColumns) tallies += QString::fromStdString(tallyOf(m_study, column));
    m_state->setText((complete ? QString() : tr("Stopped. ")) + tallies.join(QStringLiteral("; ")));
    updateControls();
    Q_EMIT reported(tr("hard cases: %1").arg(m_state->text()));
}

void StabilityDock::setTheme(const Theme& theme) {
    m_theme = theme;
    for (const TrialResult& result : m_study.results) showResult(result);
}

void StabilityDock::open(QTreeWidgetItem* item, int column) {
    const HardCase* hardCase = findHardCase(item->data(Case, caseRole).toString().toStdString());
    StudyColumn wanted = hardCase->has(StudyColumn::Default) ? StudyColumn::Default : StudyColumn::Exact;
    for (const StudyColumn candidate : studyColumns)
        if (columnOf(candidate) == column && hardCase->has(candidate)) wanted = candidate;
    Q_EMIT sceneWanted(textOf(hardCase->name), QByteArray::fromStdString(sceneOf(*hardCase, wanted)));
}

QString StabilityDock::exportTo(const QString& path) const {
    const std::string version = QCoreApplication::applicationVersion().toStdString();
    const QString machine =
        QSysInfo::prettyProductName() + QLatin1Char(' ') + QSysInfo::currentCpuArchitecture();
    return saveFile(path, figuresAsCsv(m_study, {"carom, Stability panel", version, machine.toStdString()}));
}

} // namespace carom

#include "moc_stability_dock.cpp"
