// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/source.h"

#include <QByteArray>
#include <QRegularExpression>
#include <QString>

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace carom {

struct SearchQuery {
    QString text;
    bool regularExpression = false; ///< Perl's, of PCRE2; a match does not go beyond its line
    bool matchCase = false;

    bool operator==(const SearchQuery&) const = default;
};

/// Looks for matches in a text's bytes, whatever they are: a line that is no UTF-8 is searched byte by byte.
/// No expression can take more than a bounded effort a line; a match that would take more is none.
class TextSearch {
  public:
    explicit TextSearch(const SearchQuery& query);

    /// Why the regular expression is none; empty: it is one, or none was asked for.
    QString problem() const;

    /// The first match that begins at `from` or behind, or the last one that ends at `from` or before.
    std::optional<SourceRange> next(const QByteArray& text, std::int64_t from) const;
    std::optional<SourceRange> previous(const QByteArray& text, std::int64_t from) const;
    /// Whether exactly this is a match.
    bool isMatch(const QByteArray& text, SourceRange range) const;
    /// Matches at most; ten times as many take ten times the time and memory.
    static constexpr std::size_t mostMatches = 100'000;
    /// Every match of the text, up to so many; asks at every line whether it is to go on, and returns what it
    /// has if not.
    std::vector<SourceRange> all(const QByteArray& text, const std::function<bool()>& goOn) const;

    /// What stands in the place of a match: the replacement, in which `\0` to `\9` are the match and its
    /// groups and `\n` and `\t` a line end and a tab if the query is a regular expression.
    QByteArray replacementOf(const QByteArray& text, SourceRange match, const QString& replacement) const;

  private:
    class Line;
    template<class Visit>
    void visitLine(const QByteArray& text, std::int64_t begin, Visit&& visit) const;

    SearchQuery m_query;
    QRegularExpression m_expression;
};

} // namespace carom
