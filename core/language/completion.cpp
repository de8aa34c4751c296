// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/completion.h"

#include "core/base/catalogue.h"
#include "core/base/text.h"
#include "core/language/description.h"
#include "core/language/navigation.h"
#include "core/language/open_list.h"
#include "core/language/sweep_completion.h"
#include "core/scene/schema.h"

#include <algorithm>
#include <map>
#include <string_view>

// The tree of a text that is being typed is incomplete, so the context is found from the tokens before the
// place: back to the brace that opens its list, then forward again over the parameters that are given.

namespace carom {
namespace {

std::string shownColour(const NamedColour& colour) {
    return shortest(colour.colour.x()) + ", " + shortest(colour.colour.y()) + ", " +
           shortest(colour.colour.z());
}

bool takesWord(const ParameterRow& row) {
    return row.kind == ValueKind::Word || row.kind == ValueKind::Label || row.kind == ValueKind::Colour;
}

// Which parameters a list gives, read token by token.
struct ListState {
    const DeclarationRow& row;
    std::vector<bool> given = std::vector<bool>(row.parameters.size(), false);
    const ParameterRow* pending = nullptr; ///< a known parameter whose value has not begun
    bool insideVector = false;             ///< behind a comma or a sign

    void take(TokenKind kind, std::string_view spelling) {
        if (isSkippedToken(kind) || kind == TokenKind::Colon) return;
        insideVector = kind == TokenKind::Comma || kind == TokenKind::Minus;
        const ParameterRow* named = kind == TokenKind::Name ? row.find(spelling) : nullptr;
        if (named != nullptr) given[static_cast<std::size_t>(named - row.parameters.data())] = true;
        pending = named;
    }
};

class Completer {
  public:
    Completer(const Analysis& analysis, std::uint32_t offset) : m_analysis(analysis), m_offset(offset) {}

    CompletionList run() {
        m_list.replaced = {m_offset, 0};
        if (const std::optional<std::size_t> text = textAround()) {
            completeText(*text);
            return std::move(m_list);
        }
        const std::vector<Token>& tokens = m_analysis.tokens;
        const auto touching = std::lower_bound(
            tokens.begin(), tokens.end(), m_offset,
            [](const Token& token, std::uint32_t place) { return token.range.end() < place; });
        m_next = static_cast<std::size_t>(touching - tokens.begin());
        for (; token(m_next).range.offset < m_offset && m_next + 1 < tokens.size(); ++m_next) {
            if (isWord(m_next)) break;
            const TokenKind kind = token(m_next).kind;
            if (kind == TokenKind::Comment || kind == TokenKind::Number || kind == TokenKind::Text)
                return std::move(m_list);
        }
        if (isWord(m_next) && token(m_next).range.offset <= m_offset) m_list.replaced = token(m_next++).range;
        complete();
        return std::move(m_list);
    }

  private:
    const Token& token(std::size_t i) const { return m_analysis.tokens[i]; }
    std::string_view spelling(std::size_t i) const { return textOf(m_analysis.text, token(i).range); }
    bool isWord(std::size_t i) const { return isWordToken(token(i).kind); }
    bool endsList(std::size_t i) const { return endsListToken(token(i).kind); }

    void complete() {
        const std::size_t place = m_list.replaced.length > 0 ? m_next - 1 : m_next;
        const std::optional<std::size_t> last = tokenBefore(m_analysis.tokens, place);
        if (!last || endsList(*last)) return addDeclarations();
        if (const std::optional<OpenList> list = openListAt(m_analysis, place)) completeInside(*list, place);
    }

    /// The text in quotation marks that the place is inside of; one that is not closed yet goes to the end of
    /// its line.
    std::optional<std::size_t> textAround() const {
        const std::vector<Token>& tokens = m_analysis.tokens;
        const auto behind = std::ranges::lower_bound(tokens, m_offset, {},
                                                     [](const Token& token) { return token.range.offset; });
        if (behind == tokens.begin()) return std::nullopt;
        const auto i = static_cast<std::size_t>(behind - tokens.begin()) - 1;
        const std::uint32_t begin = token(i).range.offset;
        if (token(i).kind == TokenKind::Text)
            return m_offset < token(i).range.end() ? std::optional(i) : std::nullopt;
        const bool isOpen = token(i).kind == TokenKind::Faulty && m_analysis.text[begin] == '"';
        const std::string_view before = textOf(m_analysis.text, {begin, m_offset - begin});
        if (!isOpen || before.find_first_of("\r\n") != before.npos) return std::nullopt;
        return i;
    }

    /// Only those of a `sweep` have a language.
    void completeText(std::size_t text) {
        const std::optional<OpenList> open = openListAt(m_analysis, text);
        const std::optional<std::size_t> name = tokenBefore(m_analysis.tokens, text);
        if (!open || open->row->name != "sweep" || !name) return;
        const std::string_view parameter = spelling(*name);
        if (parameter != "vary" && parameter != "measure") return;
        const std::uint32_t begin = token(text).range.offset + 1;
        const std::string_view rest = std::string_view(m_analysis.text).substr(begin);
        m_list = sweepCompletions(m_analysis, parameter, rest.substr(0, rest.find_first_of("\"\r\n")), begin,
                                  m_offset);
    }

    void completeInside(const OpenList& open, std::size_t place) {
        const DeclarationRow* row = open.row;
        ListState list{*row};
        for (std::size_t i = open.brace + 1; i < place; ++i) list.take(token(i).kind, spelling(i));
        const ParameterRow* const pending = list.pending;
        const bool insideVector = list.insideVector;
        for (std::size_t i = m_next; !endsList(i) && token(i).kind != TokenKind::OpenBrace; ++i) {
            if (token(i).kind == TokenKind::EndOfText) break;
            list.take(token(i).kind, spelling(i));
        }
        if (pending != nullptr && takesWord(*pending)) return addValues(*pending);
        if (pending == nullptr && !insideVector) addParameters(*row, list.given);
    }

    void addDeclarations() {
        for (const DeclarationRow& row : schema())
            m_list.entries.push_back({CompletionKind::Declaration, std::string(row.name), snippetOf(row),
                                      signatureOf(row), std::string(row.help), false});
    }

    void addParameters(const DeclarationRow& row, const std::vector<bool>& given) {
        for (const bool required : {true, false})
            for (std::size_t i = 0; i < given.size(); ++i) {
                const ParameterRow& parameter = row.parameters[i];
                if ((given[i] && !parameter.repeats) || parameter.required != required) continue;
                const std::string name(parameter.name);
                m_list.entries.push_back({CompletionKind::Parameter, name,
                                          name + " " + std::string(parameter.example), summaryOf(parameter),
                                          std::string(parameter.help), required});
            }
    }

    void add(CompletionKind kind, std::string_view name, std::string detail, std::string_view help) {
        m_list.entries.push_back(
            {kind, std::string(name), std::string(name), std::move(detail), std::string(help), false});
    }

    void addValues(const ParameterRow& row) {
        for (const std::string_view word : row.words)
            add(CompletionKind::Word, word, word == row.defaultText ? "the default" : "", row.help);
        if (row.kind == ValueKind::Colour)
            for (const NamedColour& colour : namedColours())
                add(CompletionKind::Colour, colour.name, shownColour(colour), row.help);
        if (row.kind != ValueKind::Label) return;
        add(CompletionKind::Label, "world", "the world itself", row.help);
        for (const DeclarationSyntax& declaration : m_analysis.tree.declarations) {
            if (declaration.label.length == 0) continue;
            const DeclarationRow* type = findDeclaration(textOf(m_analysis.text, declaration.type));
            if (type != nullptr && type->isBody)
                add(CompletionKind::Label, textOf(m_analysis.text, declaration.label),
                    std::string(type->name), row.help);
        }
        if (row.takesFamily) addFamilies(row);
    }

    /// What labels share before their numbers, where several do.
    void addFamilies(const ParameterRow& row) {
        const std::optional<Generated>& generated = m_analysis.scene.generated;
        if (generated && generated->bodies)
            add(CompletionKind::Label, generated->bodies.name, "each generated body", row.help);
        std::map<std::string_view, std::size_t> members;
        for (const Body& body : m_analysis.scene.bodies)
            if (const std::string_view family = familyOf(body.label); !family.empty()) ++members[family];
        for (const auto& [family, count] : members)
            if (count > 1 && m_analysis.scene.labelled(family) == noBody)
                add(CompletionKind::Label, family, "each of " + std::to_string(count) + " bodies", row.help);
    }

    const Analysis& m_analysis;
    std::uint32_t m_offset;
    std::size_t m_next = 0; ///< the first token behind the place and its word
    CompletionList m_list;
};

HoverText hoverOfValue(const Analysis& analysis, const ParameterSyntax& parameter, const ParameterRow& row) {
    const std::string word(textOf(analysis.text, parameter.value));
    HoverText hover{parameter.value, word, "value of " + std::string(row.name), std::string(row.help)};
    if (const NamedColour* colour = findByName(namedColours(), word); colour && row.kind == ValueKind::Colour)
        hover.detail = shownColour(*colour);
    return hover;
}

} // namespace

CompletionList completionsAt(const Analysis& analysis, std::uint32_t offset) {
    return Completer(analysis, offset).run();
}

std::optional<HoverText> hoverAt(const Analysis& analysis, std::uint32_t offset) {
    const DeclarationSyntax* declaration = declarationAt(analysis, offset);
    if (declaration == nullptr) return std::nullopt;
    const DeclarationRow* row = findDeclaration(textOf(analysis.text, declaration->type));
    if (row == nullptr) return std::nullopt;
    const auto holds = [offset](SourceRange range) {
        return range.offset <= offset && offset <= range.end();
    };
    if (holds(declaration->type))
        return HoverText{declaration->type, std::string(row->name), signatureOf(*row),
                         std::string(row->help)};
    if (declaration->label.length > 0 && holds(declaration->label))
        return HoverText{declaration->label, std::string(textOf(analysis.text, declaration->label)),
                         (row->isBody ? "label of a " : "label of this ") + std::string(row->name),
                         std::string(row->help)};
    const ParameterSyntax* parameter = parameterAt(analysis, *declaration, offset);
    if (parameter == nullptr) return std::nullopt;
    const ParameterRow* known = row->find(textOf(analysis.text, parameter->name));
    if (known == nullptr) return std::nullopt;
    if (parameter->kind == SyntaxValueKind::Word && !holds(parameter->name))
        return hoverOfValue(analysis, *parameter, *known);
    return HoverText{parameter->name, std::string(row->name) + "." + std::string(known->name),
                     summaryOf(*known), std::string(known->help)};
}

} // namespace carom
