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

// A scene, run again and again with other numbers in its text: what is varied, what is measured, and the list
// of runs that follows from it. The list is never held: run number k is computed from k.
//
//     axes, outermost first      values                                   run
//     cue.vel.z                  4:12:3      4       8       12
//     bodies.friction            0,.1      0  .1   0  .1   0  .1
//     seeds                      2        01 23   45 67   89 ..           row k of the table

namespace carom {

/// What is asked for, as it is written.
struct SweepDefinition {
    /// Each "PATH=VALUES" (core/language/parameter_change.h); values are `4:12:17` (first, last, how many),
    /// `log 1e-3:1:7`, a list `1,4,16` of numbers or words, or, with `random`, `uniform 4:12` or
    /// `normal 8:0.5` (mean and deviation).
    std::vector<std::string> vary;
    std::vector<std::string> measures;
    bool zip = false;             ///< lists go together, value by value, instead of each with each
    std::int64_t random = 0;      ///< draws from the laws; 0: there are none
    std::uint64_t randomSeed = 1; ///< of the draws
    std::int64_t seeds = 0; ///< runs a point, each with the next seed of its generated scene; 0: one run
    std::optional<std::int64_t> frames; ///< of each run; absent: what its text says
    std::string generate;               ///< "pile --n 400": the scene is made by a generator; else empty

    friend bool operator==(const SweepDefinition&, const SweepDefinition&) = default;
};

/// Parameters that change together.
struct SweepAxis {
    std::vector<std::size_t> parameters; ///< by number
    std::size_t count = 1;               ///< of values
    bool isReplication = false;          ///< draws and seeds: what a summary is taken over
};

/// What a `sweep` declaration asks for.
SweepDefinition definitionOf(const SweepRequest& request);

class Sweep;

struct ReadSweep {
    std::shared_ptr<const Sweep> sweep;
    std::string objection; ///< where there is none: what was seen, and what would be right
};
/// `text` is the scene's; ignored where a generator makes it. Runs that a value makes faulty are found when
/// they are run, but each listed value must be one that its parameter can have, and the first run must build.
ReadSweep readSweep(SweepDefinition definition, std::string text);

class Sweep {
  public:
    /// Runs at most: a typing mistake is reported. Ten times as many would take a table of ten gigabytes; at
    /// half, more than 50 million runs need two sweeps.
    static constexpr std::size_t mostRuns = 100'000'000;

    const SweepDefinition& definition() const { return m_definition; }
    const std::vector<SweptParameter>& parameters() const {
        return m_parameters;
    }                                                             ///< seeds, if any, the last
    const std::vector<SweepAxis>& axes() const { return m_axes; } ///< outermost first; draws, then seeds last
    const std::vector<SweepMeasure>& measures() const { return m_measures; }
    /// The text of the first scene, before any change.
    const std::string& baseText() const { return m_base->analysis.text; }

    std::size_t runs() const { return m_runs; }
    /// How many runs, one behind the other, are of one point: those a summary is taken over.
    std::size_t runsOfPoint() const;
    /// The parameters' values in a run, in their order.
    std::vector<std::string> valuesOf(std::size_t run) const;
    /// The text of a run; nothing where a draw is an option that the generator does not take.
    std::optional<std::string> textOf(std::size_t run) const;
    /// The runs' work, relative to each other: bodies that move × substeps × frames, as far as the varied
    /// settings and generators say it before any run.
    std::vector<double> weights() const;

    /// A 64-bit hash of definition and base text, in hexadecimal: two sweeps with the same one have the same
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
    const GeneratorRow* m_generator = nullptr; ///< null: the scene is a text
    GeneratorRequest m_request;
};

/// The definition as lines `vary cue.vel.z=4:12:3`; what a folder of results keeps to know its own.
std::string textOf(const SweepDefinition& definition);

} // namespace carom
