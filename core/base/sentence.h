// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

// What is said in words by core and shown by front ends in other languages as well: the words apart from the
// names and figures in them.

namespace carom {

/// The English words, which last as long as the program, with %1, %2, ... where the values go.
struct Sentence {
    std::string_view pattern = {};
    std::vector<std::string> values = {};

    bool empty() const { return pattern.empty(); }
    std::string text() const;
    bool operator==(const Sentence&) const = default;
};

/// A text that is the same in every language: a name, or what another program says. An empty one is no
/// sentence.
inline Sentence verbatim(std::string text) {
    return text.empty() ? Sentence() : Sentence{"%1", {std::move(text)}};
}

/// Sentences in sequence.
class Reason {
  public:
    struct Part {
        std::string_view joint; ///< before it, but for the first
        Sentence sentence;
    };

    Reason() = default;
    Reason(Sentence first) { add(std::move(first)); }

    void add(Sentence sentence, std::string_view joint = "; ");
    void add(const Reason& other, std::string_view joint = "; ");
    const std::vector<Part>& parts() const { return m_parts; }
    bool empty() const { return m_parts.empty(); }
    std::string text() const;

  private:
    std::vector<Part> m_parts;
};

} // namespace carom
