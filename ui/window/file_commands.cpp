// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/file_commands.h"

#include "ui/base/file_output.h"
#include "ui/editor/scene_editor.h"
#include "ui/base/plain_words.h"
#include "ui/base/save_dialog.h"
#include "ui/base/actions.h"
#include "ui/window/main_window.h"
#include "ui/window/new_scene_dialog.h"
#include "ui/window/outside_dialog.h"
#include "ui/base/settings.h"
#include "ui/base/theme.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QMenu>
#include <QMessageBox>
#include <QTimer>

#include <utility>

namespace carom {
namespace {

const QString sceneFilter = QStringLiteral("Scenes (*.sdl);;All files (*)");

} // namespace

FileCommands::FileCommands(Document& document, MainWindow& window, Settings& settings)
    : QObject(&window), m_document(document), m_window(window), m_settings(settings) {
    const Actions& actions = window.actions();
    const auto on = [&](ActionId id, auto method) {
        connect(&actions[id], &QAction::triggered, this, method);
    };
    on(ActionId::New, &FileCommands::startNew);
    on(ActionId::NewFrom, &FileCommands::startFromGenerator);
    on(ActionId::Open, &FileCommands::askAndOpen);
    on(ActionId::Save, &FileCommands::save);
    on(ActionId::SaveAs, &FileCommands::saveAs);
    on(ActionId::Reload, &FileCommands::reload);
    on(ActionId::Screenshot, &FileCommands::savePicture);
    connect(&actions[ActionId::Quit], &QAction::triggered, &window, &QWidget::close);

    QMenu* recent = new QMenu(&window);
    actions[ActionId::Recent].setMenu(recent);
    connect(recent, &QMenu::aboutToShow, this, &FileCommands::fillRecent);
    // By its key; in the File menu it opens beside its entry.
    connect(&actions[ActionId::Recent], &QAction::triggered, this, [this, recent] {
        recent->popup(m_window.mapToGlobal(QPoint(m_window.width() / 3, m_window.height() / 5)));
    });
    fillRecent();

    connect(&document, &Document::pathChanged, this, &FileCommands::updateTitle);
    connect(&document, &Document::pathChanged, this, [this] {
        if (!m_document.path().isEmpty()) rememberFolderOf(m_document.path());
    });
    connect(&document, &Document::changedOutside, this, &FileCommands::reactToOutsideChange);
    connect(&document, &Document::removedOutside, this, &FileCommands::reactToRemoval);
    connect(&window.editor(), &SceneEditor::savedStateChanged, this, &FileCommands::updateTitle);
    const auto openDropped = [this](const QString& path) { open(path); };
    connect(&window.editor(), &SceneEditor::fileDropped, this, openDropped);
    connect(&window, &MainWindow::fileDropped, this, openDropped);
    window.setMayClose([this] { return mayDiscard(); });
    updateTitle();
}

bool FileCommands::open(const QString& path) {
    if (!mayDiscard()) return false;
    const bool opened = finish(m_document.open(path), tr("opened %1").arg(path));
    if (opened) {
        m_settings.addRecentFile(m_document.path());
        fillRecent();
    }
    return opened;
}

bool FileCommands::openText(const QString& name, const QByteArray& text) {
    if (!mayDiscard()) return false;
    m_document.startNew(text);
    Q_EMIT reported(tr("opened %1 as a new scene").arg(name));
    return true;
}

bool FileCommands::mayDiscard() {
    if (!m_document.isModified()) return true;
    QMessageBox box(QMessageBox::Question, tr("Unsaved changes"),
                    tr("“%1” has changes that are not saved.").arg(m_document.name()),
                    QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, &m_window);
    box.setTextFormat(Qt::PlainText); // a file may be called anything
    box.setDefaultButton(QMessageBox::Save);
    const int answer = ask(box);
    if (answer == QMessageBox::Save) return save();
    return answer == QMessageBox::Discard;
}

void FileCommands::startNew() {
    if (!mayDiscard()) return;
    m_document.startNew({});
    Q_EMIT reported(tr("new scene"));
}

void FileCommands::startFromGenerator() {
    if (!mayDiscard()) return;
    NewSceneDialog dialog(m_settings.darkTheme(), &m_window);
    if (dialog.exec() != QDialog::Accepted) return;
    m_document.startNew(dialog.text());
    Q_EMIT reported(tr("new scene: %1").arg(dialog.name()));
}

void FileCommands::askAndOpen() {
    const QString folder = QFileInfo(m_document.path()).absolutePath();
    const QString path = QFileDialog::getOpenFileName(&m_window, tr("Open a scene"), folder, sceneFilter);
    if (!path.isEmpty()) open(path);
}

bool FileCommands::save() {
    if (m_document.path().isEmpty()) return saveAs();
    if (!mayOverwrite()) return false;
    return finish(m_document.save(), tr("saved %1").arg(m_document.path()));
}

bool FileCommands::saveAs() {
    const QString proposed = m_document.path().isEmpty() ? m_document.name() : m_document.path();
    QFileDialog dialog(&m_window, tr("Save the scene as"), QFileInfo(proposed).absolutePath(), sceneFilter);
    dialog.setAcceptMode(QFileDialog::AcceptSave);
    dialog.setDefaultSuffix(QStringLiteral("sdl"));
    dialog.selectFile(QFileInfo(proposed).fileName());
    if (dialog.exec() != QDialog::Accepted) return false;
    const QString path = dialog.selectedFiles().value(0);
    const bool saved = finish(m_document.saveAs(path), tr("saved %1").arg(path));
    if (saved) m_settings.addRecentFile(m_document.path());
    return saved;
}

void FileCommands::reload() {
    if (m_document.path().isEmpty()) return;
    reloadInPlace(tr("reloaded %1; Undo brings back the text before").arg(m_document.path()));
}

/// The caret and what is in view stay where they were.
bool FileCommands::reloadInPlace(const QString& done) {
    using Sci = QsciScintillaBase;
    SceneEditor& editor = m_window.editor();
    const std::uint32_t caret = editor.caret();
    const long top = editor.send(Sci::SCI_GETFIRSTVISIBLELINE);
    const bool reloaded = finish(m_document.reload(), done);
    if (reloaded) editor.goTo(caret, top);
    return reloaded;
}

void FileCommands::reactToOutsideChange() {
    if (m_asking) {
        m_changedMeanwhile = true;
        return;
    }
    if (!m_document.isModified()) {
        reloadInPlace(tr("reloaded %1, which was changed outside; Undo brings back the text before")
                          .arg(m_document.path()));
        return;
    }
    if (askAbout(false) == OutsideDialog::TakeTheFiles)
        reloadInPlace(tr("reloaded %1").arg(m_document.path()));
}

void FileCommands::reactToRemoval() {
    Q_EMIT reported(
        tr("%1 was deleted or moved outside; its text is kept here, unsaved").arg(m_document.path()));
}

/// Whether this text may take the place of what is in its file.
bool FileCommands::mayOverwrite() {
    if (m_document.onDisk() != OnDisk::Changed) return true;
    const int answer = askAbout(true);
    if (answer == OutsideDialog::TakeTheFiles) reloadInPlace(tr("reloaded %1").arg(m_document.path()));
    return answer == OutsideDialog::SaveThis;
}

int FileCommands::askAbout(bool saving) {
    OutsideDialog dialog({m_document.name(), m_document.text(), m_document.seeTextOnDisk()}, saving,
                         loadTheme(m_settings.darkTheme()), &m_window);
    return ask(dialog);
}

int FileCommands::ask(QDialog& dialog) {
    m_asking = true;
    const int answer = dialog.exec();
    m_asking = false;
    // What changed while the question stood there was not in what it showed.
    if (std::exchange(m_changedMeanwhile, false))
        QTimer::singleShot(0, this, &FileCommands::reactToOutsideChange);
    return answer;
}

void FileCommands::savePicture() {
    const QString path = askWhereToSave(&m_window, tr("Save the window as a picture"),
                                        QStringLiteral("carom.png"), tr("Pictures (*.png)"));
    if (path.isEmpty()) return;
    const QString problem = saveImage(path, m_window.grab().toImage());
    finish(problem.isEmpty() ? std::nullopt : std::optional(problem), tr("saved %1").arg(path));
}

void FileCommands::updateTitle() {
    const QString folder = QDir::toNativeSeparators(QFileInfo(m_document.path()).absolutePath());
    m_window.setWindowTitle(m_document.path().isEmpty()
                                ? tr("%1[*] – Carom").arg(m_document.name())
                                : tr("%1[*] (%2) – Carom").arg(m_document.name(), folder));
    m_window.setWindowModified(m_document.isModified());
    m_window.actions()[ActionId::Reload].setEnabled(!m_document.path().isEmpty());
}

void FileCommands::fillRecent() {
    QAction& action = m_window.actions()[ActionId::Recent];
    QMenu* menu = action.menu();
    menu->clear();
    for (const QString& path : m_settings.recentFiles())
        connect(menu->addAction(plainTitle(QDir::toNativeSeparators(path))), &QAction::triggered, this,
                [this, path] { open(path); });
    action.setEnabled(!menu->isEmpty());
}

/// Reports how a file operation ended; true where it went well.
bool FileCommands::finish(const std::optional<QString>& problem, const QString& done) {
    Q_EMIT reported(problem.value_or(done));
    if (!problem) return true;
    QMessageBox box(QMessageBox::Warning, tr("Carom"), *problem, QMessageBox::Ok, &m_window);
    box.setTextFormat(Qt::PlainText);
    ask(box);
    return false;
}

} // namespace carom

#include "moc_file_commands.cpp"
