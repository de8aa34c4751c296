// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/number_rewrite.h"

#include "core/base/numeral.h"
#include "core/base/text.h"
#include "core/language/lexer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace carom {
namespace {

constexpr int mostDecimals = 17; // more a double does not have

/// The numbers of a text with their minus, in order.
std::vector<SourceRange> literalsOf(std::string_view text) {
    std::vector<SourceRange> literals;
    DiagnosticList ignored;
    const std::vector<Token> tokens = lex(text, ignored);
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        if (tokens[i].kind != TokenKind::Number) continue;
        SourceRange range = tokens[i].range;
        if (i > 0 && tokens[i - 1].kind == TokenKind::Minus) {
            const std::uint32_t begin = tokens[i - 1].range.offset;
            range = {begin, range.end() - begin};
        }
        literals.push_back(range);
    }
    return literals;
}

int decimalsOf(std::string_view literal) {
    const std::size_t point = literal.find('.');
    if (point == std::string_view::npos) return 0;
    return static_cast<int>(std::min<std::size_t>(literal.size() - point - 1, mostDecimals));
}

std::string written(double value, int decimals) {
    std::array<char, 400> buffer{};
    const std::to_chars_result end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                                   std::chars_format::fixed, decimals);
    std::string text(buffer.data(), end.ptr);
    const bool zero = text.find_first_not_of("-0.") == std::string::npos;
    return zero && text.starts_with('-') ? text.substr(1) : text;
}

std::string_view digitsOf(std::string_view literal) {
    return literal.substr(literal.find_first_not_of("- \t\r\n"));
}

double numberOf(std::string_view literal) {
    return (literal.starts_with('-') ? -1 : 1) * readNumeral(digitsOf(literal)).value;
}

std::string rewritten(std::string_view literal, double value, int leastDecimals) {
    const std::string_view digits = digitsOf(literal);
    const double before = numberOf(literal);
    const bool hasExponent = literal.find_first_of("eE") != std::string_view::npos;
    const int decimals = std::max(decimalsOf(digits), leastDecimals);
    const double same = hasExponent ? 0 : 0.5 * std::pow(10.0, -decimals);
    if (std::abs(value - before) <= same) return std::string(literal);
    if (hasExponent || std::abs(value) >= 1e15) return shortest(value);
    std::string text = written(value, decimals);
    // Zeros behind the decimals its writer gave say nothing.
    while (decimalsOf(text) > decimalsOf(digits) && text.ends_with('0')) text.pop_back();
    if (text.ends_with('.')) text.pop_back();
    return text;
}

} // namespace

std::optional<std::string> withNumbers(std::string_view value, std::span<const double> numbers,
                                       int leastDecimals) {
    const std::vector<SourceRange> literals = literalsOf(value);
    if (literals.size() != numbers.size()) return std::nullopt;
    std::string text;
    std::uint32_t copied = 0;
    for (std::size_t i = 0; i < literals.size(); ++i) {
        text += value.substr(copied, literals[i].offset - copied);
        text += rewritten(textOf(value, literals[i]), numbers[i], leastDecimals);
        copied = literals[i].end();
    }
    return text.append(value.substr(copied));
}

std::vector<double> numbersOf(std::string_view value) {
    std::vector<double> numbers;
    for (const SourceRange& literal : literalsOf(value)) numbers.push_back(numberOf(textOf(value, literal)));
    return numbers;
}

} // namespace carom
