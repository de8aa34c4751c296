// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/workspaces.h"

#include <QAction>
#include <QActionGroup>
#include <QDockWidget>
#include <QEvent>
#include <QMainWindow>
#include <QSplitter>
#include <QTabBar>

#include <algorithm>
#include <array>
#include <string_view>

namespace carom {
namespace {

struct WorkspaceRow {
    const char* name;
    const char* panels;
    ActionId action;
    int textShare;  ///< [%]
    int belowShare; ///< [%]
};

constexpr double rightShare = 0.2;
constexpr int leastText = 260;   // [px]
constexpr int leastRight = 240;  // [px]: a name and a value side by side
constexpr int leastCentre = 300; // [px] of the height, with timeline and transport, that panels below leave

constexpr std::array rows = {
#define CAROM_WORKSPACE(id, panels, text, below)                                                             \
    WorkspaceRow{#id, panels, ActionId::Workspace##id, text, below},
#include "ui/window/workspaces.def"
#undef CAROM_WORKSPACE
};

const WorkspaceRow& rowOf(WorkspaceId id) { return rows[static_cast<std::size_t>(id)]; }
WindowShares sharesOf(WorkspaceId id) {
    return {rowOf(id).textShare / 100.0, rightShare, rowOf(id).belowShare / 100.0};
}
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
    connect(&splitter, &QSplitter::splitterMoved, this, [this] { m_shares.text = measured().text; });
    window.installEventFilter(this);
}

/// The edges of panels are the window's own: it gets their mouse events.
bool Workspaces::eventFilter(QObject* watched, QEvent* event) {
    if (watched != &m_window) return false;
    if (event->type() == QEvent::Resize) // to be done when the window has laid itself out
        QMetaObject::invokeMethod(this, &Workspaces::divide, Qt::QueuedConnection);
    else if (event->type() == QEvent::MouseButtonPress)
        m_pressed = measured();
    else if (event->type() == QEvent::MouseButtonRelease)
        QMetaObject::invokeMethod(this, &Workspaces::noteDrag, Qt::QueuedConnection);
    return false;
}

/// One that is on screen there.
QDockWidget* Workspaces::panelIn(Qt::DockWidgetArea area) const {
    for (QDockWidget* dock : m_window.findChildren<QDockWidget*>())
        if (!dock->isFloating() && !dock->isHidden() && m_window.dockWidgetArea(dock) == area &&
            (!m_window.isVisible() || !dock->visibleRegion().isEmpty()))
            return dock;
    return nullptr;
}

void Workspaces::divide() {
    if (QDockWidget* right = panelIn(Qt::RightDockWidgetArea)) {
        const int width = static_cast<int>(m_shares.right * m_window.width());
        m_window.resizeDocks({right}, {std::max(leastRight, width)}, Qt::Horizontal);
    }
    if (QDockWidget* below = panelIn(Qt::BottomDockWidgetArea)) {
        const int height = static_cast<int>(m_shares.below * m_window.height());
        const int most = m_window.height() - leastCentre;
        m_window.resizeDocks({below}, {std::min(height, most)}, Qt::Vertical);
    }
    const int whole = std::max(1, m_splitter.width());
    const int text = std::max(std::min(leastText, whole / 2), static_cast<int>(m_shares.text * whole));
    m_splitter.setSizes({text, whole - text});
}

WindowShares Workspaces::measured() const {
    const auto share = [](int part, int whole) { return part / static_cast<double>(std::max(1, whole)); };
    const QList<int> halves = m_splitter.sizes();
    const QDockWidget* right = panelIn(Qt::RightDockWidgetArea);
    const QDockWidget* below = panelIn(Qt::BottomDockWidgetArea);
    return {share(halves[0], halves[0] + halves[1]), right ? share(right->width(), m_window.width()) : 0,
            below ? share(below->height(), m_window.height()) : 0};
}

/// What a drag has moved is where the user wants it; the rest may be where a small window put it.
void Workspaces::noteDrag() {
    const WindowShares now = measured();
    const auto take = [](double& share, double before, double after) {
        if (after > 0 && after != before) share = after;
    };
    take(m_shares.text, m_pressed.text, now.text);
    take(m_shares.right, m_pressed.right, now.right);
    take(m_shares.below, m_pressed.below, now.below);
    m_pressed = now;
}

void Workspaces::restore(const Settings& settings) {
    const QString name = settings.workspace();
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (name == QLatin1String(rows[i].name)) m_current = static_cast<WorkspaceId>(i);
    actionOf(m_current).setChecked(true);
    arrange(m_current);
}

void Workspaces::save(Settings& settings) const {
    settings.setWorkspace(nameOf(m_current), m_window.saveState(), m_shares);
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
    m_shares = settings.workspaceShares(nameOf(id)).value_or(sharesOf(id));
    const bool wasLeft = m_window.restoreState(settings.workspaceState(nameOf(id)));
    if (wasLeft) {
        divide();
        dropLinesUnderTabs();
        return;
    }
    m_window.restoreState(m_pristine);
    const QStringList panels = QString::fromLatin1(row.panels).split(u' ');
    const QList<QDockWidget*> docks = m_window.findChildren<QDockWidget*>();
    for (QDockWidget* dock : docks) {
        const bool shown = panels.contains(dock->objectName()) || panels.contains(dock->objectName() + u'!');
        dock->setVisible(shown);
    }
    for (QDockWidget* dock : docks) // when all tabs are there
        if (panels.contains(dock->objectName() + u'!')) dock->raise();
    divide();
    dropLinesUnderTabs();
}

QAction& Workspaces::actionOf(WorkspaceId id) const { return m_actions[rowOf(id).action]; }

} // namespace carom

#include "moc_workspaces.cpp"
