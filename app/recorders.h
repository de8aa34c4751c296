// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/files.h"
#include "core/simulation/pipeline.h"
#include "core/simulation/statistics.h"

#include <cstdint>
#include <string>

// The CSV files of `carom run`. Scripts depend on their columns: one may be added at the end, none changes.

namespace carom {

class World;

/// `--trace`: one row a mobile body, every so many frames.
class TraceWriter {
  public:
    TraceWriter(const std::string& path, std::int64_t every);
    void record(const World& world);
    void record(const Pipeline& pipeline, const State& state);
    void close() { m_file.close(); }

  private:
    OutputFile m_file;
    std::int64_t m_every;
};

/// `--stats`: one row a frame.
class StatisticsWriter {
  public:
    explicit StatisticsWriter(const std::string& path);
    void record(const FrameStatistics& frame);
    void close() { m_file.close(); }

  private:
    OutputFile m_file;
};

} // namespace carom
