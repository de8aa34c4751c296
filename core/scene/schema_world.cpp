// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/schema_rows.h"

#include <numbers>
#include <string>
#include <utility>

// How the scene is simulated and looked at.

namespace carom {
namespace {

constexpr double radiansPerDegree = std::numbers::pi / 180;

CameraSettings& camera(Declared& declared) { return std::get<CameraSettings>(declared); }
SimulationSettings& simulation(Declared& declared) { return std::get<SimulationSettings>(declared); }

ParameterRow simulationNumber(std::string_view name, std::string_view unit, std::string_view help,
                              void (*store)(Declared&, const CheckedValue&)) {
    return {.name = name,
            .kind = ValueKind::Number,
            .unit = unit,
            .defaultText = "what the preset says",
            .constraint = Constraint::Positive,
            .help = help,
            .store = store};
}

ParameterRow simulationCount(std::string_view name, std::string_view help,
                             void (*store)(Declared&, const CheckedValue&)) {
    return {.name = name,
            .kind = ValueKind::WholeNumber,
            .defaultText = "what the preset says",
            .example = "4",
            .constraint = Constraint::AtLeastOne,
            .help = help,
            .store = store};
}

ParameterRow simulationWord(std::string_view name, std::span<const std::string_view> words,
                            std::string_view help, void (*store)(Declared&, const CheckedValue&)) {
    return {.name = name,
            .kind = ValueKind::Word,
            .defaultText = "what the preset says",
            .example = words.front(),
            .words = words,
            .help = help,
            .store = store};
}

} // namespace

DeclarationRow simulationDeclaration() {
    using D = Declared;
    using V = CheckedValue;
    std::vector<ParameterRow> rows = {
        simulationNumber("step", "s", "Time from one frame to the next.",
                         [](D& into, const V& value) { simulation(into).step = value.number; }),
        simulationCount(
            "substeps", "Equal parts a frame is computed in.",
            [](D& into, const V& value) { simulation(into).substeps = static_cast<int>(value.number); }),
        simulationWord("method", methodWords(),
                       "How collisions are treated; `auto` takes the exact `events` where nothing but smooth "
                       "spheres moves, otherwise `contacts`.",
                       [](D& into, const V& value) { simulation(into).method = std::string(value.word); }),
        simulationWord(
            "integrator", integratorWords(), "How motion between collisions is computed.",
            [](D& into, const V& value) { simulation(into).integrator = std::string(value.word); }),
        simulationWord(
            "broadphase", broadphaseWords(), "How pairs that may touch are found.",
            [](D& into, const V& value) { simulation(into).broadphase = std::string(value.word); }),
        simulationWord("boxes", boxesWords(),
                       "Whether the search for pairs works on boxes that fit each body as it turns, or on "
                       "cubes that hold it however it lies, as the reference's did.",
                       [](D& into, const V& value) { simulation(into).boxes = std::string(value.word); }),
        simulationCount(
            "iterations", "Rounds of the contact solver in a substep.",
            [](D& into, const V& value) { simulation(into).iterations = static_cast<int>(value.number); }),
        simulationNumber("tolerance", "", "Relative residual at which the contact solver stops.",
                         [](D& into, const V& value) { simulation(into).tolerance = value.number; }),
        simulationWord("impacts", impactsWords(),
                       "Whether impacts at one moment follow each other or act as one.",
                       [](D& into, const V& value) { simulation(into).impacts = std::string(value.word); }),
        simulationWord("preset", presetWords(), "Sets whatever is not set here.",
                       [](D& into, const V& value) { simulation(into).preset = std::string(value.word); }),
        simulationNumber("duration", "s", "Time after which the run ends.",
                         [](D& into, const V& value) { simulation(into).duration = value.number; })};
    for (ParameterRow& row : rows) row.layer = Layer::Carom;
    const auto amend = [&rows](std::string_view name, std::string_view defaultText,
                               std::string_view example) {
        for (ParameterRow& row : rows) {
            if (row.name != name) continue;
            row.defaultText = defaultText;
            row.example = example;
        }
    };
    amend("step", "1/60 s: one frame", "0.01");
    amend("method", "auto", "contacts");
    amend("tolerance", "what the preset says", "1e-6");
    amend("broadphase", "auto", "auto");
    amend("boxes", "tight", "cube");
    amend("preset", "default", "accurate");
    amend("duration", "no end", "10");
    return {.name = "simulation",
            .help = "How the scene is simulated.",
            .layer = Layer::Carom,
            .once = true,
            .parameters = std::move(rows),
            .begin = []() -> Declared { return SimulationSettings{}; },
            .example = "simulation { preset accurate  duration 10 }"};
}

DeclarationRow cameraDeclaration() {
    std::vector<ParameterRow> rows = {
        {.name = "position",
         .kind = ValueKind::Vector,
         .unit = "m",
         .defaultText = "where the whole scene is in view",
         .example = "0, 2, 10",
         .help = "Where the camera is.",
         .store = [](Declared& into, const CheckedValue& value) { camera(into).position = value.vector; }},
        {.name = "target",
         .kind = ValueKind::Vector,
         .unit = "m",
         .defaultText = "the middle of the scene",
         .example = "0, 0, 0",
         .help = "The point it looks at.",
         .store = [](Declared& into, const CheckedValue& value) { camera(into).target = value.vector; }},
        {.name = "fov",
         .kind = ValueKind::Number,
         .unit = "degrees",
         .defaultText = "what the window has",
         .example = "45",
         .constraint = Constraint::FieldOfView,
         .help = "Vertical angle of view.",
         .store = [](Declared& into, const CheckedValue& value) {
             camera(into).fieldOfView = value.number * radiansPerDegree;
         }}};
    for (ParameterRow& row : rows) row.layer = Layer::Carom;
    return {.name = "camera",
            .help = "From where the scene is looked at.",
            .layer = Layer::Carom,
            .once = true,
            .parameters = std::move(rows),
            .begin = []() -> Declared { return CameraSettings{}; },
            .example = "camera { position 0, 2, 10  target 0, 0, 0  fov 45 }"};
}

} // namespace carom
