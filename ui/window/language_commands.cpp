// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/language_commands.h"

#include "ui/editor/call_tip_box.h"
#include "ui/editor/completer.h"
#include "ui/editor/literal_handles.h"
#include "ui/editor/live_build.h"
#include "ui/editor/number_scrubber.h"
#include "ui/editor/rename_box.h"
#include "ui/editor/snippet_fields.h"
#include "ui/base/actions.h"
#include "ui/window/main_window.h"

#include "core/language/formatter.h"
#include "core/language/navigation.h"

#include <algorithm>

namespace carom {
namespace {

using Sci = QsciScintillaBase;

constexpr int messageTime = 4000; // [ms] a message stays in the status bar

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

/// Where a place of the old text is in the new one, where only white space differs.
std::int64_t samePlace(const QByteArray& before, const QByteArray& after, std::int64_t place) {
    const auto written = [](char c) { return !isBlank(c); };
    std::int64_t count = std::count_if(before.begin(), before.begin() + place, written);
    const char* at = after.begin();
    for (; at != after.end() && count > 0; ++at)
        if (!isBlank(*at)) --count;
    return at - after.begin();
}

} // namespace

LanguageCommands::LanguageCommands(MainWindow& window, LiveBuild& builds)
    : QObject(&window), m_window(window), m_editor(window.editor()), m_callTip(new CallTipBox(m_editor)),
      m_snippets(new SnippetFields(m_editor)) {
    connectHelp();
    connectPlaces();
    connectNumbers(builds);
}

void LanguageCommands::setTheme(const Theme& theme) {
    m_callTip->setTheme(theme);
    m_snippets->setTheme(theme);
}

void LanguageCommands::connectHelp() {
    const Actions& actions = m_window.actions();
    Completer* completer = new Completer(m_editor);
    connect(&actions[ActionId::Complete], &QAction::triggered, completer, &Completer::complete);
    connect(&actions[ActionId::CallTip], &QAction::triggered, this, [this] {
        if (!m_callTip->show()) say(tr("The caret is in no declaration's braces"));
    });
    connect(&actions[ActionId::Snippet], &QAction::triggered, m_snippets, &SnippetFields::insertOrOffer);
    connect(&actions[ActionId::Comment], &QAction::triggered, &m_editor, &SceneEditor::toggleComment);
}

void LanguageCommands::connectPlaces() {
    const Actions& actions = m_window.actions();
    connect(&actions[ActionId::Definition], &QAction::triggered, this, &LanguageCommands::goToDefinition);
    connect(&actions[ActionId::Format], &QAction::triggered, this, &LanguageCommands::format);
    RenameBox* rename = new RenameBox(m_editor);
    connect(&actions[ActionId::Rename], &QAction::triggered, rename, [this, rename] {
        if (!rename->begin()) say(tr("There is no label at the caret; labels stand behind a body's type"));
    });
}

void LanguageCommands::connectNumbers(LiveBuild& builds) {
    const Actions& actions = m_window.actions();
    NumberScrubber* scrubber = new NumberScrubber(m_editor);
    connect(scrubber, &NumberScrubber::turned, &builds, &LiveBuild::hurry);
    LiteralHandles* handles = new LiteralHandles(m_editor, *scrubber);
    connect(&actions[ActionId::PickColour], &QAction::triggered, handles, [this, handles] {
        if (!handles->pickColourAtCaret()) say(tr("There is no colour at the caret"));
    });
    const auto turn = [this, scrubber](int steps) {
        if (!scrubber->turnAtCaret(steps)) say(tr("There is no number at the caret"));
    };
    connect(&actions[ActionId::NumberUp], &QAction::triggered, scrubber, [turn] { turn(1); });
    connect(&actions[ActionId::NumberDown], &QAction::triggered, scrubber, [turn] { turn(-1); });
}

void LanguageCommands::goToDefinition() {
    const Analysis analysis = analyse(m_editor.bytes().toStdString());
    const std::optional<LabelUse> use = labelAt(analysis, m_editor.caret());
    if (!use) return say(tr("There is no label at the caret"));
    if (!use->definition) return say(tr("No body carries this label"));
    m_editor.reveal(*use->definition);
    m_editor.setFocus();
}

/// One undo step; the caret stays at its word.
void LanguageCommands::format() {
    const QByteArray before = m_editor.bytes();
    const QByteArray after = QByteArray::fromStdString(formatText(analyse(before.toStdString())));
    if (before == after) return say(tr("The text is formatted already"));
    const std::int64_t caret = samePlace(before, after, m_editor.caret());
    const std::int64_t top = m_editor.send(Sci::SCI_GETFIRSTVISIBLELINE);
    m_editor.replaceRange({0, static_cast<std::uint32_t>(before.size())}, after);
    m_editor.send(Sci::SCI_SETFIRSTVISIBLELINE, top);
    m_editor.send(Sci::SCI_GOTOPOS, caret);
    say(tr("Laid out; Ctrl+Z takes it back"));
}

void LanguageCommands::say(const QString& sentence) { m_window.tell(sentence, messageTime); }

} // namespace carom

#include "moc_language_commands.cpp"
