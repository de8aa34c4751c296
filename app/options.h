// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/shard.h"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Options by the GNU conventions: --name=value, --name value, -n value, -nvalue, options and operands in any
// order, everything behind -- an operand, a lone - an operand. One table a subcommand both reads the command
// line and prints its help.

namespace carom {

struct OptionRow {
    std::string name;     ///< without the dashes: "frames"
    char letter = 0;      ///< 'n' for -n; 0 for none
    std::string argument; ///< "FRAMES"; empty for a switch
    std::string help;     ///< one or two sentences
};

/// A command line that has been read; values are still text.
class Arguments {
  public:
    std::vector<std::string> operands;
    std::map<std::string, std::string, std::less<>> values;   ///< by option; the last of equal options
    std::vector<std::pair<std::string, std::string>> inOrder; ///< every option as it was given

    bool has(std::string_view option) const { return values.contains(option); }
    std::optional<std::string> text(std::string_view option) const;
    /// Of an option that may be given again and again: all its values.
    std::vector<std::string> texts(std::string_view option) const;
    /// Both throw UsageError with what was seen and what would be right.
    std::optional<std::int64_t> wholeNumber(std::string_view option, std::int64_t least,
                                            std::int64_t most) const;
    std::optional<double> positiveNumber(std::string_view option) const;
    /// One of `words`, or UsageError with the nearest.
    std::optional<std::string> word(std::string_view option, std::span<const std::string_view> words) const;
};

/// `--shard I/N` of the studies that can be made in parts; without it the whole.
OptionRow shardOption();
Shard shardFrom(const Arguments& arguments);

/// Throws UsageError ("unknown option `--fames`; did you mean `--frames`?").
Arguments readArguments(std::span<const std::string> words, std::span<const OptionRow> rows);

/// The table as aligned lines, for help pages.
std::string describe(std::span<const OptionRow> rows);

/// The words of `text` in lines of at most 100 columns, each but the first behind `indent` blanks; an empty
/// line stays. `column` is where the first line begins.
std::string wrapped(std::string_view text, std::size_t indent, std::size_t column);

/// The words of a list with commas: "a,b" is two, "" is one that is empty.
std::vector<std::string> wordsOf(std::string_view list);

/// "`a`, `b` or `c`".
std::string listOf(std::span<const std::string_view> words);

} // namespace carom
