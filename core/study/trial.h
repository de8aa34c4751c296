// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/stability.h"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

// The run of one hard case in one column: it makes worlds from text with the settings of the column, steps
// them until it is cancelled, and collects figures.

namespace carom {

class World;

/// A limit for the default column and one for the two others.
struct Limits {
    double byDefault = 0, accurate = 0;
};

/// The `simulation` declaration of a column with further parameters; none if nothing is set.
std::string simulationOf(StudyColumn column, std::string_view further);

class Trial {
  public:
    Trial(const HardCase& hardCase, StudyColumn column, StudyLength length, std::function<bool()> goOn);

    const HardCase& hardCase() const { return m_case; }
    StudyColumn column() const { return m_column; }
    bool byDefault() const { return m_column == StudyColumn::Default; }
    bool exact() const { return m_column == StudyColumn::Exact; }
    bool isLong() const { return m_length == StudyLength::Long; }
    /// The value for the short or the long form of the study.
    template<class T>
    T shortOrLong(T brief, T full) const {
        return isLong() ? full : brief;
    }

    /// A world of these declarations. `simulation` replaces the case's further parameters.
    World world(const std::string& declarations) const;
    World world(const std::string& declarations, std::string_view simulation) const;

    /// One frame; false if told to stop, or if the world has lost its state (which is a failing figure).
    bool step(World& world);
    /// Runs frames, and calls `each` after every one.
    void run(World& world, std::int64_t frames, const std::function<void()>& each = {});
    bool stopped() const { return m_stopped; }
    /// Whether to continue; for cases that do not step worlds.
    bool goesOn();

    /// The figure must be at most the limit of the column.
    void expect(std::string name, double value, Limits limits, std::string_view unit = {});
    /// A count of events that must not happen.
    void expectNone(std::string name, double count) { expect(std::move(name), count, {0, 0}); }

    void add(Figure figure) { m_figures.push_back(std::move(figure)); }

    std::vector<Figure> takeFigures() { return std::move(m_figures); }

  private:
    const HardCase& m_case;
    StudyColumn m_column;
    StudyLength m_length;
    std::function<bool()> m_goOn;
    bool m_stopped = false;
    std::vector<Figure> m_figures;
};

} // namespace carom
