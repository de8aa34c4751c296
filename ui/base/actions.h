// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QAction>
#include <QHash>
#include <QKeySequence>
#include <QList>
#include <QObject>

#include <cstdint>
#include <span>

class QMenu;
class QMenuBar;
class QToolBar;

namespace carom {

class Settings;
struct Theme;

enum class ActionId : std::uint8_t {
#define CAROM_ACTION(id, menu, text, shortcuts, icon, tip) id,
#define CAROM_SEPARATOR(menu)
#include "ui/base/actions.def"
#undef CAROM_ACTION
#undef CAROM_SEPARATOR
};

enum class MenuId : std::uint8_t { File, Edit, Text, Simulation, View, Side, Drawn, Workspace, Help };

struct ActionRow {
    ActionId id{};
    const char* name = nullptr; ///< of the id, for the settings
    MenuId menu{};
    const char* text = nullptr; ///< null for a separator
    const char* shortcuts = nullptr;
    const char* icon = nullptr;
    const char* tip = nullptr;
};

/// Every row of actions.def, separators included.
std::span<const ActionRow> actionRows();

/// Everything a user can do, as one table: owns the QActions and builds menus and toolbar from them. What an
/// action does is connected by whoever can do it.
class Actions : public QObject {
    Q_OBJECT
  public:
    explicit Actions(QObject* parent);

    QAction& operator[](ActionId id) const { return *m_actions[id]; }
    QMenu& menu(MenuId id) const { return *m_menus[id]; }
    /// Of all actions.
    QList<QKeySequence> shortcuts() const;

    /// The keys the user chose; the usual ones where none were.
    void takeKeys(const Settings& settings);

    void fill(QMenuBar& bar);
    void fill(QToolBar& bar) const;
    /// Icons in the theme's colours.
    void setTheme(const Theme& theme);

  private:
    void setKeys(QAction& action, const QList<QKeySequence>& keys);

    QHash<ActionId, QAction*> m_actions;
    QHash<MenuId, QMenu*> m_menus;
};

} // namespace carom
