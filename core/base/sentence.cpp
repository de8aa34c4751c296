// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/sentence.h"

#include "core/base/assert.h"

#include <cstddef>

namespace carom {

std::string Sentence::text() const {
    std::string words;
    for (std::size_t i = 0; i < pattern.size(); ++i) {
        const bool isPlace =
            pattern[i] == '%' && i + 1 < pattern.size() && pattern[i + 1] >= '1' && pattern[i + 1] <= '9';
        if (!isPlace) {
            words += pattern[i];
            continue;
        }
        const std::size_t value = static_cast<std::size_t>(pattern[++i] - '1');
        ASSERT(value < values.size());
        words += values[value];
    }
    return words;
}

void Reason::add(Sentence sentence, std::string_view joint) {
    m_parts.push_back({joint, std::move(sentence)});
}

void Reason::add(const Reason& other, std::string_view joint) {
    for (const Part& part : other.m_parts)
        m_parts.push_back({&part == &other.m_parts.front() ? joint : part.joint, part.sentence});
}

std::string Reason::text() const {
    std::string words;
    for (const Part& part : m_parts) {
        if (&part != &m_parts.front()) words += part.joint;
        words += part.sentence.text();
    }
    return words;
}

} // namespace carom
