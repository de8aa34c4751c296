// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/options.h"

#include "app/errors.h"
#include "core/base/catalogue.h"
#include "core/base/text.h"

#include <algorithm>
#include <limits>

namespace carom {
namespace {

/// Options that every table has without listing them.
constexpr std::string_view always[] = {"help"};

std::string quoted(std::string_view text) { return std::string("`").append(text).append("`"); }

class Reader {
  public:
    Reader(std::span<const std::string> words, std::span<const OptionRow> rows)
        : m_words(words), m_rows(rows) {}

    Arguments read() {
        for (m_next = 0; m_next < m_words.size();) {
            const std::string_view word = m_words[m_next++];
            if (word == "--") {
                m_result.operands.insert(m_result.operands.end(),
                                         m_words.begin() + static_cast<std::ptrdiff_t>(m_next),
                                         m_words.end());
                break;
            }
            if (word.starts_with("--"))
                readLong(word);
            else if (word.size() > 1 && word.front() == '-')
                readLetters(word);
            else
                m_result.operands.emplace_back(word);
        }
        return std::move(m_result);
    }

  private:
    void readLong(std::string_view word) {
        const std::size_t equals = word.find('=');
        const std::string_view name = word.substr(2, equals == word.npos ? word.npos : equals - 2);
        std::optional<std::string> value;
        if (equals != word.npos) value = word.substr(equals + 1);
        const OptionRow* row = findByName(m_rows, name);
        const bool takesNothing = row ? row->argument.empty() : std::ranges::count(always, name) > 0;
        if (!row && !takesNothing) throw UsageError(unknown(name));
        if (takesNothing && value)
            throw UsageError("option " + quoted(word.substr(0, equals)) + " takes no value");
        if (!takesNothing && !value) value = nextWord(word, *row);
        take(name, value.value_or(""));
    }

    void readLetters(std::string_view word) {
        for (std::size_t i = 1; i < word.size(); ++i) {
            const char letter = word[i];
            const auto row = std::ranges::find(m_rows, letter, &OptionRow::letter);
            if (letter == 'h' && row == m_rows.end()) {
                take("help", "");
                continue;
            }
            if (row == m_rows.end()) throw UsageError("unknown option " + quoted(std::string("-") + letter));
            if (row->argument.empty()) {
                take(row->name, "");
                continue;
            }
            const std::string_view rest = word.substr(i + 1);
            take(row->name, rest.empty() ? nextWord(std::string("-") + letter, *row) : std::string(rest));
            return;
        }
    }

    void take(std::string_view option, const std::string& value) {
        m_result.values[std::string(option)] = value;
        m_result.inOrder.emplace_back(option, value);
    }

    std::string nextWord(std::string_view option, const OptionRow& row) {
        if (m_next == m_words.size())
            throw UsageError("option " + quoted(option) + " needs a value: " + row.argument);
        return m_words[m_next++];
    }

    std::string unknown(std::string_view name) const {
        std::vector<std::string_view> names(std::begin(always), std::end(always));
        for (const OptionRow& row : m_rows) names.emplace_back(row.name);
        const std::optional<std::string_view> near = nearestName(name, names);
        return "unknown option " + quoted(std::string("--").append(name)) +
               (near ? "; did you mean " + quoted(std::string("--").append(*near)) + "?" : "");
    }

    std::span<const std::string> m_words;
    std::span<const OptionRow> m_rows;
    std::size_t m_next = 0;
    Arguments m_result;
};

} // namespace

std::optional<std::string> Arguments::text(std::string_view option) const {
    const auto found = values.find(option);
    if (found == values.end()) return std::nullopt;
    return found->second;
}

std::vector<std::string> Arguments::texts(std::string_view option) const {
    std::vector<std::string> given;
    for (const auto& [name, value] : inOrder)
        if (name == option) given.push_back(value);
    return given;
}

std::optional<std::int64_t> Arguments::wholeNumber(std::string_view option, std::int64_t least,
                                                   std::int64_t most) const {
    const std::optional<std::string> given = text(option);
    if (!given) return std::nullopt;
    const std::optional<long long> number = wholeNumberIn(*given);
    if (!number || *number < least || *number > most) {
        const bool bounded = most != std::numeric_limits<std::int64_t>::max();
        throw UsageError(quoted(std::string("--").append(option)) + " is " + quoted(*given) +
                         "; it must be a whole number from " + std::to_string(least) +
                         (bounded ? " to " + std::to_string(most) : " on"));
    }
    return *number;
}

std::optional<double> Arguments::positiveNumber(std::string_view option) const {
    const std::optional<std::string> given = text(option);
    if (!given) return std::nullopt;
    const std::optional<double> number = numberIn(*given);
    if (!number || *number <= 0)
        throw UsageError(quoted(std::string("--").append(option)) + " is " + quoted(*given) +
                         "; it must be a number above 0");
    return number;
}

std::optional<std::string> Arguments::word(std::string_view option,
                                           std::span<const std::string_view> words) const {
    std::optional<std::string> given = text(option);
    if (!given || std::ranges::count(words, *given) > 0) return given;
    const std::optional<std::string_view> near = nearestName(*given, words);
    throw UsageError(quoted(std::string("--").append(option)) + " is " + quoted(*given) +
                     (near ? "; did you mean " + quoted(*near) + "?" : "; it must be " + listOf(words)));
}

OptionRow shardOption() {
    return {"shard", 0, "I/N", "only the I-th of N parts of equal work (the first is 1)"};
}

Shard shardFrom(const Arguments& arguments) {
    const std::optional<std::string> text = arguments.text("shard");
    const std::optional<Shard> shard = text ? shardIn(*text) : Shard();
    if (!shard)
        throw UsageError("`--shard` is `" + *text +
                         "`; it must be a part and a number of parts such as `3/8`");
    return *shard;
}

Arguments readArguments(std::span<const std::string> words, std::span<const OptionRow> rows) {
    return Reader(words, rows).read();
}

std::string describe(std::span<const OptionRow> rows) {
    constexpr std::size_t helpColumn = 28;
    std::string result;
    for (const OptionRow& row : rows) {
        std::string line = row.letter ? std::string("  -") + row.letter + ", " : std::string("      ");
        line += "--" + row.name;
        if (!row.argument.empty()) line += " " + row.argument;
        line += line.size() + 2 > helpColumn ? "\n" + std::string(helpColumn, ' ')
                                             : std::string(helpColumn - line.size(), ' ');
        result += line + wrapped(row.help, helpColumn, helpColumn) + "\n";
    }
    return result;
}

std::string wrapped(std::string_view text, std::size_t indent, std::size_t column) {
    constexpr std::size_t width = 100;
    std::string result;
    bool lineIsEmpty = true;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find_first_of(" \n", begin), text.size());
        const std::size_t length = end - begin;
        if (!lineIsEmpty && column + 1 + length > width) {
            result.append("\n").append(indent, ' ');
            column = indent;
            lineIsEmpty = true;
        }
        if (!lineIsEmpty && length > 0) {
            result += ' ';
            ++column;
        }
        result += text.substr(begin, length);
        column += length;
        lineIsEmpty = lineIsEmpty && length == 0;
        if (end < text.size() && text[end] == '\n') {
            result += '\n';
            column = 0;
            lineIsEmpty = true;
        }
        begin = end + 1;
    }
    return result;
}

std::vector<std::string> wordsOf(std::string_view list) {
    std::vector<std::string> words(1);
    for (const char c : list)
        if (c == ',')
            words.emplace_back();
        else
            words.back() += c;
    return words;
}

std::string listOf(std::span<const std::string_view> words) {
    std::string result;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0) result += i + 1 == words.size() ? " or " : ", ";
        result += quoted(words[i]);
    }
    return result;
}

} // namespace carom
