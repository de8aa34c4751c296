// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/sweep_table.h"

#include "core/base/csv.h"
#include "core/base/text.h"

#include <array>
#include <charconv>
#include <limits>

namespace carom {
namespace {

constexpr std::size_t columnsBehind = 5; ///< outcome, frames, state_hash, work, seconds

std::string hexadecimal(std::uint64_t value) {
    std::array<char, 16> digits{};
    const std::to_chars_result end = std::to_chars(digits.data(), digits.data() + digits.size(), value, 16);
    const std::string_view text(digits.data(), static_cast<std::size_t>(end.ptr - digits.data()));
    return std::string(digits.size() - text.size(), '0').append(text);
}

} // namespace

std::string sweepColumns(const Sweep& sweep) {
    std::string line = "run";
    for (const SweptParameter& parameter : sweep.parameters()) line += "," + csvField(parameter.name);
    for (const SweepMeasure& measure : sweep.measures()) line += "," + csvField(measure.text);
    return line + ",outcome,frames,state_hash,work,seconds\n";
}

std::string sweepRow(const Sweep& sweep, const SweepResult& result) {
    CsvTable line;
    line.add(result.run);
    for (const std::string& value : sweep.valuesOf(result.run)) line.add(std::string_view(value));
    for (const double figure : result.figures) line.add(figure);
    const bool isDone = result.outcome == SweepOutcome::Done;
    line.add(nameOf(result.outcome));
    line.add(result.frames);
    line.add(std::string_view(isDone ? hexadecimal(result.stateHash) : ""));
    line.add(result.work);
    constexpr double microseconds = 1e6;
    line.add(std::round(result.seconds * microseconds) / microseconds);
    line.endRow();
    return line.take();
}

std::optional<std::size_t> runOfRow(std::string_view line, std::size_t runs) {
    const std::optional<unsigned long long> run = unsignedNumberIn(line.substr(0, line.find(',')));
    if (!run || *run >= runs) return std::nullopt;
    return static_cast<std::size_t>(*run);
}

std::optional<SweepResult> resultOfRow(const Sweep& sweep, std::string_view line) {
    if (line.ends_with('\n')) line.remove_suffix(1);
    const std::optional<std::size_t> run = runOfRow(line, sweep.runs());
    const std::vector<std::string_view> fields = csvSplit(line, ',');
    const std::size_t first = 1 + sweep.parameters().size(), end = first + sweep.measures().size();
    if (!run || fields.size() != end + columnsBehind) return std::nullopt;
    const std::optional<SweepOutcome> outcome = outcomeNamed(fields[end]);
    const std::optional<long long> frames = wholeNumberIn(fields[end + 1]);
    const std::optional<double> work = numberIn(fields[end + 3]), seconds = numberIn(fields[end + 4]);
    if (!outcome || !frames || !work || !seconds) return std::nullopt;
    SweepResult result;
    result.run = *run;
    result.outcome = *outcome;
    result.frames = *frames;
    result.work = *work;
    result.seconds = *seconds;
    const std::string_view hash = fields[end + 2];
    std::from_chars(hash.data(), hash.data() + hash.size(), result.stateHash, 16);
    for (std::size_t k = first; k < end; ++k)
        result.figures.push_back(numberIn(fields[k]).value_or(std::numeric_limits<double>::quiet_NaN()));
    return result;
}

void RowSorter::add(std::size_t run, std::string_view line) {
    if (run < m_next) return;
    if (run > m_next) {
        m_waiting.try_emplace(run, line);
        return;
    }
    m_sink(m_next++, line);
    while (!m_waiting.empty() && m_waiting.begin()->first <= m_next) {
        const auto first = m_waiting.begin();
        if (first->first == m_next) m_sink(m_next++, first->second);
        m_waiting.erase(first);
    }
}

void RowSorter::finish() {
    for (const auto& [run, line] : m_waiting) m_sink(run, line);
    m_waiting.clear();
}

std::string sweepRecord(const Sweep& sweep, std::string_view version) {
    return "carom " + std::string(version) + "\nsweep " + sweep.hash() + "\n" + textOf(sweep.definition());
}

std::optional<SweepDefinition> definitionInRecord(std::string_view record) {
    SweepDefinition definition;
    bool isRecord = false;
    while (!record.empty()) {
        const std::size_t end = std::min(record.find('\n'), record.size());
        const std::string_view line = record.substr(0, end);
        record.remove_prefix(std::min(end + 1, record.size()));
        const std::size_t blank = std::min(line.find(' '), line.size());
        const std::string_view name = line.substr(0, blank);
        const std::string value(line.substr(std::min(blank + 1, line.size())));
        const long long number = wholeNumberIn(value).value_or(0);
        if (name == "sweep") isRecord = true;
        if (name == "generate") definition.generate = value;
        if (name == "vary") definition.vary.push_back(value);
        if (name == "measure") definition.measures.push_back(value);
        if (name == "zip") definition.zip = true;
        if (name == "random") definition.random = number;
        if (name == "random_seed") definition.randomSeed = unsignedNumberIn(value).value_or(1);
        if (name == "seeds") definition.seeds = number;
        if (name == "frames") definition.frames = number;
    }
    if (!isRecord) return std::nullopt;
    return definition;
}

} // namespace carom
