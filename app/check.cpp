// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/command.h"
#include "app/errors.h"
#include "app/files.h"
#include "core/base/json.h"
#include "core/simulation/build.h"

#include <algorithm>
#include <array>
#include <limits>

namespace carom {

CommandRow checkCommand();

namespace {

constexpr std::array<std::string_view, 2> formats = {"text", "json"};

void writePlace(JsonWriter& json, const Analysis& analysis, SourceRange range) {
    const SourcePosition position = analysis.positionOf(range.offset);
    json.key("line").value(static_cast<std::int64_t>(position.line));
    json.key("column").value(static_cast<std::int64_t>(position.column));
    json.key("offset").value(static_cast<std::int64_t>(range.offset));
    json.key("length").value(static_cast<std::int64_t>(range.length));
}

void writeDiagnostic(JsonWriter& json, const Analysis& analysis, const Diagnostic& diagnostic,
                     std::string_view file) {
    json.beginObject().key("file").value(file);
    writePlace(json, analysis, diagnostic.range);
    json.key("severity").value(nameOf(diagnostic.severity()));
    json.key("code").value(rowOf(diagnostic.code).code);
    json.key("message").value(diagnostic.message);
    json.key("notes").beginArray();
    for (const DiagnosticNote& note : diagnostic.notes) {
        json.beginObject();
        writePlace(json, analysis, note.range);
        json.key("message").value(note.message).endObject();
    }
    json.endArray().key("fix");
    if (diagnostic.fixIt) {
        json.beginObject().key("title").value(diagnostic.fixIt->title);
        json.key("offset").value(static_cast<std::int64_t>(diagnostic.fixIt->edit.range.offset));
        json.key("length").value(static_cast<std::int64_t>(diagnostic.fixIt->edit.range.length));
        json.key("text").value(diagnostic.fixIt->edit.text).endObject();
    } else {
        json.null();
    }
    json.endObject();
}

int runCheck(const Arguments& arguments) {
    const bool asJson = arguments.word("format", formats) == "json";
    JsonWriter json;
    json.beginArray();
    int result = exitcode::done;
    const auto report = [&](const Analysis& analysis, const Diagnostic& diagnostic, const std::string& path) {
        if (asJson)
            writeDiagnostic(json, analysis, diagnostic, displayName(path));
        else
            printOut(formatDiagnostic(analysis, diagnostic, displayName(path)) + "\n");
    };
    for (const std::string& path : arguments.operands) {
        try {
            const Build built = build(readText(path));
            for (const Diagnostic& diagnostic : built.diagnostics) report(built.analysis, diagnostic, path);
            if (built.hasErrors()) result = std::max(result, exitcode::sceneHasErrors);
        } catch (const UnreadableFile& error) { // the other scenes are checked all the same
            printError(std::string("carom check: ") + error.what() + "\n");
            result = exitcode::fileError;
        } catch (const TextTooLarge& error) {
            Diagnostic diagnostic;
            diagnostic.code = DiagnosticCode::TextTooLarge;
            diagnostic.message = error.what();
            report({}, diagnostic, path);
            result = std::max(result, exitcode::sceneHasErrors);
        }
    }
    json.endArray();
    if (asJson) printOut(json.take() + "\n");
    return result;
}

} // namespace

CommandRow checkCommand() {
    return {.name = "check",
            .summary = "Report mistakes in scenes",
            .operands = "SCENE...",
            .example = "carom check scenes/*.sdl\ncarom generate table | carom check --format json -",
            .options = {{"format", 'f', "FORMAT", "how to report: text (the default) or json"}},
            .details =
                "A line of text is `file:line:column: severity: message [code]`; columns count characters "
                "from 1. JSON is one array of objects with file, line, column, offset and length in bytes, "
                "severity, code, message, notes, and fix: null, or the edit that corrects it.\n\n"
                "The exit code is 1 if any scene has errors; warnings and hints do not count.",
            .leastOperands = 1,
            .mostOperands = std::numeric_limits<std::size_t>::max(),
            .run = runCheck};
}

} // namespace carom
