// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/shard.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// The hard cases: scenes that are hard to simulate and have a right answer in closed form, or a quantity that
// must be kept. Each is run in up to three columns, measured, and compared with the limits of its column. The
// simulation has no code for any of them. A case that fails stays in the list, with its figure.
//
// A case that declarations can express is a scene: scenes/hard/NN_name.sdl, compiled into the program as text
// (hard_scenes.h); its `expect` declarations are the figures. Other cases (families of random members,
// statistics, oracles) are a function and a row of constants in a file of their own, listed in
// cases/cases.def; the function works on a Trial (trial.h). Further figures of a scene's case (repetition to
// the bit, orders of convergence) come from a function of cases/members.def; no figure is in both.

namespace carom {

class Trial;

/// How a case is simulated.
enum class StudyColumn : std::uint8_t {
    Default,  ///< a scene that says nothing about its simulation
    Accurate, ///< `simulation { preset accurate }`
    Exact,    ///< `simulation { method events }`
};
inline constexpr std::array studyColumns = {StudyColumn::Default, StudyColumn::Accurate, StudyColumn::Exact};
std::string_view nameOf(StudyColumn column); ///< "default"

/// In the short form a case takes a second or two; the long form is the case as published, and all of them
/// take hours.
enum class StudyLength : std::uint8_t { Short, Long };

/// One measured number and its upper limit. Counts of events that must not happen are figures, too.
struct Figure {
    std::string name;        ///< "energy error"
    double value = 0;        ///< in `unit`; not a number where it could not be measured
    std::string_view unit{}; ///< "m", "rad/s"; empty: relative, or a count
    double limit = 0;        ///< in `unit`

    bool holds() const { return value <= limit; }
};

/// The columns in which a case has a right answer.
using StudyColumns = std::array<bool, 3>;
inline constexpr StudyColumns everyColumn = {true, true, true};
inline constexpr StudyColumns steppingColumns = {true, true, false};
inline constexpr StudyColumns exactColumn = {false, false, true};

struct HardCase {
    int number = 0;
    std::string_view name;      ///< "elastic_ball"
    std::string_view title;     ///< "an elastic ball dropped from 5 m, 20 s"
    std::string_view answer;    ///< the right answer, one sentence
    std::string_view byDefault; ///< the limit of the default column, for people; "–" where there is none
    std::string_view accurate;  ///< the same for the two other columns
    std::string_view aim;       ///< the limit that we aim at
    StudyColumns columns = steppingColumns;
    /// A scene of the case, without a `simulation` declaration.
    std::string (*declarations)() = nullptr;
    void (*run)(Trial& trial) = nullptr;
    std::string_view simulation = ""; ///< further parameters of `simulation`: "step 0.01"
    std::string_view scene = "";      ///< the text of a case that is a scene; then `declarations` is null

    bool has(StudyColumn column) const { return columns[static_cast<std::size_t>(column)]; }
};

/// Every case, ascending by number.
std::span<const HardCase> hardCases();
/// Finds a case by its name, by its spokenName(), or by its number ("13"); null if there is none.
const HardCase* findHardCase(std::string_view nameOrNumber);
/// The name as written in text: "Euler's disk" for `eulers_disk`, which commands and files use.
std::string spokenName(const HardCase& hardCase);

/// The text of the case as a scene: a comment with the right answer, the declarations, and the `simulation`
/// declaration of the column.
std::string sceneOf(const HardCase& hardCase, StudyColumn column);

enum class Verdict : std::uint8_t { Holds, Fails, NotApplicable };
std::string_view nameOf(Verdict verdict); ///< "holds", "fails", "not applicable"

/// One case in one column.
struct TrialResult {
    const HardCase* hardCase = nullptr;
    StudyColumn column = StudyColumn::Default;
    Verdict verdict = Verdict::NotApplicable;
    std::vector<Figure> figures;
    double seconds = 0; ///< wall time

    /// The figure that decides the verdict: the one furthest beyond its limit, or if all hold, the one
    /// nearest to it. Null without figures.
    const Figure* decisive() const;
};

struct StabilityPlan {
    std::vector<const HardCase*> cases;
    std::vector<StudyColumn> columns{studyColumns.begin(), studyColumns.end()};
    StudyLength length = StudyLength::Short;
    Shard shard = {}; ///< a part of the list of cases, each with its columns

    /// The cases and columns that are run, in order.
    std::vector<std::pair<const HardCase*, StudyColumn>> trials() const;
};

struct StabilityStudy {
    StabilityPlan plan;
    std::vector<TrialResult> results; ///< by case, then column, as in the plan
    bool complete = false;            ///< false: it was stopped; the results up to then are complete

    std::size_t count(StudyColumn column, Verdict verdict) const;
    bool allHold() const;
};

/// The listener of a study. All may be empty.
struct StabilityListener {
    std::function<bool()> goOn; ///< false ends the study; asked every frame
    std::function<void(const HardCase&, StudyColumn)> starts;
    std::function<void(const TrialResult&)> ends;
};

/// Runs one case in one column; nothing if `goOn` ended it.
std::optional<TrialResult> runTrial(const HardCase& hardCase, StudyColumn column, StudyLength length,
                                    const StabilityListener& listener = {});

StabilityStudy runStability(const StabilityPlan& plan, const StabilityListener& listener = {});

} // namespace carom
