// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/help_commands.h"

#include "ui/editor/scene_editor.h"
#include "ui/widgets/resources.h"
#include "ui/base/actions.h"
#include "ui/window/command_finder.h"
#include "ui/base/document.h"
#include "ui/window/file_commands.h"
#include "ui/window/main_window.h"
#include "ui/window/manual_window.h"
#include "ui/window/welcome.h"

#include "core/language/completion.h"

#include <QApplication>
#include <QMessageBox>

namespace carom {

HelpCommands::HelpCommands(MainWindow& window, Document& document, FileCommands& files, Settings& settings)
    : QObject(&window), m_window(window), m_document(document), m_files(files), m_settings(settings) {
    const Actions& actions = window.actions();
    const auto on = [&](ActionId id, auto method) {
        connect(&actions[id], &QAction::triggered, this, method);
    };
    on(ActionId::Manual, &HelpCommands::openManualAtCaret);
    on(ActionId::Tutorial, [this] { manual().open(QStringLiteral("tutorial")); });
    on(ActionId::KeysPage, [this] { manual().open(QStringLiteral("keys")); });
    on(ActionId::Welcome, &HelpCommands::showWelcome);
    on(ActionId::About, &HelpCommands::about);
    CommandFinder* finder = new CommandFinder(window);
    connect(&actions[ActionId::FindCommand], &QAction::triggered, finder, &CommandFinder::activate);
}

ManualWindow& HelpCommands::manual() {
    if (m_manual == nullptr) m_manual = new ManualWindow(m_window.actions(), &m_window);
    return *m_manual;
}

void HelpCommands::openManualAtCaret() {
    const SceneEditor& editor = m_window.editor();
    const std::optional<HoverText> word = hoverAt(analyse(editor.bytes().toStdString()), editor.caret());
    if (!word) {
        manual().open(QStringLiteral("language"));
        return;
    }
    // A label is about its body: "label of a sphere".
    const QString title = QString::fromStdString(word->title);
    const QString detail = QString::fromStdString(word->detail);
    const QString ofLabel = QStringLiteral("label of a ");
    manual().openLanguage(detail.startsWith(ofLabel) ? detail.mid(ofLabel.size()) : title);
}

void HelpCommands::showWelcome() {
    Welcome* welcome = new Welcome(m_settings, &m_window);
    welcome->setAttribute(Qt::WA_DeleteOnClose);
    const auto trigger = [this](ActionId id) { return [this, id] { m_window.actions()[id].trigger(); }; };
    connect(welcome, &Welcome::newWanted, this, trigger(ActionId::New));
    connect(welcome, &Welcome::templateWanted, this, trigger(ActionId::NewFrom));
    connect(welcome, &Welcome::openWanted, this, trigger(ActionId::Open));
    connect(welcome, &Welcome::tutorialWanted, this, trigger(ActionId::Tutorial));
    connect(welcome, &Welcome::fileWanted, &m_files, &FileCommands::open);
    connect(welcome, &Welcome::sceneWanted, this, [this](const QString& name) {
        if (m_files.mayDiscard()) m_document.startNew(resource(name));
    });
    welcome->open();
}

void HelpCommands::about() {
    QMessageBox::about(&m_window, tr("About Carom"),
                       tr("<h3>Carom %1</h3><p>Scenes of rigid bodies: written, watched, measured.</p>"
                          "<p>Free software under the GNU General Public License, version 3 or later.</p>")
                           .arg(QApplication::applicationVersion()));
}

} // namespace carom

#include "moc_help_commands.cpp"
