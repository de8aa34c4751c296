// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/measure_words.h"

#include "core/base/catalogue.h"
#include "core/base/text.h"
#include "core/scene/schema.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace carom {
namespace {

constexpr std::string_view impact = "impact";

struct KindRow {
    std::string_view name;
    MeasureKind kind;
};
constexpr std::array kinds = {KindRow{"final", MeasureKind::Final}, KindRow{"max", MeasureKind::Max},
                              KindRow{"min", MeasureKind::Min}, KindRow{"mean", MeasureKind::Mean},
                              KindRow{"first", MeasureKind::First}};

std::string joined(std::span<const std::string> words, std::string_view separator) {
    std::string text;
    for (const std::string& word : words) text.append(text.empty() ? "" : separator).append(word);
    return text;
}

/// Reads a measure word by word, from both ends.
class MeasureReader {
  public:
    explicit MeasureReader(std::string_view text) : m_words(wordsIn(text)) {}

    ReadMeasure read() {
        m_measure.text = joined(m_words, " ");
        readKind();
        if (m_objection.empty()) readEnd();
        if (m_objection.empty()) readOwners();
        if (m_objection.empty()) readQuantity();
        if (!m_objection.empty()) return {std::nullopt, "`" + m_measure.text + "`: " + m_objection};
        return {std::move(m_measure), {}};
    }

  private:
    void readKind() {
        m_measure.kind = MeasureKind::At; // unless a word says another
        if (m_words.empty()) return;
        const KindRow* row = findByName(std::span<const KindRow>(kinds), m_words.front());
        if (row == nullptr) return;
        m_measure.kind = row->kind;
        m_words.erase(m_words.begin());
    }

    /// "... at 1.5", "... above 3".
    void readEnd() {
        const bool isFirst = m_measure.kind == MeasureKind::First;
        if (m_words.size() >= 2) {
            const std::string word = m_words[m_words.size() - 2];
            const std::optional<double> number = numberIn(m_words.back());
            const bool bounds = word == "above" || word == "below";
            if (number && ((isFirst && bounds) || (m_measure.kind == MeasureKind::At && word == "at"))) {
                m_hasEnd = true;
                m_measure.isAbove = word == "above";
                (isFirst ? m_measure.limit : m_measure.at) = *number;
                m_words.resize(m_words.size() - 2);
            }
        }
        if (m_measure.kind == MeasureKind::At && !m_hasEnd)
            m_objection = "a measure begins with `final`, `max`, `min`, `mean` or `first`, or ends in a time "
                          "such as `at 1.5`";
        else if (m_measure.at < 0)
            m_objection = "the time is " + shortest(m_measure.at) + "; it must be 0 or later";
    }

    void readOwners() {
        const auto of = std::ranges::find(m_words, "of");
        if (of == m_words.end()) return;
        const auto separator = std::find(of, m_words.end(), "and");
        m_measure.of = joined({of + 1, separator}, " ");
        if (separator != m_words.end()) m_measure.to = joined({separator + 1, m_words.end()}, " ");
        if (m_measure.of.empty() || (separator != m_words.end() && m_measure.to.empty()))
            m_objection = "behind `of` and `and` there must be a body";
        m_words.erase(of, m_words.end());
    }

    void readQuantity() {
        m_measure.quantity = joined(m_words, "_");
        const bool isFirst = m_measure.kind == MeasureKind::First;
        if (isFirst && m_measure.quantity == impact) {
            if (m_hasEnd) m_objection = "an impact has no bound";
            if (m_measure.of.empty()) m_objection = "it must say which body, `first impact of a and b`";
            return;
        }
        std::vector<std::string_view> known(quantityWords().begin(), quantityWords().end());
        if (isFirst) known.push_back(impact);
        if (std::ranges::count(known, m_measure.quantity) == 0) {
            const std::optional<std::string_view> near = nearestName(m_measure.quantity, known);
            m_objection = "there is no quantity `" + m_measure.quantity + "`; " +
                          (near ? "did you mean `" + std::string(*near) + "`?"
                                : std::string("the language reference lists those of `expect`"));
            return;
        }
        const bool ofTwo = isOfTwoBodies(m_measure.quantity);
        if (isFirst && !m_hasEnd)
            m_objection = "it must say when, `first " + m_measure.quantity + " above 1`";
        else if (ofTwo && m_measure.to.empty())
            m_objection = "it is of two bodies, `of a and b`";
        else if (!ofTwo && !m_measure.to.empty())
            m_objection = "`" + m_measure.quantity + "` is of one body, not of two";
        else if (isOfWholeOnly(m_measure.quantity) && !m_measure.of.empty())
            m_objection = "`" + m_measure.quantity + "` is of the whole scene, not of a body";
    }

    std::vector<std::string> m_words;
    SweepMeasure m_measure;
    bool m_hasEnd = false;
    std::string m_objection;
};

} // namespace

std::vector<std::string> wordsIn(std::string_view text) {
    std::vector<std::string> words;
    for (std::size_t begin = text.find_first_not_of(" \t\r\n"); begin != text.npos;) {
        const std::size_t end = std::min(text.find_first_of(" \t\r\n", begin), text.size());
        words.emplace_back(text.substr(begin, end - begin));
        begin = text.find_first_not_of(" \t\r\n", end);
    }
    return words;
}

ReadMeasure readMeasure(std::string_view text) { return MeasureReader(text).read(); }

} // namespace carom
