// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/generators/generator.h"
#include "core/language/parameter_change.h"
#include "core/language/swept_values.h"
#include "core/simulation/build.h"
#include "core/study/sweep_measure.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// A sweep runs a scene many times with other numbers in its text. This is its definition: what is varied,
// what is measured, and the list of runs that follows. The list is not stored: run number k is computed from
// k.
//
//     axes, outermost first      values                                   run
//     cue.vel.z                  4:12:3      4       8       12
//     bodies.friction            0,.1      0  .1   0  .1   0  .1
//     seeds                      2        01 23   45 67   89 ..           row k of the table

namespace carom {

/// The definition as the user writes it.
struct SweepDefinition {
    /// Each "PATH=VALUES" (core/language/parameter_change.h); values are `4:12:17` (first, last, how many),
    /// `log 1e-3:1:7`, a list `1,4,16` of numbers or words, or, with `random`, `uniform 4:12` or
    /// `normal 8:0.5` (mean and deviation).
    std::vector<std::string> vary;
    std::vector<std::string> measures;
    bool zip = false;             ///< lists are combined value by value; otherwise each value with each
    std::int64_t random = 0;      ///< number of draws from the distributions; 0: there are none
    std::uint64_t randomSeed = 1; ///< of the draws
    /// Runs of each point, each with the next seed of its generated scene; 0: one run.
    std::int64_t seeds = 0;
    std::optional<std::int64_t> frames; ///< frames of each run; absent: as its text says
    std::string generate;               ///< "pile --n 400": the scene is made by a generator; else empty

    friend bool operator==(const SweepDefinition&, const SweepDefinition&) = default;
};

/// Parameters that change together.
struct SweepAxis {
    std::vector<std::size_t> parameters; ///< by number
    std::size_t count = 1;               ///< of values
    bool isReplication = false;          ///< draws and seeds: a summary is taken over them
};

/// The definition that a `sweep` declaration gives.
SweepDefinition definitionOf(const SweepRequest& request);

class Sweep;

struct ReadSweep {
    std::shared_ptr<const Sweep> sweep;
    std::string objection; ///< if there is no sweep: what was found, and what would be right
};
/// `text` is the scene's; it is ignored if a generator makes the scene. Errors that a value causes in the
/// scene are found when its run is made, but each listed value must be valid for its parameter, and the scene
/// of the first run must build.
ReadSweep readSweep(SweepDefinition definition, std::string text);

class Sweep {
  public:
    /// Runs at most: a typing mistake is reported. Ten times as many would take a table of ten gigabytes; at
    /// half, more than 50 million runs need two sweeps.
    static constexpr std::size_t mostRuns = 100'000'000;

    const SweepDefinition& definition() const { return m_definition; }
    /// Seeds, if any, come last.
    const std::vector<SweptParameter>& parameters() const { return m_parameters; }
    /// Outermost first; draws, then seeds come last.
    const std::vector<SweepAxis>& axes() const { return m_axes; }
    const std::vector<SweepMeasure>& measures() const { return m_measures; }
    /// The text of the first scene, before any change.
    const std::string& baseText() const { return m_base->analysis.text; }

    std::size_t runs() const { return m_runs; }
    /// How many successive runs belong to one point: a summary is taken over these.
    std::size_t runsOfPoint() const;
    /// The parameters' values in a run, in their order.
    std::vector<std::string> valuesOf(std::size_t run) const;
    /// The text of a run; nothing if a drawn value is no valid option of the generator.
    std::optional<std::string> textOf(std::size_t run) const;
    /// The work of each run, relative to that of others: mobile bodies × substeps × frames, as far as they
    /// are known from the varied settings and generators before any run.
    std::vector<double> weights() const;

    /// A 64-bit hash of definition and base text, in hexadecimal: two sweeps with the same hash have the same
    /// rows.
    std::string hash() const;

  private:
    friend class SweepReader;
    Sweep() = default;

    std::string valueOf(std::size_t parameter, std::size_t index) const;
    std::optional<std::string> textWith(const std::vector<std::string>& values) const;
    double weightOf(const std::vector<std::string>& values) const;

    SweepDefinition m_definition;
    std::vector<SweptParameter> m_parameters;
    std::vector<SweepAxis> m_axes;
    std::vector<SweepMeasure> m_measures;
    std::size_t m_runs = 1;
    std::shared_ptr<const Build> m_base;
    const GeneratorRow* m_generator = nullptr; ///< null: the scene is given as text
    GeneratorRequest m_request;
};

/// The definition as lines `vary cue.vel.z=4:12:3`; a folder of results stores it, to recognise the sweep it
/// belongs to.
std::string textOf(const SweepDefinition& definition);

} // namespace carom
