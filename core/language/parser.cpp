// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/parser.h"

#include "core/base/numeral.h"
#include "core/base/text.h"
#include "core/language/token_cursor.h"
#include "core/language/wording.h"
#include "core/scene/schema.h"

#include <algorithm>
#include <array>
#include <string>

// Recursive descent without the recursion: the grammar nests to a fixed depth. The schema is used only where
// a mistake must be distinguished from a valid text: is this name a parameter, does this line begin a
// declaration?

namespace carom {
namespace {

class Parser : private TokenCursor {
  public:
    Parser(std::string_view text, std::span<const Token> tokens, DiagnosticList& diagnostics,
           std::size_t mostDeclarations)
        : TokenCursor(text, tokens), m_text(text), m_diagnostics(diagnostics),
          m_mostDeclarations(mostDeclarations) {
        reserve(tokens);
    }

    SyntaxTree run(const WorkStage& stage) {
        for (std::size_t look = 0; !at(TokenKind::EndOfText); ++look) {
            stage.reach(look, here().offset, m_text.size());
            if (m_tree.declarations.size() >= m_mostDeclarations) {
                reportTooMany();
                break;
            }
            if (at(TokenKind::Name) || at(TokenKind::Faulty))
                parseDeclaration();
            else
                skipStray();
        }
        return std::move(m_tree);
    }

  private:
    void advance() {
        const bool unexpected = TokenCursor::advance();
        m_now.broken = m_now.broken || (unexpected && m_inside);
    }

    // Reports inside the declaration being read.
    Diagnostic* fail(DiagnosticCode code, SourceRange range) {
        m_now.broken = true;
        return m_diagnostics.report(code, range);
    }

    void skipStray() {
        const SourceRange first = here();
        if (at(TokenKind::CloseBrace) || at(TokenKind::Semicolon)) {
            const TokenKind run = kind();
            while (at(run)) advance();
            const SourceRange all = spanning(first, last());
            const bool brace = run == TokenKind::CloseBrace;
            if (Diagnostic* diagnostic = m_diagnostics.report(
                    brace ? DiagnosticCode::StrayBrace : DiagnosticCode::ExpectedDeclaration, all)) {
                diagnostic->message = brace ? "`}` closes nothing; remove it, or put the `{` it belongs to"
                                            : "`;` ends nothing; a `;` stands in the place of `{ ... }`";
                diagnostic->fixIt = removal(m_text, all, brace ? "remove `}`" : "remove `;`");
            }
            return;
        }
        if (Diagnostic* diagnostic = m_diagnostics.report(DiagnosticCode::ExpectedDeclaration, first)) {
            std::vector<std::string_view> names;
            for (const DeclarationRow& row : schema()) names.push_back(row.name);
            diagnostic->message =
                "expected a declaration, found " + found() + "; one begins with " + listed(names, "or");
        }
        skipToEnd();
    }

    // Behind the `}` or `;` that ends what was broken, or before the line that begins something new.
    void skipToEnd() {
        int depth = 0;
        for (; !at(TokenKind::EndOfText) && !atNewDeclaration(); advance()) {
            if (at(TokenKind::OpenBrace)) ++depth;
            const bool ends =
                at(TokenKind::CloseBrace) ? --depth <= 0 : at(TokenKind::Semicolon) && depth == 0;
            if (!ends) continue;
            m_inside = false;
            advance();
            return;
        }
    }

    void reportTooMany() {
        if (Diagnostic* diagnostic = m_diagnostics.report(DiagnosticCode::TooManyDeclarations, here()))
            diagnostic->message = "a scene has at most " + std::to_string(m_mostDeclarations) +
                                  " declarations; the rest of the text is not read";
    }

    void parseDeclaration() {
        m_now = {};
        m_now.type = here();
        m_now.firstParameter = static_cast<std::uint32_t>(m_tree.parameters.size());
        m_now.broken = m_now.nameless = at(TokenKind::Faulty);
        m_inside = true;
        m_row = m_now.nameless ? nullptr : findDeclaration(spelling(m_now.type));
        advance();
        const bool labelled = (at(TokenKind::Name) && !atNewDeclaration()) || at(TokenKind::Faulty);
        if (labelled) {
            m_now.label = here();
            m_now.broken = m_now.broken || at(TokenKind::Faulty);
            advance();
        }
        if (at(TokenKind::OpenBrace)) {
            parseParameters();
        } else if (at(TokenKind::Semicolon)) {
            close();
        } else {
            reportNoList();
            m_now.incomplete = m_now.nameless = true;
            skipToEnd();
            finish();
        }
    }

    void reportNoList() {
        const bool atEnd = at(TokenKind::EndOfText) || atNewDeclaration();
        Diagnostic* diagnostic = fail(DiagnosticCode::ExpectedParameterList, atEnd ? m_now.type : here());
        if (diagnostic == nullptr) return;
        diagnostic->message = "expected `{` or `;` behind " + quoted(spelling(last())) + ", found " + found();
        const bool labelIsParameter = m_row != nullptr && m_row->find(spelling(m_now.label)) != nullptr;
        const bool braceMissing = labelIsParameter || (!atEnd && parameterRow(here()) != nullptr);
        const SourceRange behind = {labelIsParameter ? m_now.type.end() : last().end(), 0};
        if (braceMissing) diagnostic->fixIt = FixIt{"insert `{`", {behind, " {"}};
    }

    // Takes the `}` or `;` that ends the declaration.
    void close() {
        m_inside = false;
        advance();
        finish();
    }

    void finish() {
        m_inside = false;
        m_now.range = spanning(m_now.type, last());
        m_now.parameterCount = static_cast<std::uint32_t>(m_tree.parameters.size()) - m_now.firstParameter;
        m_tree.declarations.push_back(m_now);
    }

    void parseParameters() {
        const SourceRange open = here();
        advance();
        m_resuming = false;
        for (;;) {
            if (at(TokenKind::CloseBrace)) return close();
            if (at(TokenKind::EndOfText) || atDeclarationInside()) {
                if (!m_resuming || at(TokenKind::EndOfText)) reportUnclosed(open);
                m_now.incomplete = true;
                return finish();
            }
            if (at(TokenKind::Name) || at(TokenKind::Faulty)) {
                parseParameter();
            } else if (at(TokenKind::Semicolon)) {
                if (!m_resuming) reportSemicolon();
                advance();
            } else {
                if (Diagnostic* diagnostic = fail(DiagnosticCode::ExpectedParameter, here()))
                    diagnostic->message = "expected a parameter's name or `}`, found " + found();
                skipInside();
            }
        }
    }

    void reportUnclosed(SourceRange open) {
        Diagnostic* diagnostic = fail(DiagnosticCode::UnclosedDeclaration, open);
        if (diagnostic == nullptr) return;
        diagnostic->message = "this `{` is never closed; a `}` is missing before " + found();
        diagnostic->notes.push_back({here(), "the `}` is missed here"});
        diagnostic->fixIt = FixIt{"insert `}`", {{last().end(), 0}, " }"}};
    }

    void reportSemicolon() {
        Diagnostic* diagnostic = fail(DiagnosticCode::ExpectedParameter, here());
        if (diagnostic == nullptr) return;
        diagnostic->message = "`;` does not separate parameters; white space does";
        diagnostic->fixIt = removal(m_text, here(), "remove `;`");
    }

    // To the `}` or `;` of the same list, or to what looks like the next declaration.
    void skipInside() {
        m_resuming = true;
        m_now.incomplete = true;
        int depth = 0;
        for (; !at(TokenKind::EndOfText) && !atDeclarationInside(); advance()) {
            if (depth == 0 && (at(TokenKind::CloseBrace) || at(TokenKind::Semicolon))) return;
            if (at(TokenKind::OpenBrace)) ++depth;
            if (at(TokenKind::CloseBrace)) --depth;
        }
    }

    const ParameterRow* parameterRow(SourceRange name) const {
        return m_row == nullptr ? nullptr : m_row->find(spelling(name));
    }

    void parseParameter() {
        m_resuming = false;
        ParameterSyntax parameter;
        parameter.name = here();
        const bool faulty = at(TokenKind::Faulty);
        if (!faulty && isUnitOfNumber()) return;
        advance();
        if (at(TokenKind::Colon)) advance();
        if (faulty) m_now.broken = m_now.incomplete = true;
        m_expected = faulty ? nullptr : parameterRow(parameter.name);
        if (atScalar())
            parseScalars(parameter);
        else if (at(TokenKind::Text))
            parseWord(parameter, SyntaxValueKind::Text);
        else if (at(TokenKind::Name) && !isNextParameter())
            parseWord(parameter, SyntaxValueKind::Word);
        else
            reportNoValue(parameter.name, faulty);
        if (!faulty) m_tree.parameters.push_back(parameter);
    }

    // `10m`: a name that touches the number before it and is no parameter was meant as its unit.
    bool isUnitOfNumber() {
        if (!touchesNumber() || m_row == nullptr || parameterRow(here()) != nullptr) return false;
        const SourceRange whole = spanning(last(), here());
        if (Diagnostic* diagnostic = fail(DiagnosticCode::MalformedNumber, whole)) {
            diagnostic->message =
                quoted(spelling(whole)) + " is not a number; units are not written, all are SI units";
            diagnostic->fixIt = FixIt{"remove " + quoted(spelling(here())), {here(), {}}};
        }
        advance();
        return true;
    }

    // Whether the name at the cursor is rather the next parameter than the value of this one.
    bool isNextParameter() const {
        if (atNewDeclaration()) return true;
        const TokenKind ahead = kindAhead();
        const bool valueAhead =
            ahead == TokenKind::Number || ahead == TokenKind::Minus || ahead == TokenKind::Colon;
        const bool known = parameterRow(here()) != nullptr;
        if (m_expected == nullptr) return valueAhead;
        switch (m_expected->kind) {
        case ValueKind::Label:
            return known && valueAhead;
        case ValueKind::Word:
        case ValueKind::Colour:
            return known;
        default:
            return known || valueAhead;
        }
    }

    void parseWord(ParameterSyntax& parameter, SyntaxValueKind kind) {
        parameter.kind = kind;
        parameter.value = here();
        advance();
    }

    void reportNoValue(SourceRange name, bool alreadyReported) {
        m_now.broken = true;
        const bool goesOn = at(TokenKind::Name) || at(TokenKind::CloseBrace) || at(TokenKind::Semicolon) ||
                            at(TokenKind::EndOfText);
        if (!alreadyReported) {
            if (Diagnostic* diagnostic = m_diagnostics.report(DiagnosticCode::ExpectedValue, name)) {
                const std::string_view takes = m_expected == nullptr ? "a value" : phraseOf(m_expected->kind);
                diagnostic->message = quoted(spelling(name)) + " has no value; expected " +
                                      std::string(takes) + ", found " + found();
                if (goesOn && m_expected != nullptr) {
                    const std::string example(m_expected->example);
                    diagnostic->fixIt = FixIt{"insert `" + example + "`", {{last().end(), 0}, " " + example}};
                }
            }
        }
        if (!goesOn) skipInside();
    }

    struct Components {
        std::array<double, 3> values{};
        std::size_t count = 0;
        bool reported = false; ///< something is wrong with them and has been said
        bool spaced = false;   ///< a comma is missing between two
    };

    void parseScalars(ParameterSyntax& parameter) {
        const SourceRange first = here();
        Components components;
        for (;;) {
            if (!parseComponent(components)) break;
            if (at(TokenKind::Comma)) {
                if (!takeComma(components)) break;
            } else if (at(TokenKind::Number) || at(TokenKind::Minus)) {
                components.spaced = true;
            } else {
                break;
            }
        }
        parameter.value = spanning(first, last());
        if (!components.reported) judge(parameter, components);
        if (components.reported) {
            m_now.broken = true;
            return;
        }
        parameter.kind = components.count == 1 ? SyntaxValueKind::Scalar : SyntaxValueKind::Vector;
        parameter.firstScalar = static_cast<std::uint32_t>(m_tree.scalars.size());
        m_tree.scalars.insert(m_tree.scalars.end(), components.values.begin(),
                              components.values.begin() + static_cast<std::ptrdiff_t>(components.count));
    }

    // Signs and a number. False where only signs were there.
    bool parseComponent(Components& into) {
        const SourceRange first = here();
        bool negative = false;
        while (at(TokenKind::Minus)) {
            negative = !negative;
            advance();
        }
        if (at(TokenKind::Number)) {
            const double value = numberHere(into);
            if (into.count < into.values.size()) into.values[into.count] = negative ? -value : value;
        } else if (at(TokenKind::Faulty)) {
            into.reported = true;
        } else {
            if (!into.reported)
                if (Diagnostic* diagnostic = fail(DiagnosticCode::ExpectedValue, spanning(first, last())))
                    diagnostic->message = "expected a number behind `-`, found " + found();
            into.reported = true;
            return false;
        }
        ++into.count;
        advance();
        return true;
    }

    double numberHere(Components& into) {
        const NumeralReading reading = readNumeral(spelling(here()));
        if (reading.fault == NumeralFault::None) return reading.value;
        into.reported = true;
        if (Diagnostic* diagnostic = fail(DiagnosticCode::NumberOutOfRange, here()))
            diagnostic->message =
                quoted(spelling(here())) + " is too large; the largest number is 1.7976931348623157e+308";
        return 0;
    }

    // Takes the comma behind a component. False where no component follows: then that is reported.
    bool takeComma(Components& into) {
        const SourceRange comma = here();
        advance();
        if (atScalar()) return true;
        const bool nextParameter = at(TokenKind::CloseBrace) || at(TokenKind::EndOfText) ||
                                   at(TokenKind::Semicolon) || (at(TokenKind::Name) && isParameterOrBegins());
        const bool separates = nextParameter && (into.count == 1 || into.count == 3);
        if (!into.reported) {
            const DiagnosticCode code =
                separates ? DiagnosticCode::ExpectedParameter : DiagnosticCode::IncompleteVector;
            if (Diagnostic* diagnostic = fail(code, separates || nextParameter ? comma : here())) {
                diagnostic->message =
                    separates ? "`,` separates the components of a vector, not parameters; remove it"
                              : "expected a number behind `,`, found " + found();
                if (separates) diagnostic->fixIt = FixIt{"remove `,`", {comma, {}}};
            }
        }
        into.reported = true;
        if (nextParameter) return false;
        while (at(TokenKind::Comma) || at(TokenKind::Name)) advance();
        return atScalar();
    }

    bool isParameterOrBegins() const {
        const TokenKind ahead = kindAhead();
        return parameterRow(here()) != nullptr || atNewDeclaration() || ahead == TokenKind::Number ||
               ahead == TokenKind::Minus || ahead == TokenKind::Colon;
    }

    // Whether the components make a number or a vector.
    void judge(const ParameterSyntax& parameter, Components& components) {
        const bool right = !components.spaced && (components.count == 1 || components.count == 3);
        if (right) return;
        components.reported = true;
        Diagnostic* diagnostic = fail(DiagnosticCode::IncompleteVector, parameter.value);
        if (diagnostic == nullptr) return;
        if (components.spaced && components.count == 3) {
            diagnostic->message = "the components of a vector are separated by commas";
            std::string corrected;
            for (const double value : components.values)
                corrected += (corrected.empty() ? "" : ", ") + shortest(value);
            diagnostic->fixIt = replaceBy(parameter.value, corrected);
        } else {
            diagnostic->message = quoted(spelling(parameter.value)) + " has " +
                                  std::to_string(components.count) +
                                  " components; a value is one number, or three separated by commas";
        }
    }

    // Room for the most there can be (pages never touched cost nothing), so that no vector is ever copied
    // while it is large.
    void reserve(std::span<const Token> tokens) {
        std::size_t lists = 0;
        std::size_t numbers = 0;
        std::size_t names = 0;
        for (const Token& token : tokens) {
            lists += token.kind == TokenKind::OpenBrace || token.kind == TokenKind::Semicolon ? 1 : 0;
            numbers += token.kind == TokenKind::Number ? 1 : 0;
            names += token.kind == TokenKind::Name ? 1 : 0;
        }
        m_tree.declarations.reserve(std::min(lists + 1, m_mostDeclarations));
        m_tree.parameters.reserve(names);
        m_tree.scalars.reserve(numbers);
    }

    std::string_view m_text;
    DiagnosticList& m_diagnostics;
    std::size_t m_mostDeclarations;
    SyntaxTree m_tree;
    DeclarationSyntax m_now;                  ///< the declaration being read
    const DeclarationRow* m_row = nullptr;    ///< its row; null where its type is unknown
    const ParameterRow* m_expected = nullptr; ///< the row of the parameter being read
    bool m_inside = false;                    ///< a declaration is being read
    bool m_resuming = false;                  ///< an error in this list is behind, no parameter since
};

} // namespace

SyntaxTree parse(std::string_view text, std::span<const Token> tokens, DiagnosticList& diagnostics,
                 std::size_t mostDeclarations, const WorkStage& stage) {
    return Parser(text, tokens, diagnostics, mostDeclarations).run(stage);
}

} // namespace carom
