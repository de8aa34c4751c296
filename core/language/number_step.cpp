// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/number_step.h"

#include "core/base/text.h"
#include "core/language/navigation.h"
#include "core/scene/schema.h"

#include <algorithm>
#include <cstdlib>

namespace carom {
namespace {

constexpr std::int64_t most = 99'999'999'999'999'999; // 17 digits: exact in 64 bits with room for a step

/// A literal taken apart: ± digits, of which `decimals` stand behind the point, and the exponent as written.
struct Literal {
    std::int64_t digits = 0; ///< signed
    std::size_t decimals = 0;
    bool point = false;
    bool leadingDigit = true; ///< something stands in front of the point: "0.5", not ".5"
    std::string_view exponent;
};

std::optional<Literal> takenApart(std::string_view text) {
    Literal literal;
    const bool negative = text.starts_with('-');
    std::size_t i = negative ? 1 : 0;
    while (i < text.size() && (text[i] == ' ' || text[i] == '\t')) ++i; // `- 1` is allowed, too
    const std::size_t first = i;
    for (; i < text.size() && text[i] != 'e' && text[i] != 'E'; ++i) {
        if (text[i] == '.') {
            literal.point = true;
            literal.leadingDigit = i > first;
            continue;
        }
        if (text[i] < '0' || text[i] > '9') return std::nullopt;
        literal.digits = literal.digits * 10 + (text[i] - '0');
        if (literal.digits > most) return std::nullopt;
        if (literal.point) ++literal.decimals;
    }
    literal.exponent = text.substr(i);
    if (negative) literal.digits = -literal.digits;
    return literal;
}

std::string putTogether(const Literal& literal) {
    std::string digits = std::to_string(std::llabs(literal.digits));
    const std::size_t least = literal.decimals + (literal.leadingDigit ? 1 : 0);
    if (digits.size() < least) digits.insert(0, least - digits.size(), '0');
    if (literal.point) digits.insert(digits.size() - literal.decimals, ".");
    return (literal.digits < 0 ? "-" : "") + digits + std::string(literal.exponent);
}

double valueOf(std::string_view literal) {
    std::string joined(literal);
    std::erase_if(joined, [](char c) { return c == ' ' || c == '\t'; });
    return numberIn(joined).value_or(0);
}

} // namespace

bool NumberAt::allows(double value) const {
    const bool above = leastIsAllowed ? value >= least : value > least;
    const bool below = greatestIsAllowed ? value <= greatest : value < greatest;
    return above && below;
}

NumberAt boundsOf(Constraint constraint) {
    constexpr double halfTurn = 180; // degrees
    NumberAt number;
    switch (constraint) {
    case Constraint::Positive:
        number.leastIsAllowed = false;
        [[fallthrough]];
    case Constraint::NotNegative:
        number.least = 0;
        break;
    case Constraint::UnitRange:
        number.least = 0;
        number.greatest = 1;
        break;
    case Constraint::AtLeastOne:
        number.least = 1;
        break;
    case Constraint::FieldOfView:
        number.least = 0;
        number.greatest = halfTurn;
        number.leastIsAllowed = number.greatestIsAllowed = false;
        break;
    case Constraint::None:
    case Constraint::NonzeroVector: // one component alone may be anything
        break;
    }
    return number;
}

std::optional<NumberAt> numberAt(const Analysis& analysis, std::uint32_t offset) {
    const std::vector<Token>& tokens = analysis.tokens;
    auto token = std::lower_bound(tokens.begin(), tokens.end(), offset,
                                  [](const Token& t, std::uint32_t o) { return t.range.end() < o; });
    // A place between two tokens touches both; a sign belongs to the number behind it.
    while (token != tokens.end() && token->range.offset <= offset && token->kind != TokenKind::Number) {
        const bool signOfNumber = token->kind == TokenKind::Minus && token + 1 != tokens.end() &&
                                  (token + 1)->kind == TokenKind::Number;
        ++token;
        if (signOfNumber) break;
    }
    if (token == tokens.end() || token->kind != TokenKind::Number) return std::nullopt;
    const bool negative = token != tokens.begin() && (token - 1)->kind == TokenKind::Minus;
    const SourceRange range = negative ? spanning((token - 1)->range, token->range) : token->range;
    if (range.offset > offset) return std::nullopt;

    const DeclarationSyntax* declaration = declarationAt(analysis, token->range.offset);
    const ParameterSyntax* parameter =
        declaration == nullptr ? nullptr : parameterAt(analysis, *declaration, token->range.offset);
    const DeclarationRow* row =
        parameter == nullptr ? nullptr : findDeclaration(textOf(analysis.text, declaration->type));
    const ParameterRow* known = row == nullptr ? nullptr : row->find(textOf(analysis.text, parameter->name));
    NumberAt number = boundsOf(known == nullptr ? Constraint::None : known->constraint);
    number.range = range;
    return number;
}

std::optional<std::string> stepped(std::string_view literal, std::int64_t steps) {
    std::optional<Literal> parts = takenApart(literal);
    if (!parts || steps > most || steps < -most) return std::nullopt;
    parts->digits += steps;
    if (parts->digits > most || parts->digits < -most) return std::nullopt;
    return putTogether(*parts);
}

std::optional<std::string> steppedWithin(const NumberAt& bounds, std::string_view literal,
                                         std::int64_t steps) {
    const auto allowed = [&](std::int64_t n) {
        const std::optional<std::string> text = stepped(literal, n);
        return text && bounds.allows(valueOf(*text));
    };
    if (!bounds.allows(valueOf(literal)) || allowed(steps)) return stepped(literal, steps);
    // What is allowed is one interval, so the last allowed step is found by halving.
    std::int64_t good = 0;
    std::int64_t bad = steps;
    while (std::llabs(bad - good) > 1) {
        const std::int64_t middle = good + (bad - good) / 2;
        (allowed(middle) ? good : bad) = middle;
    }
    return stepped(literal, good);
}

} // namespace carom
