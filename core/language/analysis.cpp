// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/analysis.h"

#include "core/base/diagnostic_list.h"
#include "core/language/lexer.h"
#include "core/language/parser.h"
#include "core/language/sweep_check.h"
#include "core/language/validator.h"

#include <algorithm>

namespace carom {
namespace {

std::string located(const Analysis& analysis, std::string_view file, std::uint32_t offset) {
    const SourcePosition position = analysis.positionOf(offset);
    return std::string(file) + ":" + std::to_string(position.line) + ":" + std::to_string(position.column) +
           ": ";
}

// In the order of the text; where the list was cut short, the last entry says by how much.
std::vector<Diagnostic> inOrder(DiagnosticList& list, std::uint32_t end) {
    const std::uint64_t unlisted = list.total() - list.listed().size();
    std::vector<Diagnostic> diagnostics = list.take();
    std::stable_sort(diagnostics.begin(), diagnostics.end(), [](const Diagnostic& a, const Diagnostic& b) {
        return a.range.offset < b.range.offset;
    });
    if (unlisted > 0) {
        Diagnostic& rest = diagnostics.emplace_back();
        rest.code = DiagnosticCode::LimitReached;
        rest.range = {end, 0};
        rest.message = std::to_string(diagnostics.size() - 1) + " mistakes are listed, " +
                       std::to_string(unlisted) + " more are not; correct some of these first";
    }
    return diagnostics;
}

} // namespace

Analysis analyse(std::string text, const WorkStage& stage) {
    DiagnosticList list;
    Analysis analysis;
    analysis.text = std::move(text);
    if (analysis.text.size() > largestText) {
        if (Diagnostic* diagnostic = list.report(DiagnosticCode::TextTooLarge, {}))
            diagnostic->message = "the text has " + std::to_string(analysis.text.size()) +
                                  " bytes; at most 67108864 (64 MiB) are read";
        analysis.tokens.push_back({});
    } else {
        analysis.lines = LineTable(analysis.text);
        // The stages' shares of the time, as they are for 200,000 spheres.
        constexpr double lexed = 0.28, parsed = 0.68;
        analysis.tokens = lex(analysis.text, list, stage.part(0, lexed));
        analysis.tree =
            parse(analysis.text, analysis.tokens, list, largestDeclarationCount, stage.part(lexed, parsed));
        analysis.scene = validate(analysis.text, analysis.tree, list, stage.part(parsed, 1));
        if (analysis.scene.sweep && !checkSweep(analysis, list)) analysis.scene.sweep.reset();
    }
    analysis.mistakes = list.total();
    analysis.diagnostics = inOrder(list, analysis.tokens.back().range.offset);
    return analysis;
}

std::string formatDiagnostic(const Analysis& analysis, const Diagnostic& diagnostic, std::string_view file) {
    std::string result = located(analysis, file, diagnostic.range.offset);
    result += nameOf(diagnostic.severity());
    result += ": " + diagnostic.message + " [";
    result += rowOf(diagnostic.code).code;
    result += "]";
    for (const DiagnosticNote& note : diagnostic.notes)
        result += "\n" + located(analysis, file, note.range.offset) + "note: " + note.message;
    return result;
}

} // namespace carom
