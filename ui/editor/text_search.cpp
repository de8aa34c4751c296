// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/editor/text_search.h"

#include <algorithm>

namespace carom {
namespace {

/// Steps that matching one line may take; a line of 60,000 letters under (a|b)*c would take a billion. PCRE2
/// keeps what it has to remember on the heap, so that no expression exhausts the stack.
const QString limits = QStringLiteral("(*LIMIT_MATCH=1000000)(*LIMIT_HEAP=20000)");

std::int64_t lineBegin(const QByteArray& text, std::int64_t place) {
    return place > 0 ? text.lastIndexOf('\n', place - 1) + 1 : 0;
}

std::int64_t lineEnd(const QByteArray& text, std::int64_t place) {
    const qsizetype end = text.indexOf('\n', place);
    return end < 0 ? text.size() : end;
}

SourceRange rangeOf(std::int64_t begin, std::int64_t end) {
    return {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end - begin)};
}

} // namespace

/// A line as the expression sees it, and the way back to its bytes.
class TextSearch::Line {
  public:
    Line(const QByteArray& text, std::int64_t begin)
        : m_begin(begin), m_bytes(text.mid(begin, lineEnd(text, begin) - begin)) {
        if (m_bytes.endsWith('\r')) m_bytes.chop(1);
        m_text = QString::fromUtf8(m_bytes);
        m_bytewise = m_text.toUtf8() != m_bytes;
        if (m_bytewise) m_text = QString::fromLatin1(m_bytes);
        m_plain = m_bytewise || m_text.size() == m_bytes.size();
    }

    const QString& text() const { return m_text; }
    /// The place in the whole text of one in this line.
    std::int64_t placeOf(qsizetype unit) const {
        return m_begin + (m_plain ? unit : QStringView(m_text).left(unit).toUtf8().size());
    }
    qsizetype unitOf(std::int64_t place) const {
        const std::int64_t byte = std::clamp<std::int64_t>(place - m_begin, 0, m_bytes.size());
        return m_plain ? byte : QString::fromUtf8(m_bytes.left(byte)).size();
    }
    QByteArray bytesOf(const QString& part) const { return m_bytewise ? part.toLatin1() : part.toUtf8(); }

  private:
    std::int64_t m_begin;
    QByteArray m_bytes;
    QString m_text;
    bool m_bytewise = false, m_plain = false;
};

TextSearch::TextSearch(const SearchQuery& query) : m_query(query) {
    const QString pattern = query.regularExpression ? query.text : QRegularExpression::escape(query.text);
    m_expression.setPattern(limits + pattern);
    if (!query.matchCase) m_expression.setPatternOptions(QRegularExpression::CaseInsensitiveOption);
}

QString TextSearch::problem() const {
    return m_expression.isValid() ? QString() : m_expression.errorString();
}

/// Every match of the line that begins there, until `visit` says false.
template<class Visit>
void TextSearch::visitLine(const QByteArray& text, std::int64_t begin, Visit&& visit) const {
    const Line line(text, begin);
    QRegularExpressionMatchIterator matches = m_expression.globalMatch(line.text());
    while (matches.hasNext()) {
        const QRegularExpressionMatch match = matches.next();
        if (!visit(rangeOf(line.placeOf(match.capturedStart()), line.placeOf(match.capturedEnd())))) return;
    }
}

std::optional<SourceRange> TextSearch::next(const QByteArray& text, std::int64_t from) const {
    std::optional<SourceRange> found;
    if (m_query.text.isEmpty() || !m_expression.isValid()) return found;
    for (std::int64_t begin = lineBegin(text, from); begin <= text.size() && !found;
         begin = lineEnd(text, begin) + 1)
        visitLine(text, begin, [&](SourceRange match) {
            if (match.offset >= from) found = match;
            return !found;
        });
    return found;
}

std::optional<SourceRange> TextSearch::previous(const QByteArray& text, std::int64_t from) const {
    std::optional<SourceRange> found;
    if (m_query.text.isEmpty() || !m_expression.isValid()) return found;
    for (std::int64_t begin = lineBegin(text, from);; begin = lineBegin(text, begin - 1)) {
        visitLine(text, begin, [&](SourceRange match) {
            if (match.end() <= from) found = match;
            return match.end() <= from;
        });
        if (found || begin == 0) return found;
    }
}

bool TextSearch::isMatch(const QByteArray& text, SourceRange range) const {
    const std::optional<SourceRange> match = next(text, range.offset);
    return match && match->offset == range.offset && match->length == range.length;
}

std::vector<SourceRange> TextSearch::all(const QByteArray& text, const std::function<bool()>& goOn) const {
    std::vector<SourceRange> found;
    if (m_query.text.isEmpty() || !m_expression.isValid()) return found;
    for (std::int64_t begin = 0; begin <= text.size() && found.size() < mostMatches && goOn();
         begin = lineEnd(text, begin) + 1)
        visitLine(text, begin, [&](SourceRange match) {
            found.push_back(match);
            return found.size() < mostMatches;
        });
    return found;
}

QByteArray TextSearch::replacementOf(const QByteArray& text, SourceRange match,
                                     const QString& replacement) const {
    if (!m_query.regularExpression) return replacement.toUtf8();
    const Line line(text, lineBegin(text, match.offset));
    const QRegularExpressionMatch groups = m_expression.match(line.text(), line.unitOf(match.offset));
    QByteArray result;
    for (qsizetype i = 0; i < replacement.size(); ++i) {
        const QChar c = replacement[i], after = i + 1 < replacement.size() ? replacement[i + 1] : QChar();
        if (c != u'\\' || after.isNull()) {
            // A pair of surrogates is one letter.
            const qsizetype units = c.isHighSurrogate() && after.isLowSurrogate() ? 2 : 1;
            result += replacement.mid(i, units).toUtf8();
            i += units - 1;
            continue;
        }
        ++i;
        if (after >= u'0' && after <= u'9')
            result += line.bytesOf(groups.captured(after.digitValue()));
        else if (after == u'n')
            result += '\n';
        else if (after == u't')
            result += '\t';
        else
            result += QString(after).toUtf8();
    }
    return result;
}

} // namespace carom
