// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/editor/text_search.h"

namespace carom {
namespace {

using Sci = QsciScintillaBase;

int flagsOf(const SearchQuery& query) {
    const int cased = query.matchCase ? Sci::SCFIND_MATCHCASE : 0;
    return query.regularExpression ? cased | Sci::SCFIND_REGEXP | Sci::SCFIND_CXX11REGEX : cased;
}

/// Where to look on behind a match: an empty one must not be found again.
std::int64_t behind(SourceRange match) { return match.length > 0 ? match.end() : match.offset + 1; }

} // namespace

std::optional<SourceRange> findMatch(const SceneEditor& editor, const SearchQuery& query, std::int64_t from,
                                     std::int64_t to) {
    const QByteArray needle = query.text.toUtf8();
    if (needle.isEmpty()) return std::nullopt;
    editor.send(Sci::SCI_SETSEARCHFLAGS, flagsOf(query));
    editor.send(Sci::SCI_SETTARGETRANGE, from, to);
    const long found = editor.SendScintilla(Sci::SCI_SEARCHINTARGET, static_cast<uintptr_t>(needle.size()),
                                            needle.constData());
    if (found < 0) return std::nullopt;
    const std::int64_t end = editor.send(Sci::SCI_GETTARGETEND);
    return SourceRange{static_cast<std::uint32_t>(found), static_cast<std::uint32_t>(end - found)};
}

int countMatches(const SceneEditor& editor, const SearchQuery& query) {
    const std::int64_t length = editor.send(Sci::SCI_GETLENGTH);
    int count = 0;
    std::int64_t from = 0;
    while (from <= length) {
        const std::optional<SourceRange> match = findMatch(editor, query, from, length);
        if (!match) break;
        ++count;
        from = behind(*match);
    }
    return count;
}

std::int64_t replaceMatch(SceneEditor& editor, const SearchQuery& query, SourceRange match,
                          const QString& replacement) {
    // Groups are those of the last search, so it is repeated on exactly this match.
    if (!findMatch(editor, query, match.offset, match.end())) return match.end();
    const QByteArray text = replacement.toUtf8();
    const unsigned int message = query.regularExpression ? Sci::SCI_REPLACETARGETRE : Sci::SCI_REPLACETARGET;
    const long written = editor.SendScintilla(message, static_cast<uintptr_t>(text.size()), text.constData());
    return match.offset + written;
}

int replaceAllMatches(SceneEditor& editor, const SearchQuery& query, const QString& replacement) {
    int count = 0;
    std::int64_t from = 0;
    editor.send(Sci::SCI_BEGINUNDOACTION);
    while (from <= editor.send(Sci::SCI_GETLENGTH)) {
        const std::optional<SourceRange> match =
            findMatch(editor, query, from, editor.send(Sci::SCI_GETLENGTH));
        if (!match) break;
        from = replaceMatch(editor, query, *match, replacement) + (match->length > 0 ? 0 : 1);
        ++count;
    }
    editor.send(Sci::SCI_ENDUNDOACTION);
    return count;
}

} // namespace carom
