// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/edit_commands.h"

#include "ui/editor/diagnostic_marks.h"
#include "ui/editor/find_bar.h"
#include "ui/viewport/viewport.h"
#include "ui/base/actions.h"
#include "ui/base/document.h"
#include "ui/window/main_window.h"
#include "ui/base/settings.h"

#include <QInputDialog>

namespace carom {
namespace {

constexpr int messageTime = 4000; // [ms] a message stays in the status bar

} // namespace

EditCommands::EditCommands(MainWindow& window, const Document& document, DiagnosticMarks& marks,
                           Settings& settings)
    : QObject(&window), m_window(window) {
    connectEditing();
    connectSearch();
    connectProblems(document, marks);
    connectLook(marks, settings);
}

void EditCommands::connectEditing() {
    const Actions& actions = m_window.actions();
    SceneEditor& editor = m_window.editor();
    const auto on = [&](ActionId id, auto method) {
        connect(&actions[id], &QAction::triggered, &editor, method);
    };
    on(ActionId::Undo, &SceneEditor::undo);
    on(ActionId::Redo, &SceneEditor::redo);
    on(ActionId::Cut, &SceneEditor::cut);
    on(ActionId::Copy, &SceneEditor::copy);
    on(ActionId::Paste, &SceneEditor::paste);
    on(ActionId::SelectAll, [&editor] { editor.selectAll(); });
    on(ActionId::SelectNext, &SceneEditor::selectNextOccurrence);
    on(ActionId::LinesUp, [&editor] { editor.send(QsciScintillaBase::SCI_MOVESELECTEDLINESUP); });
    on(ActionId::LinesDown, [&editor] { editor.send(QsciScintillaBase::SCI_MOVESELECTEDLINESDOWN); });
    on(ActionId::FoldAll,
       [&editor] { editor.send(QsciScintillaBase::SCI_FOLDALL, QsciScintillaBase::SC_FOLDACTION_TOGGLE); });
    const auto refresh = [&editor, &actions] {
        actions[ActionId::Undo].setEnabled(editor.isUndoAvailable());
        actions[ActionId::Redo].setEnabled(editor.isRedoAvailable());
    };
    connect(&editor, &SceneEditor::textChanged, this, refresh);
    connect(&editor, &SceneEditor::savedStateChanged, this, refresh);
    refresh();
    connect(&actions[ActionId::FocusEditor], &QAction::triggered, &editor, [&editor] { editor.setFocus(); });
    Viewport& viewport = m_window.viewport();
    connect(&actions[ActionId::FocusViewport], &QAction::triggered, &viewport,
            [&viewport] { viewport.setFocus(); });
}

void EditCommands::connectSearch() {
    const Actions& actions = m_window.actions();
    FindBar& bar = m_window.findBar();
    connect(&actions[ActionId::Find], &QAction::triggered, &bar, &FindBar::activate);
    connect(&actions[ActionId::FindNext], &QAction::triggered, &bar, &FindBar::findNext);
    connect(&actions[ActionId::FindPrevious], &QAction::triggered, &bar, &FindBar::findPrevious);
    connect(&actions[ActionId::GoToLine], &QAction::triggered, this, &EditCommands::askForLine);
}

void EditCommands::connectProblems(const Document& document, DiagnosticMarks& marks) {
    const Actions& actions = m_window.actions();
    connect(&actions[ActionId::NextProblem], &QAction::triggered, &marks, &DiagnosticMarks::goToNext);
    connect(&actions[ActionId::PreviousProblem], &QAction::triggered, &marks, &DiagnosticMarks::goToPrevious);
    connect(&actions[ActionId::FixIt], &QAction::triggered, this, [this, &document, &marks] {
        if (!marks.applyFixIt(document.revision()))
            m_window.tell(tr("There is no quick fix for what is at the caret"), messageTime);
    });
}

void EditCommands::connectLook(DiagnosticMarks& marks, Settings& settings) {
    const Actions& actions = m_window.actions();
    SceneEditor& editor = m_window.editor();
    QAction& inPlace = actions[ActionId::InlineMessages];
    inPlace.setCheckable(true);
    connect(&inPlace, &QAction::toggled, this, [&marks, &settings](bool shown) {
        marks.setInlineMessages(shown);
        settings.setInlineMessages(shown);
    });
    inPlace.setChecked(settings.inlineMessages());
    marks.setInlineMessages(settings.inlineMessages());

    QAction& wrap = actions[ActionId::WrapLines];
    wrap.setCheckable(true);
    connect(&wrap, &QAction::toggled, this, [&editor, &settings](bool wraps) {
        editor.setWrapsLines(wraps);
        settings.setWrapsLines(wraps);
    });
    wrap.setChecked(settings.wrapsLines());
    editor.setWrapsLines(settings.wrapsLines());

    editor.zoomTo(settings.editorZoom());
    const auto zoom = [&](ActionId id, auto change) {
        connect(&actions[id], &QAction::triggered, this, [&editor, &settings, change] {
            change(editor);
            settings.setEditorZoom(static_cast<int>(editor.send(QsciScintillaBase::SCI_GETZOOM)));
        });
    };
    zoom(ActionId::ZoomIn, [](SceneEditor& e) { e.zoomIn(); });
    zoom(ActionId::ZoomOut, [](SceneEditor& e) { e.zoomOut(); });
    zoom(ActionId::ZoomReset, [](SceneEditor& e) { e.zoomTo(0); });
}

void EditCommands::askForLine() {
    SceneEditor& editor = m_window.editor();
    bool accepted = false;
    const int current =
        static_cast<int>(editor.send(QsciScintillaBase::SCI_LINEFROMPOSITION, editor.caret())) + 1;
    const int line =
        QInputDialog::getInt(&m_window, tr("Go to line"), tr("Line, 1 to %1:").arg(editor.lines()), current,
                             1, editor.lines(), 1, &accepted);
    if (!accepted) return;
    const long offset = editor.send(QsciScintillaBase::SCI_POSITIONFROMLINE, line - 1);
    editor.reveal({static_cast<std::uint32_t>(offset), 0});
    editor.setFocus();
}

} // namespace carom

#include "moc_edit_commands.cpp"
