// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/schema_rows.h"

#include <string>

// A parameter study beside the scene: what `carom sweep` does where its command line does not say.

namespace carom {
namespace {

using D = Declared;
using V = CheckedValue;

SweepRequest& sweep(Declared& declared) { return std::get<SweepRequest>(declared); }

ParameterRow sweptText(std::string_view name, bool required, std::string_view example, std::string_view help,
                       void (*store)(Declared&, const CheckedValue&)) {
    return {.name = name,
            .kind = ValueKind::Text,
            .required = required,
            .defaultText = required ? "" : "nothing",
            .example = example,
            .inSnippet = true,
            .repeats = true,
            .help = help,
            .store = store};
}

ParameterRow sweptCount(std::string_view name, std::string_view defaultText, std::string_view example,
                        std::string_view help, void (*store)(Declared&, const CheckedValue&)) {
    return {.name = name,
            .kind = ValueKind::WholeNumber,
            .defaultText = defaultText,
            .example = example,
            .constraint = Constraint::AtLeastOne,
            .help = help,
            .store = store};
}

} // namespace

DeclarationRow sweepDeclaration() {
    std::vector<ParameterRow> rows = {
        sweptText("vary", false, "\"gravity.accel.y=-12:-8:5\"",
                  "A number or word of the text and what it becomes: first:last:count, `log 1e-3:1:7`, a "
                  "list, or a "
                  "law (`uniform 4:12`, `normal 8:0.5`).",
                  [](D& into, const V& value) {
                      sweep(into).vary.push_back({std::string(value.word), value.place});
                  }),
        sweptText(
            "measure", true, "\"max speed\"",
            "A figure to take from each run: `final y of ball`, `max penetration`, `speed of ball at 1.5`, "
            "`first impact of a and b`.",
            [](D& into, const V& value) {
                sweep(into).measures.push_back({std::string(value.word), value.place});
            }),
        {.name = "zip",
         .kind = ValueKind::Word,
         .defaultText = "no",
         .example = "yes",
         .words = yesOrNoWords(),
         .help = "Varied values go together, first with first, instead of each with each.",
         .store = [](D& into, const V& value) { sweep(into).zip = value.word == "yes"; }},
        sweptCount("random", "none", "100", "Draws from the laws.",
                   [](D& into, const V& value) { sweep(into).random = static_cast<int>(value.number); }),
        sweptCount("seeds", "the declared one", "20",
                   "Runs of each point, each with the next seed of the generated scene.",
                   [](D& into, const V& value) { sweep(into).seeds = static_cast<int>(value.number); }),
        sweptCount("frames", "the duration, or 600", "600", "Frames of each run.",
                   [](D& into, const V& value) { sweep(into).frames = static_cast<int>(value.number); })};
    for (ParameterRow& row : rows) row.layer = Layer::Carom;
    return {
        .name = "sweep",
        .help =
            "A study of the scene over ranges of its numbers; `carom sweep` makes it, and it never changes "
            "the motion.",
        .layer = Layer::Carom,
        .once = true,
        .parameters = std::move(rows),
        .begin = []() -> Declared { return SweepRequest{}; },
        .example = "sphere ball { radius 0.1  mass 1  centre 0, 5, 0 }\n"
                   "sweep { vary \"ball.vel.x=0:4:9\"  measure \"final x of ball\" }"};
}

} // namespace carom
