// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/formatter.h"

#include "core/scene/schema.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

// A walk over the tokens that decides what white space stands between each two. Declarations the parser
// accepted are laid out anew; all else is copied byte by byte.

namespace carom {
namespace {

constexpr std::size_t longestLine = 110; // columns of a declaration on one line
constexpr std::string_view indent = "    ";
constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";

// Whether every line of a text of several ends with CR LF.
bool endsLinesByTwoBytes(std::string_view text) {
    std::size_t pairs = 0;
    for (std::size_t i = text.find_first_of("\r\n"); i != std::string_view::npos;
         i = text.find_first_of("\r\n", i + 2)) {
        if (text.substr(i, 2) != "\r\n") return false;
        ++pairs;
    }
    return pairs > 0;
}

class Formatter {
  public:
    explicit Formatter(const Analysis& analysis) : m_analysis(analysis), m_text(analysis.text) {
        if (endsLinesByTwoBytes(m_text)) m_lineEnd = "\r\n";
        m_out.reserve(m_text.size() + m_text.size() / 8);
    }

    std::string run() {
        if (m_text.starts_with(byteOrderMark)) m_out = byteOrderMark;
        const std::size_t begin = m_out.size();
        m_behind = static_cast<std::uint32_t>(begin);
        while (token(m_at).kind != TokenKind::EndOfText) {
            beginItem(m_out.size() == begin);
            if (token(m_at).kind == TokenKind::Comment)
                put(trimmed(spelling(m_at++)));
            else if (atDeclaration(m_at))
                putDeclaration();
            else
                putStray();
            m_behind = token(m_at - 1).range.end();
        }
        if (m_out.size() > begin) m_out += m_lineEnd;
        return std::move(m_out);
    }

  private:
    const Token& token(std::size_t i) const { return m_analysis.tokens[i]; }
    std::string_view spelling(std::size_t i) const { return textOf(m_text, token(i).range); }

    bool atDeclaration(std::size_t i) const {
        const std::vector<DeclarationSyntax>& all = m_analysis.tree.declarations;
        return m_declaration < all.size() && all[m_declaration].range.offset == token(i).range.offset;
    }

    std::size_t lineEndsBetween(std::uint32_t begin, std::uint32_t end) const {
        std::size_t count = 0;
        for (std::uint32_t i = begin; i < end; ++i) {
            const bool firstOfTwo = m_text[i] == '\r' && i + 1 < end && m_text[i + 1] == '\n';
            if ((m_text[i] == '\n' || m_text[i] == '\r') && !firstOfTwo) ++count;
        }
        return count;
    }

    std::size_t lineEndsBefore(std::size_t i) const {
        return lineEndsBetween(i == 0 ? 0 : token(i - 1).range.end(), token(i).range.offset);
    }

    void put(std::string_view text) { m_out += text; }
    void putLineEnds(std::size_t written) {
        put(m_lineEnd);
        if (written >= 2) put(m_lineEnd);
    }

    // Between two things that stand for themselves: declarations, comments and what could not be read.
    void beginItem(bool first) {
        const std::uint32_t begin = token(m_at).range.offset;
        if (first) { // a byte order mark is one at the start only; behind space it must stay behind space
            if (m_text.substr(begin).starts_with(byteOrderMark)) put(m_lineEnd);
            return;
        }
        const std::size_t lineEnds = lineEndsBetween(m_behind, begin);
        if (token(m_at).kind == TokenKind::Comment && lineEnds == 0)
            put("  ");
        else
            putLineEnds(lineEnds);
    }

    static std::string_view trimmed(std::string_view comment) {
        return comment.substr(0, comment.find_last_not_of(" \t") + 1);
    }

    void putStray() {
        const std::uint32_t begin = token(m_at).range.offset;
        do ++m_at;
        while (token(m_at).kind != TokenKind::EndOfText && token(m_at).kind != TokenKind::Comment &&
               !atDeclaration(m_at));
        put(m_text.substr(begin, token(m_at - 1).range.end() - begin));
    }

    void putDeclaration() {
        const DeclarationSyntax& declaration = m_analysis.tree.declarations[m_declaration++];
        std::size_t end = m_at;
        while (token(end).kind != TokenKind::EndOfText && token(end).range.offset < declaration.range.end())
            ++end;
        if (declaration.broken || namesTypeInside(declaration)) {
            put(textOf(m_text, declaration.range));
        } else {
            const std::size_t begin = m_out.size();
            layOut(declaration, end, wantsLines(end));
            if (m_out.size() - begin > longestLine && !wantsLines(end)) {
                m_out.resize(begin);
                layOut(declaration, end, true);
            }
        }
        m_at = end;
    }

    // A "parameter" named like a declaration type would, at the start of a line, begin a declaration.
    bool namesTypeInside(const DeclarationSyntax& declaration) const {
        for (std::uint32_t i = 0; i < declaration.parameterCount; ++i) {
            const ParameterSyntax& parameter = m_analysis.tree.parameters[declaration.firstParameter + i];
            if (findDeclaration(textOf(m_text, parameter.name)) != nullptr) return true;
        }
        return false;
    }

    // Whether the declaration up to token `end` is written over several lines whatever its length.
    bool wantsLines(std::size_t end) const {
        for (std::size_t i = m_at; i < end; ++i) {
            if (token(i).kind == TokenKind::Comment) return true;
            const bool behindBrace = i > m_at && token(i - 1).kind == TokenKind::OpenBrace;
            if (behindBrace && token(i).kind != TokenKind::CloseBrace && lineEndsBefore(i) > 0) return true;
        }
        return false;
    }

    void layOut(const DeclarationSyntax& declaration, std::size_t end, bool overLines) {
        m_parameter = declaration.firstParameter;
        m_parameterEnd = m_parameter + declaration.parameterCount;
        m_listOpen = false;
        std::size_t before = m_at; // the last token that is no comment
        put(spelling(m_at));
        for (std::size_t i = m_at + 1; i < end; ++i) {
            if (token(i).kind == TokenKind::Comment) {
                putInnerComment(i, end);
                continue;
            }
            const bool names = namesParameter(i);
            if (names ||
                (token(i).kind == TokenKind::CloseBrace && token(i - 1).kind != TokenKind::OpenBrace))
                beginEntry(i, token(before).kind, overLines);
            else if (token(i - 1).kind == TokenKind::Comment)
                beginContinuation();
            else
                put(spaceBetween(token(before).kind, token(i).kind));
            put(spelling(i));
            if (token(i).kind == TokenKind::OpenBrace) m_listOpen = true;
            if (names) ++m_parameter;
            before = i;
        }
    }

    // Whether token i is the name of the next parameter.
    bool namesParameter(std::size_t i) const {
        return m_parameter < m_parameterEnd &&
               m_analysis.tree.parameters[m_parameter].name.offset == token(i).range.offset;
    }

    // A parameter's name, or the closing brace.
    void beginEntry(std::size_t i, TokenKind before, bool overLines) {
        const bool names = namesParameter(i);
        if (!overLines) return put(names && before != TokenKind::OpenBrace ? "  " : " ");
        const bool mayKeepEmptyLine = names && token(i - 1).kind != TokenKind::OpenBrace;
        putLineEnds(mayKeepEmptyLine ? lineEndsBefore(i) : 1);
        if (names) put(indent);
    }

    // What a comment has separated: the rest of a parameter, or a brace that belongs to the line above.
    void beginContinuation() {
        put(m_lineEnd);
        if (!m_listOpen) return;
        put(indent);
        put(indent);
    }

    void putInnerComment(std::size_t i, std::size_t end) {
        if (lineEndsBefore(i) == 0) {
            put("  ");
        } else {
            putLineEnds(token(i - 1).kind == TokenKind::OpenBrace ? 1 : lineEndsBefore(i));
            std::size_t next = i;
            while (next < end && token(next).kind == TokenKind::Comment) ++next;
            const bool beforeEntry = namesParameter(next) || token(next).kind == TokenKind::CloseBrace;
            if (m_listOpen) put(indent);
            if (m_listOpen && !beforeEntry) put(indent);
        }
        put(trimmed(spelling(i)));
    }

    static std::string_view spaceBetween(TokenKind before, TokenKind now) {
        switch (now) {
        case TokenKind::Comma:
        case TokenKind::Colon:
        case TokenKind::Semicolon:
        case TokenKind::CloseBrace:
            return "";
        default:
            return before == TokenKind::Minus ? "" : " ";
        }
    }

    const Analysis& m_analysis;
    std::string_view m_text;
    std::string_view m_lineEnd = "\n";
    std::string m_out;
    std::size_t m_at = 0;          ///< token
    std::size_t m_declaration = 0; ///< the next one
    std::uint32_t m_behind = 0;    ///< end of the last item in the text
    // Of the declaration being laid out:
    std::uint32_t m_parameter = 0; ///< the next one
    std::uint32_t m_parameterEnd = 0;
    bool m_listOpen = false; ///< its brace is behind
};

} // namespace

std::string formatText(const Analysis& analysis) {
    if (analysis.text.size() > largestText) return analysis.text;
    return Formatter(analysis).run();
}

} // namespace carom
