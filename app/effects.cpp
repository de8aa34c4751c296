// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/command.h"
#include "app/errors.h"
#include "app/files.h"
#include "app/scene_options.h"
#include "core/base/json.h"

namespace carom {

CommandRow effectsCommand();

namespace {

std::string textOf(const Build& built, const std::string& file) {
    std::string text;
    for (const EffectDecision& decision : built.pipeline->effects()) {
        text.append(decision.effect).append(std::string(20 - decision.effect.size(), ' '));
        const std::string status(nameOf(decision.status));
        text.append(status).append(std::string(20 - status.size(), ' '));
        if (decision.source) {
            const SourcePosition position = built.analysis.positionOf(decision.source->offset);
            text += file + ":" + std::to_string(position.line) + ":" + std::to_string(position.column) + ": ";
        }
        text.append(decision.reason).append("\n");
    }
    return text;
}

std::string jsonOf(const Build& built) {
    JsonWriter json;
    json.beginArray();
    for (const EffectDecision& decision : built.pipeline->effects()) {
        json.beginObject().key("effect").value(decision.effect).key("status").value(nameOf(decision.status));
        json.key("reason").value(decision.reason).key("line");
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
