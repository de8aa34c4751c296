// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/diagnostic.h"

#include <algorithm>

namespace carom {

std::string_view nameOf(Severity severity) {
    switch (severity) {
    case Severity::Error:
        return "error";
    case Severity::Warning:
        return "warning";
    case Severity::Hint:
        return "hint";
    }
    return "error";
}

const std::vector<DiagnosticCodeRow>& diagnosticCodes() {
    static const std::vector<DiagnosticCodeRow> rows = {
#define CAROM_DIAGNOSTIC(name, code, severity, help) {code, Severity::severity, help},
#include "core/base/diagnostic_codes.def"
#undef CAROM_DIAGNOSTIC
    };
    return rows;
}

const DiagnosticCodeRow& rowOf(DiagnosticCode code) {
    return diagnosticCodes()[static_cast<std::size_t>(code)];
}

bool hasErrors(const std::vector<Diagnostic>& diagnostics) {
    return std::any_of(diagnostics.begin(), diagnostics.end(),
                       [](const Diagnostic& d) { return d.severity() == Severity::Error; });
}

} // namespace carom
