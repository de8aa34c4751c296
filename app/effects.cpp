// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/command.h"
#include "app/errors.h"
#include "app/files.h"
#include "app/scene_options.h"
#include "core/base/json.h"

#include <algorithm>

namespace carom {

CommandRow effectsCommand();

namespace {

std::string padded(std::string_view word, std::size_t width) {
    return std::string(word) + std::string(width - word.size(), ' ');
}

std::string textOf(const Build& built, const std::string& file) {
    const std::vector<EffectDecision>& decisions = built.pipeline->effects();
    std::size_t names = 0, states = 0; // widths of the columns
    for (const EffectDecision& decision : decisions) {
        names = std::max(names, decision.effect.size() + 2);
        states = std::max(states, nameOf(decision.status).size() + 2);
    }
    std::string text;
    for (const EffectDecision& decision : decisions) {
        text += padded(decision.effect, names) + padded(nameOf(decision.status), states);
        if (decision.source) {
            const SourcePosition position = built.analysis.positionOf(decision.source->offset);
            text += file + ":" + std::to_string(position.line) + ":" + std::to_string(position.column) + ": ";
        }
        text.append(decision.reason.text()).append("\n");
    }
    return text;
}

std::string jsonOf(const Build& built) {
    JsonWriter json;
    json.beginArray();
    for (const EffectDecision& decision : built.pipeline->effects()) {
        json.beginObject().key("effect").value(decision.effect).key("status").value(nameOf(decision.status));
        json.key("reason").value(decision.reason.text()).key("line");
        if (decision.source) {
            const SourcePosition position = built.analysis.positionOf(decision.source->offset);
            json.value(static_cast<std::int64_t>(position.line)).key("column");
            json.value(static_cast<std::int64_t>(position.column));
        } else {
            json.null().key("column").null();
        }
        json.endObject();
    }
    json.endArray();
    return json.take() + "\n";
}

int runEffects(const Arguments& arguments) {
    const std::string& path = arguments.operands.front();
    const Build built = loadScene(path);
    printOut(arguments.has("json") ? jsonOf(built) : textOf(built, displayName(path)));
    return exitcode::done;
}

} // namespace

CommandRow effectsCommand() {
    return {.name = "effects",
            .summary = "Say which effects a scene calls for, and why the others cannot matter",
            .operands = "SCENE",
            .example = "carom effects scenes/tour.sdl",
            .options = {{"json", 0, "", "print one JSON array of objects"}},
            .details =
                "One line an effect: its name; `on`, `absent` (it costs nothing) or `not simulated yet`; the "
                "place in the text that calls for it; the reason.",
            .leastOperands = 1,
            .mostOperands = 1,
            .run = runEffects};
}

} // namespace carom
