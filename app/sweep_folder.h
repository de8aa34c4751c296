// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/sweep_files.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// The folder of a sweep (core/study/sweep_files.h), written row by row.

namespace carom {

class SweepFolder {
  public:
    /// Makes the folder and records what it is of. Throws UsageError where it belongs to another sweep.
    SweepFolder(std::string path, const Sweep& sweep);
    /// The sweep of a folder that is there. Throws UsageError where it is none.
    static std::shared_ptr<const Sweep> read(const std::string& path);

    const std::string& path() const { return m_path; }
    std::string pathOf(std::string_view name) const;

    using TakeRow = std::function<void(std::size_t run, std::string_view line)>;
    /// Hands the rows of a file to `take` in the order of the file, as far as they are whole. Nothing happens
    /// where there is no such file.
    void forRows(const std::string& name, const TakeRow& take) const;
    /// The same of a file that is open, from its beginning.
    void forRows(int descriptor, const TakeRow& take) const;
    /// The shards' tables that are there, by their first runs.
    std::vector<std::string> shardTables() const;

  private:
    std::string m_path;
    const Sweep& m_sweep;
};

/// A table being written in the order in which runs end. It is a file of this program's own: a program that
/// continues it copies it first, so that another one that still writes, on a machine that was taken for
/// stopped, does not interfere.
class SweepJournal {
  public:
    /// `name` is the table it will become, "sweep.csv". `resume`: goes on with the rows that are there.
    SweepJournal(const SweepFolder& folder, const Sweep& sweep, std::string name, const ItemRange& part,
                 bool resume);
    ~SweepJournal();
    SweepJournal(const SweepJournal&) = delete;
    SweepJournal& operator=(const SweepJournal&) = delete;

    bool has(std::size_t run) const { return m_known[run - m_part.first]; }
    std::size_t count() const { return m_count; } ///< rows so far
    bool isComplete() const { return m_count == m_part.count(); }
    /// Hands the row to the system at once: it remains however this program ends.
    void add(const SweepResult& result);
    /// All rows are there: they become the table, in the order of the runs, and the journal is gone.
    void close();

  private:
    void open();
    void append(std::string_view text);
    std::string partPath() const { return m_folder.pathOf(m_name + sweepfile::partEnding); }

    const SweepFolder& m_folder;
    const Sweep& m_sweep;
    std::string m_name;
    ItemRange m_part;
    std::vector<bool> m_known; ///< by run of the part
    std::size_t m_count = 0;
    std::string m_beside; ///< what it is called until it holds what is kept
    int m_descriptor = -1;
};

/// What the whole table says.
struct SweepReport {
    std::vector<SweepPoint> points; ///< none where they are more than a chart can show
    SweepTotals totals;
    std::string text; ///< what is printed
};

/// Makes summary.csv and summary.txt of sweep.csv.
SweepReport writeSweepSummary(const SweepFolder& folder, const Sweep& sweep);

/// Makes sweep.csv of the shards' tables, and names the runs that are missing: "200 to 399, 512".
std::string mergeShards(const SweepFolder& folder, const Sweep& sweep);

} // namespace carom
