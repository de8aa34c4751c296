// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/editor/scene_lexer.h"

#include "ui/base/theme.h"

#include "core/base/diagnostic_list.h"
#include "core/language/lexer.h"
#include "core/scene/schema.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace carom {
namespace {

using Sci = QsciScintillaBase;

/// Every name the schema knows and the style it is shown in. A name that is both (none is today) counts as
/// what was entered first.
const std::unordered_map<std::string_view, SceneLexer::Style>& knownNames() {
    static const std::unordered_map<std::string_view, SceneLexer::Style> names = [] {
        std::unordered_map<std::string_view, SceneLexer::Style> known;
        for (const DeclarationRow& declaration : schema()) {
            known.try_emplace(declaration.name, SceneLexer::Declaration);
            for (const ParameterRow& parameter : declaration.parameters) {
                known.try_emplace(parameter.name, SceneLexer::Parameter);
                for (const std::string_view word : parameter.words) known.try_emplace(word, SceneLexer::Word);
            }
        }
        for (const NamedColour& colour : namedColours()) known.try_emplace(colour.name, SceneLexer::Word);
        return known;
    }();
    return names;
}

/// `before` is the style of the token in front: a name behind a declaration's type is a label, whatever it
/// says.
SceneLexer::Style styleOf(const Token& token, std::string_view text, SceneLexer::Style before) {
    switch (token.kind) {
    case TokenKind::Number:
    case TokenKind::Text:
        return SceneLexer::Number;
    case TokenKind::Comment:
        return SceneLexer::Comment;
    case TokenKind::Name: {
        if (before == SceneLexer::Declaration) return SceneLexer::Plain;
        const auto known = knownNames().find(textOf(text, token.range));
        return known == knownNames().end() ? SceneLexer::Plain : known->second;
    }
    case TokenKind::OpenBrace:
    case TokenKind::CloseBrace:
    case TokenKind::Semicolon:
    case TokenKind::Colon:
    case TokenKind::Minus:
    case TokenKind::Comma:
        return SceneLexer::Punctuation;
    case TokenKind::EndOfText:
        return SceneLexer::Plain;
    default: // whatever cannot be right
        return SceneLexer::Unknown;
    }
}

} // namespace

SceneLexer::SceneLexer(const Theme& theme, const QFont& font, QObject* parent) : QsciLexerCustom(nullptr) {
    setParent(parent);
    setTextFont(font);
    setAutoIndentStyle(0);
    setTheme(theme);
}

void SceneLexer::setTextFont(const QFont& font) {
    setDefaultFont(font);
    for (int style = 0; style < StyleCount; ++style) setFont(font, style);
    QFont emphasis = font;
    emphasis.setBold(true);
    setFont(emphasis, Declaration);
    QFont slanted = font;
    slanted.setItalic(true);
    setFont(slanted, Comment);
}

void SceneLexer::setTheme(const Theme& theme) {
    setDefaultPaper(theme.editor);
    setDefaultColor(theme.editorText);
    setPaper(theme.editor);
    setColor(theme.editorText);
    setColor(theme.comment, Comment);
    setColor(theme.number, Number);
    setColor(theme.declaration, Declaration);
    setColor(theme.parameter, Parameter);
    setColor(theme.word, Word);
    setColor(theme.punctuation, Punctuation);
    setColor(theme.error, Unknown);
}

QString SceneLexer::description(int style) const {
    switch (style) {
    case Plain:
        return tr("Labels and white space");
    case Comment:
        return tr("Comment");
    case Number:
        return tr("Number");
    case Declaration:
        return tr("Declaration");
    case Parameter:
        return tr("Parameter");
    case Word:
        return tr("Word or colour");
    case Punctuation:
        return tr("Punctuation");
    case Unknown:
        return tr("Unexpected characters");
    default:
        return {}; // the end of the list
    }
}

void SceneLexer::styleText(int start, int end) {
    const auto send = [this](unsigned int message, int a = 0, int b = 0) {
        return editor()->SendScintilla(message, static_cast<unsigned long>(a), static_cast<long>(b));
    };
    const int firstLine = static_cast<int>(send(Sci::SCI_LINEFROMPOSITION, start));
    const int lastLine = static_cast<int>(send(Sci::SCI_LINEFROMPOSITION, end));
    const int begin = static_cast<int>(send(Sci::SCI_POSITIONFROMLINE, firstLine));
    const int stop = static_cast<int>(send(Sci::SCI_GETLINEENDPOSITION, lastLine));
    std::string text(static_cast<std::size_t>(stop - begin) + 1, '\0');
    editor()->SendScintilla(Sci::SCI_GETTEXTRANGE, static_cast<long>(begin), static_cast<long>(stop),
                            text.data());
    text.pop_back(); // Scintilla's terminator

    DiagnosticList ignored; // what is wrong is the analysis's to say
    std::vector<int> depthAtLineEnd(static_cast<std::size_t>(lastLine - firstLine) + 1, 0);
    int depth = firstLine > 0 ? static_cast<int>(send(Sci::SCI_GETLINESTATE, firstLine - 1)) : 0;
    int line = firstLine;
    const auto depthHoldsUntil = [&](int untilLine) {
        for (; line < untilLine; ++line) depthAtLineEnd[static_cast<std::size_t>(line - firstLine)] = depth;
    };

    // One message for all: one a token takes ten times as long. The last line's own end is coloured, too.
    std::string styles(static_cast<std::size_t>(std::max(stop, end) - begin), static_cast<char>(Plain));
    Style before = Plain;
    for (const Token& token : lex(text, ignored)) {
        before = styleOf(token, text, before);
        std::fill_n(styles.begin() + token.range.offset, token.range.length, static_cast<char>(before));
        const bool opens = token.kind == TokenKind::OpenBrace;
        if (!opens && token.kind != TokenKind::CloseBrace) continue;
        depthHoldsUntil(
            static_cast<int>(send(Sci::SCI_LINEFROMPOSITION, begin + static_cast<int>(token.range.offset))));
        depth = opens ? depth + 1 : std::max(0, depth - 1);
    }
    startStyling(begin);
    editor()->SendScintilla(Sci::SCI_SETSTYLINGEX, static_cast<uintptr_t>(styles.size()), styles.data());
    depthHoldsUntil(lastLine + 1);
    fold(firstLine, lastLine, depthAtLineEnd);
}

/// A line whose end is deeper than its beginning heads a fold.
void SceneLexer::fold(int firstLine, int lastLine, const std::vector<int>& depthAtLineEnd) {
    const auto send = [this](unsigned int message, int a, int b) {
        return editor()->SendScintilla(message, static_cast<unsigned long>(a), static_cast<long>(b));
    };
    int before = firstLine > 0 ? static_cast<int>(send(Sci::SCI_GETLINESTATE, firstLine - 1, 0)) : 0;
    for (int line = firstLine; line <= lastLine; ++line) {
        const int after = depthAtLineEnd[static_cast<std::size_t>(line - firstLine)];
        const int header = after > before ? Sci::SC_FOLDLEVELHEADERFLAG : 0;
        send(Sci::SCI_SETFOLDLEVEL, line, (Sci::SC_FOLDLEVELBASE + before) | header);
        send(Sci::SCI_SETLINESTATE, line, after);
        before = after;
    }
}

const char* SceneLexer::blockStart(int* style) const {
    if (style != nullptr) *style = Punctuation;
    return "{";
}

const char* SceneLexer::blockEnd(int* style) const {
    if (style != nullptr) *style = Punctuation;
    return "}";
}

const char* SceneLexer::wordCharacters() const {
    return "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
}

} // namespace carom

#include "moc_scene_lexer.cpp"
