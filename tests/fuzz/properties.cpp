// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/properties.h"

#include "core/language/analysis.h"
#include "core/language/formatter.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace carom::test {
namespace {

bool within(SourceRange range, const Analysis& analysis) {
    return std::size_t{range.offset} + range.length <= analysis.text.size();
}

std::string brokenRange(const Analysis& analysis) {
    std::uint32_t last = 0;
    for (const Token& token : analysis.tokens) {
        if (token.range.offset < last || !within(token.range, analysis))
            return "a token overlaps the one before";
        last = token.range.end();
    }
    last = 0;
    for (const Diagnostic& diagnostic : analysis.diagnostics) {
        if (!within(diagnostic.range, analysis)) return "a diagnostic lies outside the text";
        if (diagnostic.range.offset < last) return "the diagnostics are not in the order of the text";
        if (diagnostic.message.empty()) return "a diagnostic says nothing";
        if (diagnostic.fixIt && !within(diagnostic.fixIt->edit.range, analysis))
            return "a fix-it outside the text";
        last = diagnostic.range.offset;
    }
    return {};
}

bool sound(const Body& body) {
    return body.pose.position.allFinite() && body.pose.orientation.coeffs().allFinite() &&
           std::abs(body.pose.orientation.norm() - 1) < 1e-12 && body.velocity.allFinite() &&
           std::isfinite(body.mass) && (body.fixed || body.mass > 0);
}

std::string brokenScene(const Analysis& analysis) {
    for (const Body& body : analysis.scene.bodies)
        if (!sound(body)) return "a body was built that cannot be computed with";
    for (const Spring& spring : analysis.scene.springs)
        for (const BodyIndex end : {spring.from, spring.to})
            if (end != noBody && end >= analysis.scene.bodies.size()) return "a spring ends on no body";
    for (const Expectation& expectation : analysis.scene.expectations)
        for (const BodyIndex body : {expectation.of, expectation.to})
            if (body != noBody && body >= analysis.scene.bodies.size()) return "an expectation is of no body";
    const bool silent = analysis.mistakes == 0;
    const std::size_t built = analysis.scene.bodies.size() + analysis.scene.springs.size() +
                              analysis.scene.expectations.size() + (analysis.scene.gravity.source ? 1 : 0) +
                              (analysis.scene.simulation.source ? 1 : 0) + analysis.scene.effects.size() +
                              (analysis.scene.generated ? 1 : 0) + (analysis.scene.sweep ? 1 : 0) +
                              (analysis.scene.camera.source ? 1 : 0);
    const std::size_t declared = analysis.tree.declarations.size();
    if (silent && built != declared) return "a declaration was left out without a message";
    if (built > declared) return "more was built than was declared";
    return {};
}

// White space at the end of a comment is not content.
std::string_view content(const Analysis& analysis, const Token& token) {
    std::string_view text = textOf(analysis.text, token.range);
    if (token.kind == TokenKind::Comment) text = text.substr(0, text.find_last_not_of(" \t") + 1);
    return text;
}

std::string brokenLayout(const Analysis& analysis) {
    const Analysis again = analyse(formatText(analysis));
    if (formatText(again) != again.text) return "formatting twice is not formatting once";
    const bool same = std::equal(analysis.tokens.begin(), analysis.tokens.end(), again.tokens.begin(),
                                 again.tokens.end(), [&](const Token& a, const Token& b) {
                                     return a.kind == b.kind && content(analysis, a) == content(again, b);
                                 });
    if (!same) return "formatting changed a token";
    if (again.scene.bodies.size() != analysis.scene.bodies.size() || again.mistakes != analysis.mistakes)
        return "formatting changed the meaning";
    return {};
}

} // namespace

std::string brokenProperty(std::string_view text) {
    const Analysis analysis = analyse(std::string(text));
    if (analysis.text != text) return "the text was changed";
    for (const Diagnostic& diagnostic : analysis.diagnostics)
        if (formatDiagnostic(analysis, diagnostic, "text").empty()) return "a diagnostic cannot be printed";
    for (const auto& broken : {brokenRange, brokenScene, brokenLayout})
        if (std::string sentence = broken(analysis); !sentence.empty()) return sentence;
    return {};
}

} // namespace carom::test
