// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/sweep_folder.h"

#include "app/errors.h"
#include "app/files.h"
#include "app/version.h"
#include "core/base/file_writer.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <utility>

namespace carom {
namespace {

namespace fs = std::filesystem;

/// Points of a chart at most: more cannot be distinguished, and twice as many take twice the time.
constexpr std::size_t mostChartPoints = 100'000;
/// Missing runs that a message lists at most.
constexpr std::size_t mostGapsNamed = 20;

FileError notWritten(const std::string& path, int cause) {
    return FileError("cannot write `" + path + "`: " + whyNotWritten(path, cause), cause);
}

/// A table written line by line that replaces the old one when all is there.
class TableWriter {
  public:
    explicit TableWriter(std::string path) : m_path(std::move(path)), m_file(m_path) {}

    void write(std::string_view text) {
        constexpr std::size_t most = 1U << 16U; // [bytes] that wait
        m_waiting += text;
        if (m_waiting.size() >= most) send();
    }
    void commit() {
        send();
        if (!m_file.commit()) throw notWritten(m_path, m_file.error());
    }

  private:
    void send() {
        if (!m_file.write(m_waiting)) throw notWritten(m_path, m_file.error());
        m_waiting.clear();
    }

    std::string m_path, m_waiting;
    FileWriter m_file;
};

/// Runs that are missing, as people list them.
class Gaps {
  public:
    void add(std::size_t first, std::size_t end) {
        if (first >= end) return;
        m_missing += end - first;
        if (++m_count > mostGapsNamed) return;
        m_text += (m_text.empty() ? "" : ", ") + std::to_string(first);
        if (end > first + 1) m_text += " to " + std::to_string(end - 1);
    }
    std::string text() const {
        if (m_count <= mostGapsNamed) return m_text;
        return m_text + " and others, " + std::to_string(m_missing) + " in all";
    }

  private:
    std::size_t m_count = 0, m_missing = 0;
    std::string m_text;
};

} // namespace

SweepFolder::SweepFolder(std::string path, const Sweep& sweep) : m_path(std::move(path)), m_sweep(sweep) {
    const std::string record = sweepRecord(sweep, version());
    const std::string place = pathOf(sweepfile::record);
    if (fs::exists(place)) {
        if (readText(place) != record)
            throw UsageError("`" + m_path + "` has the runs of another sweep (see `" + place +
                             "`); another folder would be right");
        return;
    }
    makeFolder(m_path);
    if (sweep.definition().generate.empty()) writeFile(m_path, sweepfile::scene, sweep.baseText());
    writeFile(m_path, sweepfile::record, record);
}

std::shared_ptr<const Sweep> SweepFolder::read(const std::string& path) {
    const std::string place = (fs::path(path) / sweepfile::record).string();
    const std::optional<SweepDefinition> definition =
        fs::exists(place) ? definitionInRecord(readText(place)) : std::nullopt;
    if (!definition) throw UsageError("`" + path + "` is no folder of a sweep: it has no `sweep.txt` of one");
    std::string text;
    if (definition->generate.empty()) text = readText((fs::path(path) / sweepfile::scene).string());
    ReadSweep read = readSweep(*definition, std::move(text));
    if (!read.sweep) throw UsageError("`" + place + "`: " + read.objection);
    return read.sweep;
}

std::string SweepFolder::pathOf(std::string_view name) const { return (fs::path(m_path) / name).string(); }

void SweepFolder::forRows(const std::string& name, const TakeRow& take) const {
    const int descriptor = ::open(pathOf(name).c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return;
    try {
        forRows(descriptor, take);
    } catch (...) {
        ::close(descriptor);
        throw;
    }
    ::close(descriptor);
}

void SweepFolder::forRows(int descriptor, const TakeRow& take) const {
    std::vector<char> block(1U << 16U);
    std::string line;
    bool isFirst = true; // the columns
    for (off_t place = 0;;) {
        const ssize_t count = ::pread(descriptor, block.data(), block.size(), place);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) throw UnreadableFile("a table in `" + m_path + "`", errno);
        if (count == 0) return;
        place += count;
        std::string_view rest(block.data(), static_cast<std::size_t>(count));
        for (std::size_t end = rest.find('\n'); end != rest.npos; end = rest.find('\n')) {
            line += rest.substr(0, end + 1);
            rest.remove_prefix(end + 1);
            const std::optional<std::size_t> run = runOfRow(line, m_sweep.runs());
            if (!run && !isFirst) return; // left by a machine that stopped
            if (run) take(*run, line);
            isFirst = false;
            line.clear();
        }
        line += rest;
    }
}

std::vector<std::string> SweepFolder::shardTables() const {
    std::vector<std::pair<std::size_t, std::string>> tables;
    for (const fs::directory_entry& entry : fs::directory_iterator(m_path)) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with("shard-") || !name.ends_with(".csv")) continue;
        std::ifstream file(entry.path(), std::ios::binary);
        std::string line;
        std::getline(file, line);
        if (line + "\n" != sweepColumns(m_sweep))
            throw FileError("`" + entry.path().string() +
                            "` is no table of this sweep: it has other columns");
        if (!std::getline(file, line)) continue; // a shard without runs
        if (const std::optional<std::size_t> run = runOfRow(line, m_sweep.runs()))
            tables.emplace_back(*run, name);
    }
    std::ranges::sort(tables);
    std::vector<std::string> names;
    for (auto& [run, name] : tables) names.push_back(std::move(name));
    return names;
}

SweepJournal::SweepJournal(const SweepFolder& folder, const Sweep& sweep, std::string name,
                           const ItemRange& part, bool resume)
    : m_folder(folder), m_sweep(sweep), m_name(std::move(name)), m_part(part), m_known(part.count()) {
    const auto isNew = [&](std::size_t run) {
        if (!m_part.contains(run) || has(run)) return false;
        m_known[run - m_part.first] = true;
        ++m_count;
        return true;
    };
    if (resume) folder.forRows(m_name, [&](std::size_t run, std::string_view) { isNew(run); });
    if (isComplete() && resume) return;
    m_count = 0; // a table of another stretch, which this one will replace
    m_known.assign(part.count(), false);
    std::string text = sweepColumns(sweep);
    if (resume)
        folder.forRows(m_name + sweepfile::partEnding, [&](std::size_t run, std::string_view line) {
            if (isNew(run)) text += line;
        });
    open();
    append(text);
    if (::rename(m_beside.c_str(), partPath().c_str()) != 0) throw notWritten(partPath(), errno);
}

SweepJournal::~SweepJournal() {
    if (m_descriptor >= 0) ::close(m_descriptor);
}

void SweepJournal::open() {
    constexpr int mostTries = 1000; // a program on another machine may have the same number
    for (int i = 0; i < mostTries && m_descriptor < 0; ++i) {
        m_beside = partPath() + "." + std::to_string(::getpid()) + "." + std::to_string(i);
        m_descriptor = ::open(m_beside.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (m_descriptor < 0 && errno != EEXIST) throw notWritten(partPath(), errno);
    }
    if (m_descriptor < 0) throw notWritten(partPath(), EEXIST);
}

void SweepJournal::append(std::string_view text) {
    while (!text.empty()) {
        const ssize_t count = ::write(m_descriptor, text.data(), text.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) throw notWritten(partPath(), errno);
        text.remove_prefix(static_cast<std::size_t>(count));
    }
}

void SweepJournal::add(const SweepResult& result) {
    append(sweepRow(m_sweep, result));
    m_known[result.run - m_part.first] = true;
    ++m_count;
}

void SweepJournal::close() {
    if (m_descriptor < 0) return; // the table was there
    TableWriter table(m_folder.pathOf(m_name));
    table.write(sweepColumns(m_sweep));
    RowSorter sorter(m_part.first, [&](std::size_t, std::string_view line) { table.write(line); });
    m_folder.forRows(m_descriptor, [&](std::size_t run, std::string_view line) { sorter.add(run, line); });
    sorter.finish();
    table.commit();
    struct stat own {
    }, there{};
    const bool isOwn = ::fstat(m_descriptor, &own) == 0 && ::stat(partPath().c_str(), &there) == 0 &&
                       own.st_ino == there.st_ino && own.st_dev == there.st_dev;
    ::close(std::exchange(m_descriptor, -1));
    if (isOwn) ::unlink(partPath().c_str());
}

SweepReport writeSweepSummary(const SweepFolder& folder, const Sweep& sweep) {
    SweepReport report;
    TableWriter table(folder.pathOf(sweepfile::summary));
    table.write(summaryColumns(sweep));
    SweepSummary summary(sweep, [&](const SweepPoint& point) {
        table.write(summaryRows(sweep, point));
        if (report.points.size() <= mostChartPoints) report.points.push_back(point);
    });
    folder.forRows(sweepfile::table, [&](std::size_t, std::string_view line) {
        if (const std::optional<SweepResult> result = resultOfRow(sweep, line)) summary.add(*result);
    });
    summary.finish();
    table.commit();
    report.totals = summary.totals();
    report.text = summaryOf(report.totals, sweep.runs());
    if (report.points.size() > mostChartPoints) { // a part of them would look like the whole
        report.points.clear();
        report.text += "\nThere is no chart of more than " + std::to_string(mostChartPoints) + " points.\n";
    }
    replaceFile(folder.pathOf(sweepfile::report), report.text);
    return report;
}

std::string mergeShards(const SweepFolder& folder, const Sweep& sweep) {
    const std::vector<std::string> tables = folder.shardTables();
    if (tables.empty()) throw FileError("`" + folder.pathOf("") + "` has no tables of shards to merge");
    Gaps gaps;
    TableWriter table(folder.pathOf(sweepfile::table));
    table.write(sweepColumns(sweep));
    std::size_t next = 0;
    for (const std::string& name : tables)
        folder.forRows(name, [&](std::size_t run, std::string_view line) {
            if (run < next) return; // of shards that overlap
            gaps.add(next, run);
            table.write(line);
            next = run + 1;
        });
    gaps.add(next, sweep.runs());
    table.commit();
    return gaps.text();
}

} // namespace carom
