// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/description.h"

namespace carom {
namespace {

std::string kindOf(const ParameterRow& row) {
    switch (row.kind) {
    case ValueKind::Number:
        return "number";
    case ValueKind::WholeNumber:
        return "whole number";
    case ValueKind::Vector:
        return "vector";
    case ValueKind::Label:
        return "label of a body, or world";
    case ValueKind::Text:
        return "text";
    case ValueKind::Colour:
        return "colour";
    case ValueKind::Word:
        break;
    }
    std::string words;
    for (const std::string_view word : row.words)
        words += (words.empty() ? "one of " : ", ") + std::string(word);
    return words;
}

} // namespace

std::string summaryOf(const ParameterRow& row) {
    std::string summary = kindOf(row);
    if (!row.unit.empty()) summary += " [" + std::string(row.unit) + "]";
    const std::string_view separator = row.kind == ValueKind::Word ? "; " : ", ";
    summary += separator;
    if (row.required) {
        summary += "required";
        if (!row.requiredUnless.empty()) summary += " unless " + std::string(row.requiredUnless);
    } else {
        summary += "default " + std::string(row.defaultText);
    }
    if (row.constraint != Constraint::None) summary += "; " + std::string(sentenceOf(row.constraint));
    return summary;
}

std::string signatureOf(const DeclarationRow& row) {
    std::string signature(row.name);
    signature += row.takesLabel() ? " [label] {" : " {";
    for (const ParameterRow& parameter : row.parameters) {
        const std::string name(parameter.name);
        signature += " " + (parameter.required ? name : "[" + name + "]");
    }
    return signature + " }";
}

std::string snippetOf(const DeclarationRow& row) {
    std::string snippet = std::string(row.name) + " {\n";
    bool any = false;
    for (const ParameterRow& parameter : row.parameters) {
        if (!parameter.required && !parameter.inSnippet) continue;
        snippet += "    " + std::string(parameter.name) + " " + std::string(parameter.example) + "\n";
        any = true;
    }
    if (any) return snippet + "}";
    const ParameterRow& first = row.parameters.front();
    return snippet + "    " + std::string(first.name) + " " + std::string(first.example) + "\n}";
}

} // namespace carom
