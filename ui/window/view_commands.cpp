// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/view_commands.h"

#include "ui/docks/breakpoints_dock.h"
#include "ui/docks/inspector_dock.h"
#include "ui/editor/scene_editor.h"
#include "ui/viewport/viewport.h"
#include "ui/widgets/body_title.h"
#include "ui/base/actions.h"
#include "ui/window/live_preview.h"
#include "ui/window/main_window.h"

#include <QMenu>

#include <utility>

namespace carom {

ViewCommands::ViewCommands(MainWindow& window, const LivePreview& preview)
    : QObject(&window), m_window(window), m_preview(preview) {
    const Actions& actions = window.actions();
    Viewport& viewport = window.viewport();
    const std::pair<ActionId, ViewSide> sides[] = {
        {ActionId::ViewTop, ViewSide::Top},     {ActionId::ViewBottom, ViewSide::Bottom},
        {ActionId::ViewFront, ViewSide::Front}, {ActionId::ViewBack, ViewSide::Back},
        {ActionId::ViewLeft, ViewSide::Left},   {ActionId::ViewRight, ViewSide::Right},
    };
    for (const auto& row : sides)
        connect(&actions[row.first], &QAction::triggered, &viewport,
                [&viewport, side = row.second] { viewport.lookFrom(side); });
    QAction& orthographic = actions[ActionId::Orthographic];
    orthographic.setCheckable(true);
    connect(&orthographic, &QAction::toggled, &viewport, &Viewport::setOrthographic);
    connect(&viewport, &Viewport::orthographicChanged, &orthographic, &QAction::setChecked);
    connect(&viewport, &Viewport::menuWanted, this, &ViewCommands::showMenu);
}

QMenu* ViewCommands::menuOf(BodyIndex body) {
    const Actions& actions = m_window.actions();
    QMenu* menu = new QMenu(&m_window.viewport());
    if (body != noBody && m_preview.shown()) {
        QAction* title = menu->addAction(bodyTitle(m_preview.shown()->scene(), body));
        title->setEnabled(false);
        menu->addAction(tr("Go to its &declaration"), &m_window.editor(),
                        [this] { m_window.editor().setFocus(); });
        menu->addAction(tr("&Inspect"), &m_window, [this] { m_window.open(m_window.inspector()); });
        menu->addAction(&actions[ActionId::FrameSelection]);
        menu->addAction(&actions[ActionId::Breakpoint]);
        menu->addSeparator();
    }
    for (const ActionId id :
         {ActionId::FrameAll, ActionId::Orthographic, ActionId::CopyCamera, ActionId::SaveView})
        menu->addAction(&actions[id]);
    menu->addMenu(&actions.menu(MenuId::Side));
    menu->addMenu(&actions.menu(MenuId::Drawn));
    menu->addSeparator();
    for (const ActionId id : {ActionId::Play, ActionId::Step, ActionId::Reset}) menu->addAction(&actions[id]);
    return menu;
}

void ViewCommands::showMenu(const QPoint& place, BodyIndex body) {
    // What the menu does is done to the body it was opened on.
    if (body != noBody) {
        m_window.viewport().setSelectedBody(body);
        Q_EMIT m_window.viewport().bodyClicked(body);
    }
    QMenu* menu = menuOf(body);
    menu->setAttribute(Qt::WA_DeleteOnClose);
    menu->popup(place);
}

} // namespace carom

#include "moc_view_commands.cpp"
