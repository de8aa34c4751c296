// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/hard_scenes.h"

#include "core/base/assert.h"
#include "core/base/text.h"
#include "core/expectations/expectation_report.h"
#include "core/expectations/scene_check.h"
#include "core/language/simulation_edit.h"
#include "core/simulation/build.h"
#include "core/simulation/method_choice.h"
#include "core/solvers/solver.h"
#include "core/study/cases/members.h"
#include "core/study/trial.h"

#include <algorithm>
#include <cmath>
#include <deque>

namespace carom {
namespace {

/// In the short form, expectations of the whole run are judged for so long [s]. At twice the short form takes
/// twice as long; at half some bodies have not met.
constexpr double shortForm = 2;

/// What follows `begin` in the comment at the top of a text, up to the full stop that ends a line, as one
/// line.
std::string sentenceBehind(std::string_view text, std::string_view begin) {
    constexpr std::string_view next = "\n// ";
    const std::size_t at = text.find(begin);
    ASSERT(at != text.npos); // tests hold every scene to it
    const std::size_t from = at + begin.size(), end = text.find(".\n", from);
    std::string sentence(text.substr(from, end - from));
    for (std::size_t i = sentence.find(next); i != sentence.npos; i = sentence.find(next, i))
        sentence.replace(i, next.size(), " ");
    return sentence;
}

/// A scene's own method has its own column; else the general method's two, and that of exact events where
/// they can treat the scene.
StudyColumns columnsOf(const Scene& scene) {
    if (scene.simulation.method) return exactColumn;
    const SolverRow& events = *findSolver("events");
    return !objectionTo(events, scene) ? everyColumn : steppingColumns;
}

/// The limits of a column, for people.
std::string limitsOf(const Scene& scene, std::string_view preset) {
    // Limits that are listed; twice or half changes the length of the text only.
    constexpr std::size_t most = 3;
    std::string text;
    std::size_t count = 0;
    for (const Expectation& asked : scene.expectations) {
        if (!asked.preset.empty() && asked.preset != preset) continue;
        if (++count <= most) text += (text.empty() ? "" : "; ") + wishOf(scene, asked);
    }
    if (count > most) text += "; and " + std::to_string(count - most) + " more";
    return text;
}

SimulationSettings settingsOf(const HardCase& hardCase, StudyColumn column) {
    static const SolverRow& general = *findSolver("contacts");
    SimulationSettings settings;
    settings.method = column == StudyColumn::Exact ? "events" : std::string(general.name);
    settings.preset = column == StudyColumn::Default ? "default" : "accurate";
    if (!hardCase.has(StudyColumn::Default)) settings.preset = "default"; // its own method, one column
    return settings;
}

/// A judgement as a figure and its limit.
Figure figureOf(const Scene& scene, const Judgement& judgement) {
    const Expectation& asked = *judgement.expectation;
    Figure figure{.name = titleOf(scene, asked), .value = judgement.off, .limit = judgement.allowed};
    if (judgement.criterion == Criterion::Most) {
        figure.value = judgement.figure;
        figure.limit = *asked.most;
    } else if (judgement.criterion == Criterion::Least) {
        figure.name += ", short of the least";
    }
    const bool fails = judgement.state != ExpectationState::Holds;
    if (!judgement.measured || (fails && figure.value <= figure.limit)) figure.value = NAN;
    return figure;
}

/// What is asked of the case beside its scene.
void askMembers(Trial& trial) {
#define CAROM_HARD_MEMBERS(which, ask)                                                                       \
    if (trial.hardCase().number == (which)) ask(trial);
#include "core/study/cases/members.def"
#undef CAROM_HARD_MEMBERS
}

void runScene(Trial& trial) {
    const HardCase& hardCase = trial.hardCase();
    const SimulationSettings settings = settingsOf(hardCase, trial.column());
    const Build built = build(std::string(hardCase.scene), settings);
    ASSERT(!built.hasErrors());
    const std::optional<double> mostOpen = trial.isLong() ? std::nullopt : std::optional<double>(shortForm);
    const std::optional<SceneCheck> check = checkRepeated(
        built, settings, [&trial] { return trial.goesOn(); }, mostOpen);
    if (!check) return;
    for (const Judgement& judgement : check->judgements)
        trial.add(figureOf(built.pipeline->scene(), judgement));
    askMembers(trial);
}

std::vector<HardCase> makeCases() {
    static std::deque<std::string> words; // what the rows point to
    std::vector<HardCase> cases;
    for (const HardScene& scene : hardScenes()) {
        const Scene analysed = analyse(std::string(scene.text)).scene;
        const StudyColumns answered = columnsOf(analysed);
        const std::string& byDefault = words.emplace_back(answered[0] ? limitsOf(analysed, "default") : "–");
        const std::string& accurate = words.emplace_back(limitsOf(analysed, "accurate"));
        const std::string_view behindNumber = std::string_view(scene.text).substr(scene.text.find(':'));
        const std::string& title = words.emplace_back(sentenceBehind(behindNumber, ": "));
        const std::string& answer = words.emplace_back(sentenceBehind(scene.text, "// Right: "));
        const std::size_t dash = scene.name.find('_');
        cases.push_back({.number = static_cast<int>(*wholeNumberIn(scene.name.substr(0, dash))),
                         .name = scene.name.substr(dash + 1),
                         .title = title,
                         .answer = answer,
                         .byDefault = byDefault,
                         .accurate = accurate,
                         .aim = accurate,
                         .columns = answered,
                         .run = runScene,
                         .scene = scene.text});
    }
    return cases;
}

} // namespace

std::span<const HardCase> sceneCases() {
    static const std::vector<HardCase> cases = makeCases();
    return cases;
}

std::string sceneTextOf(const HardCase& hardCase, StudyColumn column) {
    if (!hardCase.has(StudyColumn::Default)) return std::string(hardCase.scene);
    SimulationSettings settings = settingsOf(hardCase, column);
    return withSettings(analyse(std::string(hardCase.scene)), settings);
}

} // namespace carom
