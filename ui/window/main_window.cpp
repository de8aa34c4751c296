// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/main_window.h"

#include "ui/docks/panels.h"
#include "ui/editor/find_bar.h"
#include "ui/editor/scene_editor.h"
#include "ui/viewport/viewport.h"
#include "ui/widgets/progress_strip.h"
#include "ui/widgets/timeline.h"
#include "ui/widgets/transport_bar.h"
#include "ui/base/actions.h"
#include "ui/base/plain_words.h"
#include "ui/base/settings.h"
#include "ui/window/workspaces.h"

#include <QApplication>
#include <QCloseEvent>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QMimeData>
#include <QSplitter>
#include <QStatusBar>
#include <QToolBar>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <array>
#include <type_traits>
#include <utility>

namespace carom {
namespace {

constexpr QSize firstSize{1500, 940};        // [px] of a window nobody has resized yet
constexpr const char* iconName = "iconName"; // property of a panel's action; `icon` is one of Qt's

constexpr int bottomHeight = 230; // [px] of the docks below
constexpr int statusRim = 12;     // [px] above and below the words of the status bar
constexpr int rightWidth = 300;   // [px] of the docks at the right

constexpr int noKey = -1;

struct PanelRow {
    Qt::DockWidgetArea place;
    int key; ///< with Alt
    const char* icon;
};

constexpr std::array panelRows = {
#define CAROM_PANEL(name, Name, place, key, icon) PanelRow{Qt::place##DockWidgetArea, key, icon},
#include "ui/docks/panels.def"
#undef CAROM_PANEL
};

/// Some panels are made in the colours of the theme, others know none.
template<class Dock>
Dock* made(const Theme& theme) {
    if constexpr (std::is_constructible_v<Dock, const Theme&>)
        return new Dock(theme);
    else
        return new Dock;
}

} // namespace

MainWindow::MainWindow(const Theme& theme, const Settings& settings)
    : m_actions(new Actions(this)), m_editor(new SceneEditor(theme)), m_findBar(new FindBar(*m_editor)),
      m_viewport(new Viewport), m_timeline(new Timeline), m_transport(new TransportBar(*m_actions)),
      m_buildProgress(new ProgressStrip(tr("Building"), (*m_actions)[ActionId::CancelBuild])),
      m_warning(new QLabel), m_memory(new QLabel), m_caret(new QLabel) {
    setAcceptDrops(true);
    setDockNestingEnabled(true);
    setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
    placeCentre();
    makePanels(theme);
    placePanels();
    m_actions->fill(*menuBar());
    QToolBar* toolbar = addToolBar(tr("Tools"));
    toolbar->setObjectName(QStringLiteral("tools"));
    toolbar->setIconSize({20, 20});
    toolbar->setMovable(false);
    m_actions->fill(*toolbar);
    addPanelToggles();
    addWorkspaceButtons(*toolbar);
    m_caret->setObjectName(QStringLiteral("caret"));
    m_caret->setProperty("role", QStringLiteral("muted"));
    m_caret->setContentsMargins(0, 0, 8, 0);
    statusBar()->addPermanentWidget(m_buildProgress);
    m_warning->setObjectName(QStringLiteral("warning"));
    m_warning->setProperty("role", QStringLiteral("error"));
    m_warning->setTextFormat(Qt::PlainText);
    m_warning->hide();
    statusBar()->addPermanentWidget(m_warning);
    m_memory->setObjectName(QStringLiteral("memoryInUse"));
    m_memory->setProperty("role", QStringLiteral("muted"));
    m_memory->setContentsMargins(0, 0, 8, 0);
    statusBar()->addPermanentWidget(m_memory);
    statusBar()->addPermanentWidget(m_caret);
    statusBar()->setSizeGripEnabled(false);
    // Else it grows when it first asks what it may show one day, and the picture shrinks.
    statusBar()->setFixedHeight(statusBar()->fontMetrics().height() + statusRim);
    releaseKeys();
    setTheme(theme);

    resize(firstSize);
    restoreGeometry(settings.windowGeometry());
    m_workspaces = new Workspaces(*this, *m_splitter, *m_actions);
    m_workspaces->restore(settings);
    m_viewport->drawIn(drawingPlace(settings.drawingPlace()).place); // late: it may have to wait for OpenGL
}

MainWindow::~MainWindow() = default;

void MainWindow::placeCentre() {
    QWidget* text = new QWidget;
    QVBoxLayout* textColumn = new QVBoxLayout(text);
    textColumn->setContentsMargins(0, 0, 0, 0);
    textColumn->setSpacing(0);
    textColumn->addWidget(m_editor, 1);
    textColumn->addWidget(m_findBar);

    m_splitter = new QSplitter(Qt::Horizontal);
    m_splitter->setHandleWidth(1);
    m_splitter->setChildrenCollapsible(false);
    m_splitter->addWidget(text);
    m_splitter->addWidget(m_viewport);

    QWidget* centre = new QWidget;
    QVBoxLayout* column = new QVBoxLayout(centre);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(m_splitter, 1);
    column->addWidget(m_timeline);
    column->addWidget(m_transport);
    setCentralWidget(centre);
}

void MainWindow::makePanels(const Theme& theme) {
#define CAROM_PANEL(name, Name, place, key, icon)                                                            \
    m_##name = made<Name##Dock>(theme);                                                                      \
    m_panels.push_back(m_##name);
#include "ui/docks/panels.def"
#undef CAROM_PANEL
}

void MainWindow::placePanels() {
    setCorner(Qt::BottomRightCorner, Qt::BottomDockWidgetArea);
    for (std::size_t i = 0; i < m_panels.size(); ++i) {
        addDockWidget(panelRows[i].place, m_panels[i]);
        m_panels[i]->setTitleBarWidget(new QWidget(m_panels[i])); // the tab says the name already
    }
    for (std::size_t i = 1; i < m_panels.size(); ++i)
        if (panelRows[i].place == panelRows[i - 1].place) tabifyDockWidget(m_panels[i - 1], m_panels[i]);
    m_problems->raise();
    m_outline->raise();
    resizeDocks({m_problems}, {bottomHeight}, Qt::Vertical);
    resizeDocks({m_effects}, {rightWidth}, Qt::Horizontal);
}

/// Alt+1 to Alt+9 and Alt+0 show a panel and put the keyboard into it; where it is already, they hide the
/// panel and go back to the text.
void MainWindow::addPanelToggles() {
    QMenu& view = *m_actions->menu(MenuId::View).addMenu(tr("&Panels"));
    for (int number = 1; number <= 10; ++number) {
        const auto row = std::find_if(panelRows.begin(), panelRows.end(),
                                      [&](const PanelRow& one) { return one.key == number % 10; });
        if (row == panelRows.end()) continue;
        Panel* panel = m_panels[static_cast<std::size_t>(row - panelRows.begin())];
        QAction* action = view.addAction(panel->windowTitle());
        action->setProperty(iconName, QString::fromLatin1(row->icon));
        action->setShortcut(QKeySequence(QStringLiteral("Alt+%1").arg(row->key)));
        action->setStatusTip(tr("Show or hide this panel"));
        addAction(action);
        action->setCheckable(true); // checked: in front
        connect(panel, &QDockWidget::visibilityChanged, action, &QAction::setChecked);
        connect(action, &QAction::triggered, panel, [this, panel, action] {
            const bool here = panel->isAncestorOf(QApplication::focusWidget());
            const bool takesFocus = panel->focusProxy() != nullptr;
            const bool wasInFront = panel->isVisible() && !panel->visibleRegion().isEmpty();
            const bool hides = here || (wasInFront && !takesFocus);
            panel->setVisible(!hides);
            if (hides) {
                m_editor->setFocus();
            } else {
                if (dockWidgetArea(panel) == Qt::BottomDockWidgetArea) m_workspaces->expand();
                panel->raise();
                if (takesFocus) panel->setFocus();
            }
            action->setChecked(!hides);
        });
    }
}

/// At the right end of the toolbar: one button a workspace, the current one pressed.
void MainWindow::addWorkspaceButtons(QToolBar& toolbar) {
    QWidget* gap = new QWidget;
    gap->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
    toolbar.addWidget(gap);
    for (const ActionId id : {ActionId::WorkspaceWrite, ActionId::WorkspaceWatch, ActionId::WorkspaceMeasure,
                              ActionId::WorkspaceStudy}) {
        toolbar.addAction(&(*m_actions)[id]);
        if (QToolButton* button = qobject_cast<QToolButton*>(toolbar.widgetForAction(&(*m_actions)[id])))
            button->setToolButtonStyle(Qt::ToolButtonTextOnly); // a name says more than a small picture
    }
}

void MainWindow::setTheme(const Theme& theme) {
    m_actions->setTheme(theme);
    m_editor->setTheme(theme);
    m_viewport->setDarkTheme(theme.dark);
    m_timeline->setTheme(theme);
    for (Panel* panel : m_panels) panel->setTheme(theme);
    for (QAction* action : QWidget::actions())
        if (action->property(iconName).isValid())
            action->setIcon(theme.icon(action->property(iconName).toString()));
}

void MainWindow::releaseKeys() { m_editor->releaseKeys(m_actions->shortcuts()); }

void MainWindow::open(QDockWidget& dock) {
    dock.show();
    if (dockWidgetArea(&dock) == Qt::BottomDockWidgetArea) m_workspaces->expand();
    dock.raise();
    dock.setFocus();
}

void MainWindow::tell(const QString& sentence, int milliseconds) {
    constexpr int gap = 24; // [px] to the place of the caret
    const int warning = m_warning->isHidden() ? 0 : m_warning->sizeHint().width();
    const int right = m_caret->sizeHint().width() + m_memory->sizeHint().width();
    const int room = statusBar()->width() - right - warning - gap;
    statusBar()->showMessage(statusBar()->fontMetrics().elidedText(sentence, Qt::ElideRight, room),
                             milliseconds);
}

void MainWindow::warn(const QString& sentence) {
    m_warning->setText(sentence);
    m_warning->setToolTip(plainTip(sentence));
    m_warning->setHidden(sentence.isEmpty());
}

void MainWindow::showMemory(const QString& words, const QString& tip) {
    m_memory->setText(words);
    m_memory->setToolTip(tip);
}

void MainWindow::showCaret(std::uint32_t line, std::uint32_t column) {
    m_caret->setText(tr("line %1, column %2").arg(line).arg(column));
}

void MainWindow::saveLayout(Settings& settings) const {
    settings.setWindowGeometry(saveGeometry());
    m_workspaces->save(settings);
}

void MainWindow::closeEvent(QCloseEvent* event) {
    if (m_mayClose && !m_mayClose())
        event->ignore();
    else
        event->accept();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
    if (event->mimeData()->urls().size() == 1) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
    const QList<QUrl> urls = event->mimeData()->urls();
    if (urls.size() == 1 && urls.first().isLocalFile()) Q_EMIT fileDropped(urls.first().toLocalFile());
}

} // namespace carom

#include "moc_main_window.cpp"
