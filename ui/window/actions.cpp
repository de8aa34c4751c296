// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/actions.h"

#include "ui/window/theme.h"

#include <QMenu>
#include <QMenuBar>
#include <QToolBar>

#include <array>

namespace carom {
namespace {

constexpr std::array rows = {
#define CAROM_ACTION(id, menu, text, shortcuts, icon, tip)                                                   \
    ActionRow{ActionId::id, MenuId::menu, text, shortcuts, icon, tip},
#define CAROM_SEPARATOR(menu) ActionRow{{}, MenuId::menu, nullptr, nullptr, nullptr, nullptr},
#include "ui/window/actions.def"
#undef CAROM_ACTION
#undef CAROM_SEPARATOR
};

struct MenuRow {
    MenuId id;
    const char* title;
};

constexpr std::array menuRows = {
    MenuRow{MenuId::File, QT_TRANSLATE_NOOP("carom::Actions", "&File")},
    MenuRow{MenuId::Edit, QT_TRANSLATE_NOOP("carom::Actions", "&Edit")},
    MenuRow{MenuId::Text, QT_TRANSLATE_NOOP("carom::Actions", "&Text")},
    MenuRow{MenuId::Simulation, QT_TRANSLATE_NOOP("carom::Actions", "&Simulation")},
    MenuRow{MenuId::View, QT_TRANSLATE_NOOP("carom::Actions", "&View")},
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
        action->setShortcuts(parsed(row.shortcuts));
        action->setStatusTip(tr(row.tip));
        const QString keys = action->shortcut().toString(QKeySequence::NativeText);
        action->setToolTip(keys.isEmpty() ? tr(row.tip) : tr("%1 (%2)").arg(tr(row.tip), keys));
        m_actions[row.id] = action;
    }
}

QList<QKeySequence> Actions::shortcuts() const {
    QList<QKeySequence> keys;
    for (const QAction* action : m_actions) keys.append(action->shortcuts());
    return keys;
}

void Actions::fill(QMenuBar& bar) {
    for (const MenuRow& row : menuRows) m_menus[row.id] = bar.addMenu(tr(row.title));
    for (const ActionRow& row : rows) {
        QMenu& menu = *m_menus[row.menu];
        if (row.text == nullptr)
            menu.addSeparator();
        else
            menu.addAction(m_actions[row.id]);
    }
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
