// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/workspaces.h"

#include "ui/window/settings.h"

#include <QAction>
#include <QActionGroup>
#include <QDockWidget>
#include <QMainWindow>
#include <QSplitter>
#include <QTabBar>

#include <array>
#include <string_view>

namespace carom {
namespace {

struct WorkspaceRow {
    const char* name;
    const char* panels;
    ActionId action;
    int textShare;   ///< [%]
    int belowHeight; ///< [px]
};

constexpr std::array rows = {
#define CAROM_WORKSPACE(id, panels, text, below)                                                             \
    WorkspaceRow{#id, panels, ActionId::Workspace##id, text, below},
#include "ui/window/workspaces.def"
#undef CAROM_WORKSPACE
};

const WorkspaceRow& rowOf(WorkspaceId id) { return rows[static_cast<std::size_t>(id)]; }
QString nameOf(WorkspaceId id) { return QString::fromLatin1(rowOf(id).name); }

} // namespace

Workspaces::Workspaces(QMainWindow& window, QSplitter& splitter, const Actions& actions)
    : QObject(&window), m_window(window), m_splitter(splitter), m_actions(actions),
      m_pristine(window.saveState()) {
    QActionGroup* one = new QActionGroup(this);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        QAction& action = actions[rows[i].action];
        action.setCheckable(true);
        one->addAction(&action);
        connect(&action, &QAction::triggered, this, [this, i] { show(static_cast<WorkspaceId>(i)); });
    }
    connect(&actions[ActionId::ResetWorkspace], &QAction::triggered, this, &Workspaces::resetCurrent);
}

void Workspaces::restore(const Settings& settings) {
    const QString name = settings.workspace();
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (name == QLatin1String(rows[i].name)) m_current = static_cast<WorkspaceId>(i);
    actionOf(m_current).setChecked(true);
    arrange(m_current);
}

void Workspaces::save(Settings& settings) const {
    settings.setWorkspace(nameOf(m_current), m_window.saveState(), m_splitter.saveState());
}

/// Tab bars that Qt makes for tabbed panels draw a line of the platform's colour; ours have none.
void Workspaces::dropLinesUnderTabs() {
    for (QTabBar* bar : m_window.findChildren<QTabBar*>()) bar->setDrawBase(false);
}

void Workspaces::show(WorkspaceId id) {
    if (id == m_current) return;
    Settings settings;
    save(settings);
    m_current = id;
    actionOf(id).setChecked(true);
    arrange(id);
    save(settings);
}

void Workspaces::resetCurrent() {
    Settings().forgetWorkspace(nameOf(m_current));
    arrange(m_current);
}

/// As it was left, else as it came.
void Workspaces::arrange(WorkspaceId id) {
    const Settings settings;
    const WorkspaceRow& row = rowOf(id);
    const bool wasLeft = m_window.restoreState(settings.workspaceState(nameOf(id)));
    if (wasLeft) {
        m_splitter.restoreState(settings.workspaceSplitter(nameOf(id)));
        dropLinesUnderTabs();
        return;
    }
    m_window.restoreState(m_pristine);
    const QStringList panels = QString::fromLatin1(row.panels).split(u' ');
    const QList<QDockWidget*> docks = m_window.findChildren<QDockWidget*>();
    QList<QDockWidget*> below;
    for (QDockWidget* dock : docks) {
        const bool shown = panels.contains(dock->objectName()) || panels.contains(dock->objectName() + u'!');
        dock->setVisible(shown);
        if (shown && m_window.dockWidgetArea(dock) == Qt::BottomDockWidgetArea) below.append(dock);
    }
    for (QDockWidget* dock : docks) // when all tabs are there
        if (panels.contains(dock->objectName() + u'!')) dock->raise();
    if (!below.isEmpty()) m_window.resizeDocks({below.first()}, {row.belowHeight}, Qt::Vertical);
    constexpr int whole = 1000; // only the proportion counts
    m_splitter.setSizes({row.textShare * whole / 100, whole - row.textShare * whole / 100});
    dropLinesUnderTabs();
}

QAction& Workspaces::actionOf(WorkspaceId id) const { return m_actions[rowOf(id).action]; }

} // namespace carom

#include "moc_workspaces.cpp"
