// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/language/analysis.h"

#include <QTest>

#include <string>
#include <string_view>

// The vocabulary of the language's tests: check(source, expected) compares every diagnostic of a text, each
// as a line "line:column code `the marked text`". What is marked is part of the comparison: a message in the
// wrong place is wrong.

namespace carom::test {

inline std::string diagnosed(const Analysis& analysis) {
    std::string lines;
    for (const Diagnostic& diagnostic : analysis.diagnostics) {
        const SourcePosition at = analysis.positionOf(diagnostic.range.offset);
        lines += std::to_string(at.line) + ":" + std::to_string(at.column) + " ";
        lines += rowOf(diagnostic.code).code;
        lines += " `" + std::string(textOf(analysis.text, diagnostic.range)) + "`\n";
    }
    return lines;
}

/// Expects exactly these diagnostics; `expected` is "" for a right text.
inline void check(std::string_view source, std::string_view expected) {
    const Analysis analysis = analyse(std::string(source));
    QCOMPARE(diagnosed(analysis), std::string(expected));
    QCOMPARE(analysis.mistakes, std::uint64_t{analysis.diagnostics.size()});
}

/// The text after an edit.
inline std::string edited(std::string text, const TextEdit& edit) {
    return text.replace(edit.range.offset, edit.range.length, edit.text);
}

/// The text after the fix-it of its first diagnostic that has one, until none has.
inline std::string corrected(std::string text) {
    constexpr int mostFixIts = 100; // a fix-it that corrects nothing must not hang the test
    for (int i = 0; i < mostFixIts; ++i) {
        const Analysis analysis = analyse(text);
        const Diagnostic* correctable = nullptr;
        for (const Diagnostic& diagnostic : analysis.diagnostics)
            if (diagnostic.fixIt && correctable == nullptr) correctable = &diagnostic;
        if (correctable == nullptr) return text;
        text = edited(std::move(text), correctable->fixIt->edit);
    }
    return text;
}

} // namespace carom::test
