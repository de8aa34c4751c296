// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/schema_rows.h"

#include <string>
#include <utility>

// What must come out of a run.

namespace carom {
namespace {

using D = Declared;
using V = CheckedValue;

Expectation& expectation(Declared& declared) { return std::get<Expectation>(declared); }

ParameterRow expectedNumber(std::string_view name, std::string_view unit, std::string_view defaultText,
                            std::string_view example, std::string_view help) {
    return {.name = name,
            .kind = ValueKind::Number,
            .unit = unit,
            .defaultText = defaultText,
            .example = example,
            .help = help};
}

ParameterRow wholeNumber(std::string_view name, std::string_view defaultText, std::string_view example,
                         std::string_view help) {
    ParameterRow row = expectedNumber(name, "", defaultText, example, help);
    row.kind = ValueKind::WholeNumber;
    return row;
}

ParameterRow stored(ParameterRow row, void (*store)(Declared&, const CheckedValue&),
                    Constraint constraint = Constraint::None) {
    row.store = store;
    row.constraint = constraint;
    return row;
}

std::vector<ParameterRow> whatAndWhen() {
    return {
        {.name = "quantity",
         .kind = ValueKind::Word,
         .required = true,
         .requiredUnless = "rest",
         .example = "energy",
         .words = quantityWords(),
         .help = "What is measured: the quantities of the plots, `impacts` so far, or the `distance` of two "
                 "surfaces.",
         .store = [](D& into, const V& value) { expectation(into).quantity = value.word; }},
        {.name = "of",
         .kind = ValueKind::Label,
         .defaultText = "the whole scene",
         .example = "world",
         .takesFamily = true,
         .help =
             "Label of the body, or the start that several labels share before a number (`log` for `log1`, "
             "`log2`, ...): then of each. Without it, what only bodies have is asked of each that can move.",
         .store =
             [](D& into, const V& value) {
                 expectation(into).of = value.body;
                 expectation(into).ofEach = value.family;
             }},
        {.name = "to",
         .kind = ValueKind::Label,
         .defaultText = "no body",
         .example = "world",
         .help = "Label of the other body of a `distance`.",
         .store = [](D& into, const V& value) { expectation(into).to = value.body; }},
        stored(
            expectedNumber("at", "s", "the whole run", "1",
                           "The one moment; between two frames the path through both is read."),
            [](D& into, const V& value) { expectation(into).at = value.number; }, Constraint::NotNegative),
        stored(
            expectedNumber("from", "s", "the start", "1", "When it begins to hold."),
            [](D& into, const V& value) { expectation(into).from = value.number; }, Constraint::NotNegative),
        stored(
            expectedNumber("until", "s", "the end of the run", "10", "Up to when it holds."),
            [](D& into, const V& value) { expectation(into).until = value.number; }, Constraint::NotNegative),
    };
}

std::vector<ParameterRow> whatMustHold() {
    return {
        stored(expectedNumber("value", "", "any", "0", "What it is, in the quantity's SI unit."),
               [](D& into, const V& value) { expectation(into).value = value.number; }),
        stored(
            expectedNumber("within", "", "none", "1e-6", "By how much it may be off `value`."),
            [](D& into, const V& value) { expectation(into).within = value.number; },
            Constraint::NotNegative),
        stored(
            expectedNumber("relative", "", "none", "1e-6", "The same as a share of `value`."),
            [](D& into, const V& value) { expectation(into).relative = value.number; },
            Constraint::NotNegative),
        stored(expectedNumber("min", "", "any", "0", "The least it may be."),
               [](D& into, const V& value) { expectation(into).least = value.number; }),
        stored(expectedNumber("max", "", "any", "1", "The most it may be."),
               [](D& into, const V& value) { expectation(into).most = value.number; }),
        stored(
            expectedNumber("drift", "", "any", "1e-6",
                           "How far it may be from what it was when its time began, relative to the larger "
                           "of the two, and of what the quantity has to be compared with: the kinetic energy "
                           "for energies, the body's size for places, the length for components."),
            [](D& into, const V& value) { expectation(into).drift = value.number; }, Constraint::NotNegative),
        {.name = "rest",
         .kind = ValueKind::Word,
         .defaultText = "no",
         .example = "yes",
         .words = yesOrNoWords(),
         .help = "Nothing moves: no bit of a place changes, and velocities are 0.",
         .store = [](D& into, const V& value) { expectation(into).rest = value.word == "yes"; }},
        stored(
            wholeNumber(
                "repeat", "1", "20",
                "Of a scene with `generate`: so many runs, each with the next seed; the worst counts."),
            [](D& into, const V& value) { expectation(into).repeat = static_cast<int>(value.number); },
            Constraint::AtLeastOne),
        stored(
            wholeNumber("seed", "that of `generate`", "1", "Of the first of `repeat` runs."),
            [](D& into, const V& value) { expectation(into).seed = static_cast<int>(value.number); },
            Constraint::NotNegative),
        {.name = "preset",
         .kind = ValueKind::Word,
         .defaultText = "every preset",
         .example = "accurate",
         .words = presetWords(),
         .help = "Judged only in runs with this preset.",
         .store = [](D& into, const V& value) { expectation(into).preset = value.word; }},
    };
}

} // namespace

DeclarationRow generateDeclaration() {
    std::vector<ParameterRow> rows = {
        {.name = "scene",
         .kind = ValueKind::Word,
         .required = true,
         .example = "tower",
         .words = generatorWords(),
         .help = "Which generator makes the bodies; `carom generate --list` describes them.",
         .store = [](D& into, const V& value) { std::get<Generated>(into).generator = value.word; }},
        stored(
            wholeNumber("n", "the generator's", "6", "How many bodies it makes; most 100000 in a text."),
            [](D& into, const V& value) { std::get<Generated>(into).count = static_cast<int>(value.number); },
            Constraint::AtLeastOne),
        stored(
            wholeNumber("seed", "1", "1", "Of its random numbers."),
            [](D& into, const V& value) { std::get<Generated>(into).seed = static_cast<int>(value.number); },
            Constraint::NotNegative),
        {.name = "offset",
         .kind = ValueKind::Vector,
         .unit = "m",
         .defaultText = "0, 0, 0",
         .example = "0, 0, 0",
         .help = "By which everything it makes is moved.",
         .store = [](D& into, const V& value) { std::get<Generated>(into).offset = value.vector; }}};
    for (ParameterRow& row : rows) row.layer = Layer::Carom;
    return {
        .name = "generate",
        .help =
            "The bodies and springs of a generated scene, in this place of the text; its gravity, camera "
            "and settings hold where the text has none of its own. By its label an `expect` asks for each "
            "of its bodies that can move.",
        .layer = Layer::Carom,
        .labels = "generated bodies",
        .once = true,
        .parameters = std::move(rows),
        .begin = []() -> Declared { return Generated{}; },
        .example = "generate cubes { scene tower  n 6 }\n"
                   "expect { quantity turn  of cubes  max 1e-3 }"};
}

DeclarationRow expectDeclaration() {
    std::vector<ParameterRow> rows = whatAndWhen();
    for (ParameterRow& row : whatMustHold()) rows.push_back(std::move(row));
    for (ParameterRow& row : rows) {
        row.layer = Layer::Carom;
        row.inSnippet = row.name == "drift";
    }
    return {.name = "expect",
            .help = "What must come out of a run; `carom test` judges it, and it never changes the motion.",
            .layer = Layer::Carom,
            .labels = "an expectation",
            .parameters = std::move(rows),
            .begin = []() -> Declared { return Expectation{}; },
            .example = "sphere ball { radius 0.1  mass 1  centre 0, 5, 0 }\n"
                       "expect fall { quantity y  of ball  at 1  value 0.1  within 1e-9 }"};
}

} // namespace carom
