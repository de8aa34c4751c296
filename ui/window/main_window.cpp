// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/main_window.h"

#include "ui/docks/accuracy_dock.h"
#include "ui/docks/breakpoints_dock.h"
#include "ui/docks/broadphase_dock.h"
#include "ui/docks/effects_dock.h"
#include "ui/docks/outline_dock.h"
#include "ui/docks/inspector_dock.h"
#include "ui/docks/output_dock.h"
#include "ui/docks/plots_dock.h"
#include "ui/docks/problems_dock.h"
#include "ui/docks/stability_dock.h"
#include "ui/docks/timing_dock.h"
#include "ui/editor/find_bar.h"
#include "ui/editor/scene_editor.h"
#include "ui/viewport/viewport.h"
#include "ui/widgets/progress_strip.h"
#include "ui/widgets/timeline.h"
#include "ui/widgets/transport_bar.h"
#include "ui/window/actions.h"
#include "ui/window/settings.h"
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

#include <array>
#include <utility>

namespace carom {
namespace {

constexpr QSize firstSize{1500, 940};        // [px] of a window nobody has resized yet
constexpr const char* iconName = "iconName"; // property of a panel's action; `icon` is one of Qt's

constexpr int bottomHeight = 230; // [px] of the docks below
constexpr int statusRim = 12;     // [px] above and below the words of the status bar
constexpr int rightWidth = 300;   // [px] of the docks at the right

} // namespace

MainWindow::MainWindow(const Theme& theme, const Settings& settings)
    : m_actions(new Actions(this)), m_editor(new SceneEditor(theme)), m_findBar(new FindBar(*m_editor)),
      m_viewport(new Viewport), m_timeline(new Timeline), m_transport(new TransportBar(*m_actions)),
      m_problems(new ProblemsDock(theme)), m_timing(new TimingDock), m_broadphase(new BroadphaseDock),
      m_accuracy(new AccuracyDock), m_outline(new OutlineDock(theme)), m_effects(new EffectsDock(theme)),
      m_inspector(new InspectorDock), m_plots(new PlotsDock), m_breakpoints(new BreakpointsDock),
      m_output(new OutputDock), m_stability(new StabilityDock(theme)),
      m_buildProgress(new ProgressStrip(tr("Building"), (*m_actions)[ActionId::CancelBuild])),
      m_warning(new QLabel), m_memory(new QLabel), m_caret(new QLabel) {
    setAcceptDrops(true);
    setDockNestingEnabled(true);
    setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
    placeCentre();
    placeDocks();
    m_actions->fill(*menuBar());
    QToolBar* toolbar = addToolBar(tr("Tools"));
    toolbar->setObjectName(QStringLiteral("tools"));
    toolbar->setIconSize({20, 20});
    toolbar->setMovable(false);
    m_actions->fill(*toolbar);
    addDockToggles();
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

void MainWindow::placeDocks() {
    setCorner(Qt::BottomRightCorner, Qt::BottomDockWidgetArea);
    addDockWidget(Qt::BottomDockWidgetArea, m_problems);
    addDockWidget(Qt::BottomDockWidgetArea, m_timing);
    addDockWidget(Qt::BottomDockWidgetArea, m_broadphase);
    addDockWidget(Qt::BottomDockWidgetArea, m_plots);
    addDockWidget(Qt::BottomDockWidgetArea, m_accuracy);
    addDockWidget(Qt::BottomDockWidgetArea, m_breakpoints);
    addDockWidget(Qt::BottomDockWidgetArea, m_output);
    addDockWidget(Qt::BottomDockWidgetArea, m_stability);
    addDockWidget(Qt::RightDockWidgetArea, m_outline);
    addDockWidget(Qt::RightDockWidgetArea, m_inspector);
    addDockWidget(Qt::RightDockWidgetArea, m_effects);
    for (QDockWidget* dock : std::initializer_list<QDockWidget*>{
             m_problems, m_timing, m_broadphase, m_plots, m_accuracy, m_breakpoints, m_output, m_stability,
             m_outline, m_inspector, m_effects})
        dock->setTitleBarWidget(new QWidget(dock)); // the tab says the name already
    tabifyDockWidget(m_problems, m_timing);
    tabifyDockWidget(m_timing, m_broadphase);
    tabifyDockWidget(m_broadphase, m_plots);
    tabifyDockWidget(m_plots, m_accuracy);
    tabifyDockWidget(m_accuracy, m_breakpoints);
    tabifyDockWidget(m_breakpoints, m_output);
    tabifyDockWidget(m_output, m_stability);
    tabifyDockWidget(m_outline, m_inspector);
    tabifyDockWidget(m_inspector, m_effects);
    m_problems->raise();
    m_outline->raise();
    resizeDocks({m_problems}, {bottomHeight}, Qt::Vertical);
    resizeDocks({m_effects}, {rightWidth}, Qt::Horizontal);
}

/// Alt+1 to Alt+9 and Alt+0 show a panel and put the keyboard into it; where it is already, they hide the
/// panel and go back to the text.
void MainWindow::addDockToggles() {
    const std::array<std::pair<QDockWidget*, const char*>, 10> docks = {{{m_problems, "problems"},
                                                                         {m_timing, "timing"},
                                                                         {m_broadphase, "broadphase"},
                                                                         {m_plots, "plots"},
                                                                         {m_accuracy, "accuracy"},
                                                                         {m_output, "output"},
                                                                         {m_outline, "outline"},
                                                                         {m_inspector, "inspector"},
                                                                         {m_effects, "effects"},
                                                                         {m_stability, "stability"}}};
    QMenu& view = *m_actions->menu(MenuId::View).addMenu(tr("&Panels"));
    int number = 0;
    for (const auto& [dock, icon] : docks) {
        QAction* action = view.addAction(dock->windowTitle());
        action->setProperty(iconName, QString::fromLatin1(icon));
        action->setShortcut(QKeySequence(QStringLiteral("Alt+%1").arg(++number % 10)));
        action->setStatusTip(tr("Show or hide this panel"));
        addAction(action);
        action->setCheckable(true); // checked: in front
        connect(dock, &QDockWidget::visibilityChanged, action, &QAction::setChecked);
        connect(action, &QAction::triggered, dock, [this, panel = dock, action] {
            const bool here = panel->isAncestorOf(QApplication::focusWidget());
            const bool takesFocus = panel->focusProxy() != nullptr;
            const bool wasInFront = panel->isVisible() && !panel->visibleRegion().isEmpty();
            const bool hides = here || (wasInFront && !takesFocus);
            panel->setVisible(!hides);
            if (hides) {
                m_editor->setFocus();
            } else {
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
    m_problems->setTheme(theme);
    m_outline->setTheme(theme);
    m_effects->setTheme(theme);
    m_stability->setTheme(theme);
    for (QAction* action : QWidget::actions())
        if (action->property(iconName).isValid())
            action->setIcon(theme.icon(action->property(iconName).toString()));
}

void MainWindow::releaseKeys() { m_editor->releaseKeys(m_actions->shortcuts()); }

void MainWindow::open(QDockWidget& dock) {
    dock.show();
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
    m_warning->setToolTip(sentence);
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
