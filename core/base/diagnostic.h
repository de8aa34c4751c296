// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/source.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// A message about a text, as plain data. The code that reports it does not print; the code that prints it
// does not decide.

namespace carom {

enum class Severity : std::uint8_t { Error, Warning, Hint };

/// "error", "warning", "hint".
std::string_view nameOf(Severity severity);

enum class DiagnosticCode : std::uint8_t {
#define CAROM_DIAGNOSTIC(name, code, severity, help) name,
#include "core/base/diagnostic_codes.def"
#undef CAROM_DIAGNOSTIC
};

struct DiagnosticCodeRow {
    std::string_view code; ///< stable, e.g. "sdl-unknown-parameter"
    Severity severity;
    std::string_view help; ///< one sentence for the manual
};

const DiagnosticCodeRow& rowOf(DiagnosticCode code);
/// Every row, in the order of DiagnosticCode.
const std::vector<DiagnosticCodeRow>& diagnosticCodes();

/// Replace the bytes of `range` by `text`; an empty range inserts.
struct TextEdit {
    SourceRange range;
    std::string text;
    friend bool operator==(const TextEdit&, const TextEdit&) = default;
};

/// A second place that explains the first ("first given here").
struct DiagnosticNote {
    SourceRange range;
    std::string message;
};

/// The one obvious correction, as the user would read it in a menu.
struct FixIt {
    std::string title; ///< "change to `radius`"
    TextEdit edit;
};

struct Diagnostic {
    DiagnosticCode code{};
    SourceRange range;
    std::string message; ///< what was seen; then, behind a semicolon, what would be right
    std::vector<DiagnosticNote> notes;
    std::optional<FixIt> fixIt;

    Severity severity() const { return rowOf(code).severity; }
};

bool hasErrors(const std::vector<Diagnostic>& diagnostics);

} // namespace carom
