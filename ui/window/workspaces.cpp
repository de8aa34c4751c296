// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/workspaces.h"

#include <QAction>
#include <QActionGroup>
#include <QApplication>
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
    QAction& collapses = actions[ActionId::CollapsePanels];
    collapses.setCheckable(true);
    connect(&collapses, &QAction::toggled, this, &Workspaces::collapse);
    for (QDockWidget* dock : window.findChildren<QDockWidget*>()) {
        connect(dock, &QDockWidget::dockLocationChanged, this, [this, dock] { limitHeight(*dock); });
        connect(dock, &QDockWidget::topLevelChanged, this, [this, dock] { limitHeight(*dock); });
    }
    connect(&splitter, &QSplitter::splitterMoved, this, [this] { m_shares.text = measured().text; });
    window.installEventFilter(this);
}

/// The edges of panels are the window's own: it gets their mouse events.
bool Workspaces::eventFilter(QObject* watched, QEvent* event) {
    if (watched != &m_window) return false;
    if (event->type() == QEvent::Resize) // to be done when the window has laid itself out
        QMetaObject::invokeMethod(this, &Workspaces::divide, Qt::QueuedConnection);
    else if (event->type() == QEvent::ChildPolished) // tabs of panels that were not beside each other before
        dressTabs();
    else if (event->type() == QEvent::MouseButtonPress)
        m_pressed = measured();
    else if (event->type() == QEvent::MouseButtonRelease)
        QMetaObject::invokeMethod(this, &Workspaces::noteDrag, Qt::QueuedConnection);
    return false;
}

QDockWidget* Workspaces::panelIn(Qt::DockWidgetArea area, Where where) const {
    const bool all = where == Where::Anywhere || !m_window.isVisible();
    for (QDockWidget* dock : m_window.findChildren<QDockWidget*>())
        if (!dock->isFloating() && !dock->isHidden() && m_window.dockWidgetArea(dock) == area &&
            (all || !dock->visibleRegion().isEmpty()))
            return dock;
    return nullptr;
}

void Workspaces::divide() {
    if (QDockWidget* right = panelIn(Qt::RightDockWidgetArea)) {
        const int width = static_cast<int>(m_shares.right * m_window.width());
        m_window.resizeDocks({right}, {std::max(leastRight, width)}, Qt::Horizontal);
    }
    QDockWidget* below = panelIn(Qt::BottomDockWidgetArea);
    if (below == nullptr) below = panelIn(Qt::BottomDockWidgetArea, Where::Anywhere); // until now collapsed
    if (below != nullptr) {
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
    m_actions[ActionId::CollapsePanels].setChecked(settings.collapsesPanels());
}

void Workspaces::save(Settings& settings) const {
    settings.setWorkspace(nameOf(m_current), m_window.saveState(), m_shares);
}

/// Tab bars that Qt makes for tabbed panels draw a line of the platform's colour; ours have none.
void Workspaces::dressTabs() {
    for (QTabBar* bar : m_window.findChildren<QTabBar*>(Qt::FindDirectChildrenOnly)) {
        if (!bar->drawBase()) continue; // known
        bar->setDrawBase(false);
        connect(bar, &QTabBar::tabBarClicked, this, [this, bar] {
            m_clickExpands = isBelow(*bar) && m_actions[ActionId::CollapsePanels].isChecked();
            if (m_clickExpands) expand();
        });
        // A double click is told of before its second click, which would bring them back at once: so done
        // later.
        connect(bar, &QTabBar::tabBarDoubleClicked, this, [this, bar] {
            if (!isBelow(*bar) || m_clickExpands) return;
            QAction& collapses = m_actions[ActionId::CollapsePanels];
            QMetaObject::invokeMethod(
                &collapses, [&collapses] { collapses.setChecked(true); }, Qt::QueuedConnection);
        });
    }
}

/// Qt makes one bar for the panels of a place, and names its tabs after them.
bool Workspaces::isBelow(const QTabBar& tabs) const {
    for (QDockWidget* dock : m_window.findChildren<QDockWidget*>())
        if (tabs.count() > 0 && dock->windowTitle() == tabs.tabText(0))
            return m_window.dockWidgetArea(dock) == Qt::BottomDockWidgetArea;
    return false;
}

/// What a collapsed panel holds has no height to speak of: nothing is left of its place but the tabs.
void Workspaces::limitHeight(QDockWidget& dock) {
    const bool hides = m_actions[ActionId::CollapsePanels].isChecked() && !dock.isFloating() &&
                       m_window.dockWidgetArea(&dock) == Qt::BottomDockWidgetArea;
    dock.widget()->setMaximumHeight(hides ? 1 : QWIDGETSIZE_MAX); // 0 makes Qt compute -1 for the panel
    if (hides && dock.isAncestorOf(QApplication::focusWidget())) m_splitter.setFocus();
}

void Workspaces::limitHeights() {
    for (QDockWidget* dock : m_window.findChildren<QDockWidget*>()) limitHeight(*dock);
}

void Workspaces::collapse(bool collapsed) {
    Settings().setCollapsesPanels(collapsed);
    limitHeights();
    if (!collapsed) QMetaObject::invokeMethod(this, &Workspaces::divide, Qt::QueuedConnection);
}

void Workspaces::expand() { m_actions[ActionId::CollapsePanels].setChecked(false); }

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
    if (!m_window.restoreState(settings.workspaceState(nameOf(id)))) arrangeAnew(row.panels);
    limitHeights();
    divide();
    dressTabs();
}

void Workspaces::arrangeAnew(const char* names) {
    m_window.restoreState(m_pristine);
    const QStringList panels = QString::fromLatin1(names).split(u' ');
    const QList<QDockWidget*> docks = m_window.findChildren<QDockWidget*>();
    for (QDockWidget* dock : docks) {
        const bool shown = panels.contains(dock->objectName()) || panels.contains(dock->objectName() + u'!');
        dock->setVisible(shown);
    }
    for (QDockWidget* dock : docks) // when all tabs are there
        if (panels.contains(dock->objectName() + u'!')) dock->raise();
}

QAction& Workspaces::actionOf(WorkspaceId id) const { return m_actions[rowOf(id).action]; }

} // namespace carom

#include "moc_workspaces.cpp"
