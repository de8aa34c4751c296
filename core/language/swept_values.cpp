// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/swept_values.h"

#include "core/base/figures.h"
#include "core/base/text.h"

#include <cmath>
#include <optional>

namespace carom {
namespace {

constexpr long long mostValues = 1'000'000;

std::vector<std::string> partsOf(std::string_view text, char separator) {
    std::vector<std::string> parts(1);
    for (const char c : text)
        if (c == separator)
            parts.emplace_back();
        else
            parts.back() += c;
    return parts;
}

/// "4:12:17", or with `logarithmic` "1e-3:1:7".
std::string readRange(std::string_view text, bool logarithmic, SweptParameter& parameter) {
    const std::vector<std::string> parts = partsOf(text, ':');
    if (parts.size() != 3) return "a range has three numbers, first:last:count";
    const std::optional<double> first = looseNumberIn(parts[0]), last = looseNumberIn(parts[1]);
    const std::optional<long long> count = wholeNumberIn(parts[2]);
    if (!first || !last) return "`" + (first ? parts[1] : parts[0]) + "` is no number";
    if (!count || *count < 1 || *count > mostValues)
        return "the count is `" + parts[2] + "`; it must be a whole number from 1 to 1000000";
    if (logarithmic && !(*first > 0 && *last > 0)) return "a logarithmic range lies above 0";
    for (long long i = 0; i < *count; ++i) {
        const double share = *count > 1 ? static_cast<double>(i) / static_cast<double>(*count - 1) : 0;
        const double between =
            logarithmic ? *first * std::pow(*last / *first, share) : *first + (*last - *first) * share;
        const bool isEnd = i == 0 || i + 1 == *count; // which are as they are written
        parameter.values.push_back(isEnd ? shortest(i == 0 ? *first : *last) : sweepNumber(between));
    }
    return {};
}

std::string readLaw(std::string_view text, SweptParameter::Law law, SweptParameter& parameter) {
    const std::vector<std::string> parts = partsOf(text, ':');
    const bool isUniform = law == SweptParameter::Law::Uniform;
    const std::optional<double> a = looseNumberIn(parts[0]);
    const std::optional<double> b = parts.size() == 2 ? looseNumberIn(parts[1]) : std::nullopt;
    if (!a || !b)
        return isUniform ? "a uniform law has two numbers, least:most"
                         : "a normal law has two numbers, mean:deviation";
    if (isUniform ? *b < *a : *b < 0)
        return isUniform ? "the least is above the most" : "the deviation is below 0";
    parameter.law = law;
    parameter.a = *a;
    parameter.b = *b;
    return {};
}

} // namespace

std::optional<double> looseNumberIn(std::string_view text) {
    const bool negative = text.starts_with('-');
    const std::string_view digits = text.substr(negative ? 1 : 0);
    return digits.starts_with('.') ? numberIn((negative ? "-0" : "0") + std::string(digits)) : numberIn(text);
}

std::string sweepNumber(double value) {
    constexpr int digits = 12; // so that 0.1 + 0.2 reads 0.3; steps of a range are off by some 1e-16
    const double rounded = numberIn(figure(value, digits)).value_or(value);
    return shortest(rounded == 0 ? 0 : rounded); // no minus before a zero
}

std::string readValues(std::string_view text, SweptParameter& parameter) {
    const auto behind = [&](std::string_view word) {
        return text.starts_with(word) ? std::optional(text.substr(word.size())) : std::nullopt;
    };
    if (const auto range = behind("log ")) return readRange(*range, true, parameter);
    if (const auto law = behind("uniform ")) return readLaw(*law, SweptParameter::Law::Uniform, parameter);
    if (const auto law = behind("normal ")) return readLaw(*law, SweptParameter::Law::Normal, parameter);
    if (text.find(':') != text.npos) return readRange(text, false, parameter);
    for (const std::string& word : partsOf(text, ',')) {
        if (word.empty()) return "a value is missing";
        const std::optional<double> number = looseNumberIn(word);
        parameter.values.push_back(number ? shortest(*number) : word);
    }
    return {};
}

std::string readVary(std::string_view text, SweptParameter& parameter) {
    const std::size_t equals = text.find('=');
    const std::optional<ParameterPath> path = parameterPathIn(text.substr(0, equals));
    if (equals == text.npos || !path) return "it is not of the form `cue.vel.x=4:12:17`";
    parameter.name = text.substr(0, equals);
    parameter.path = *path;
    return readValues(text.substr(equals + 1), parameter);
}

} // namespace carom
