// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/actions.h"

#include "ui/base/settings.h"
#include "ui/base/theme.h"

#include <QMenu>
#include <QMenuBar>
#include <QToolBar>

#include <array>
#include <optional>

namespace carom {
namespace {

constexpr std::array rows = {
#define CAROM_ACTION(id, menu, text, shortcuts, icon, tip)                                                   \
    ActionRow{ActionId::id, #id, MenuId::menu, text, shortcuts, icon, tip},
#define CAROM_SEPARATOR(menu) ActionRow{{}, nullptr, MenuId::menu, nullptr, nullptr, nullptr, nullptr},
#include "ui/base/actions.def"
#undef CAROM_ACTION
#undef CAROM_SEPARATOR
};

struct MenuRow {
    MenuId id;
    const char* title;
    std::optional<MenuId> parent = {}; ///< of a menu within a menu
};

constexpr std::array menuRows = {
    MenuRow{MenuId::File, QT_TRANSLATE_NOOP("carom::Actions", "&File")},
    MenuRow{MenuId::Edit, QT_TRANSLATE_NOOP("carom::Actions", "&Edit")},
    MenuRow{MenuId::Text, QT_TRANSLATE_NOOP("carom::Actions", "&Text")},
    MenuRow{MenuId::Simulation, QT_TRANSLATE_NOOP("carom::Actions", "&Simulation")},
    MenuRow{MenuId::View, QT_TRANSLATE_NOOP("carom::Actions", "&View")},
    MenuRow{MenuId::Side, QT_TRANSLATE_NOOP("carom::Actions", "&Look from"), MenuId::View},
    MenuRow{MenuId::Drawn, QT_TRANSLATE_NOOP("carom::Actions", "&Overlays"), MenuId::View},
    MenuRow{MenuId::Workspace, QT_TRANSLATE_NOOP("carom::Actions", "Wo&rkspace"), MenuId::View},
    MenuRow{MenuId::Help, QT_TRANSLATE_NOOP("carom::Actions", "&Help")},
};

/// What the toolbar shows, in groups; the transport bar has the rest.
constexpr std::array toolbarGroups = {
    std::array{ActionId::New, ActionId::Open, ActionId::Save},
    std::array{ActionId::Undo, ActionId::Redo, ActionId::Find},
    std::array{ActionId::Screenshot, ActionId::FrameAll, ActionId::DarkTheme},
};

QList<QKeySequence> parsed(const char* shortcuts) {
    QList<QKeySequence> keys;
    for (const QString& key : QString::fromLatin1(shortcuts).split(u' ', Qt::SkipEmptyParts))
        keys.append(QKeySequence(key));
    return keys;
}

} // namespace

std::span<const ActionRow> actionRows() { return rows; }

Actions::Actions(QObject* parent) : QObject(parent) {
    for (const ActionRow& row : rows) {
        if (row.text == nullptr) continue;
        QAction* action = new QAction(tr(row.text), this);
        action->setObjectName(QString::fromUtf8(row.text).remove(u'&'));
        action->setStatusTip(tr(row.tip));
        m_actions[row.id] = action;
        setKeys(*action, parsed(row.shortcuts));
    }
}

void Actions::setKeys(QAction& action, const QList<QKeySequence>& keys) {
    action.setShortcuts(keys);
    const QString shown = action.shortcut().toString(QKeySequence::NativeText);
    action.setToolTip(shown.isEmpty() ? action.statusTip() : tr("%1 (%2)").arg(action.statusTip(), shown));
}

void Actions::takeKeys(const Settings& settings) {
    for (const ActionRow& row : rows) {
        if (row.text == nullptr) continue;
        const std::optional<QString> chosen = settings.keysOf(QString::fromLatin1(row.name));
        if (!chosen)
            setKeys(*m_actions[row.id], parsed(row.shortcuts));
        else if (chosen->isEmpty())
            setKeys(*m_actions[row.id], {});
        else
            setKeys(*m_actions[row.id], {QKeySequence(*chosen, QKeySequence::PortableText)});
    }
}

QList<QKeySequence> Actions::shortcuts() const {
    QList<QKeySequence> keys;
    for (const QAction* action : m_actions) keys.append(action->shortcuts());
    return keys;
}

void Actions::fill(QMenuBar& bar) {
    for (const MenuRow& row : menuRows)
        m_menus[row.id] =
            row.parent ? new QMenu(tr(row.title), m_menus[*row.parent]) : bar.addMenu(tr(row.title));
    for (const ActionRow& row : rows) {
        QMenu& menu = *m_menus[row.menu];
        if (row.text == nullptr)
            menu.addSeparator();
        else
            menu.addAction(m_actions[row.id]);
    }
    for (const MenuRow& row : menuRows)
        if (row.parent) m_menus[*row.parent]->addMenu(m_menus[row.id]);
}

void Actions::fill(QToolBar& bar) const {
    for (const auto& group : toolbarGroups) {
        if (&group != &toolbarGroups.front()) bar.addSeparator();
        for (const ActionId id : group) bar.addAction(m_actions[id]);
    }
}

void Actions::setTheme(const Theme& theme) {
    for (const ActionRow& row : rows)
        if (row.icon != nullptr && *row.icon != '\0')
            m_actions[row.id]->setIcon(theme.icon(QString::fromLatin1(row.icon)));
}

} // namespace carom

#include "moc_actions.cpp"
