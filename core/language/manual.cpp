// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/manual.h"

#include "core/base/diagnostic.h"
#include "core/base/text.h"
#include "core/scene/schema.h"

#include <string_view>

namespace carom {
namespace {

constexpr std::string_view opening = R"(# The scene language

A scene is a text: one declaration after another, each a kind of thing and, in braces, its parameters.

    # a ball above a floor
    sphere ball { radius 0.5  mass 1  centre 0, 3, 0  colour red }
    wall { normal 0, 1, 0  toOrig 0 }

All quantities are in SI units: metres, kilograms, seconds, radians, except where degrees are named. The y axis
points up.

## How it is written

* A **declaration** is the name of its type, for bodies a label if you like, and its parameters in braces; `;` in
  place of the braces means no parameters: `gravity;`.
* A **parameter** is a name and a value; a colon between them is allowed: `radius: 0.5`. Parameters stand in any
  order, separated by white space. A parameter given twice is a mistake, and the first value
  holds, but where a list is asked for (`vary` and `measure`).
* A **number** is written `10`, `3.5`, `.5` or `1e-3`. A minus belongs to the one number behind it.
* A **vector** is three numbers separated by commas: `-1, 2, 3` is (-1, 2, 3).
* A **name** is a letter, then letters, digits and `_`. Upper and lower case differ.
* A **text** stands between quotation marks, `"max speed"`, and ends in the line in which it begins.
* A **comment** begins with `//` or `#` and ends with the line.
* A **label** names a body so that springs and expectations can refer to it, or an expectation. Labels are unique; `world` is reserved.

A mistake costs only the declaration it is in: that one is reported and left out, and everything else is built.

Where two bodies touch, restitution is the smaller of their two `elastic`, friction the geometric mean of their two
`friction`, and rolling resistance the larger of their two `rolling`.

Types and parameters marked *Carom* are additions to the language of the reference work; a text without them means
the same there and here.
)";

std::string code(std::string_view text) { return text.empty() ? "" : "`" + std::string(text) + "`"; }

std::string listOf(std::span<const std::string_view> words) {
    std::string list;
    for (const std::string_view word : words) list += (list.empty() ? "" : ", ") + code(word);
    return list;
}

// The words of a whole table cell; a bar would end the cell.
std::string valueCell(const ParameterRow& row) {
    switch (row.kind) {
    case ValueKind::Number:
        return "number";
    case ValueKind::WholeNumber:
        return "whole number";
    case ValueKind::Vector:
        return "vector";
    case ValueKind::Label:
        return "label or `world`";
    case ValueKind::Text:
        return "text";
    case ValueKind::Colour:
        return "vector or colour name";
    case ValueKind::Word:
        break;
    }
    return listOf(row.words);
}

std::string defaultCell(const ParameterRow& row) {
    if (!row.required) return std::string(row.defaultText);
    if (row.requiredUnless.empty()) return "**required**";
    return "**required** unless " + code(std::string(row.requiredUnless) + " yes");
}

std::string sentence(const ParameterRow& row) {
    std::string text(row.help);
    if (row.constraint == Constraint::None) return text;
    const bool each = row.kind == ValueKind::Vector && row.constraint == Constraint::Positive;
    return text + " It " + std::string(sentenceOf(row.constraint)) + (each ? " in each component." : ".");
}

std::string section(const DeclarationRow& row) {
    std::string text = "\n### " + std::string(row.name);
    if (row.layer == Layer::Carom) text += " (*Carom*)";
    text += "\n\n" + std::string(row.help);
    if (row.takesLabel()) text += " It may carry a label.";
    if (row.once) text += " A scene has at most one.";
    text += "\n\n";
    std::string example(row.example);
    for (std::size_t i = example.find('\n'); i != std::string::npos; i = example.find('\n', i + 1))
        example.insert(i + 1, "    ");
    text +=
        "    " + example + "\n\n| parameter | value | unit | default | |\n| --- | --- | --- | --- | --- |\n";
    for (const ParameterRow& parameter : row.parameters) {
        const bool addition = parameter.layer == Layer::Carom && row.layer == Layer::Reference;
        text += "| " + code(parameter.name) + (addition ? " *Carom*" : "") + " | " + valueCell(parameter) +
                " | " + std::string(parameter.unit) + " | " + defaultCell(parameter) + " | " +
                sentence(parameter) + " |\n";
    }
    return text;
}

std::string colours() {
    std::string text =
        "\n## Colours\n\nWhere a colour is asked for, one of these names may stand in place of the three "
        "components.\n\n| name | red, green, blue |\n| --- | --- |\n";
    constexpr int shades = 255;
    for (const NamedColour& colour : namedColours()) {
        text += "| " + code(colour.name) + " | ";
        for (int i = 0; i < 3; ++i) {
            const double byte = colour.colour(i) * shades;
            text += (i == 0 ? "" : ", ") + shortest(byte) + (byte == 0 ? "" : "/255");
        }
        text += " |\n";
    }
    return text;
}

std::string messages() {
    std::string text =
        "\n## Messages\n\nEvery message carries a code that does not change between versions. Errors leave a "
        "declaration out; warnings leave nothing out.\n\n| code | | meaning |\n| --- | --- | --- |\n";
    for (const DiagnosticCodeRow& row : diagnosticCodes())
        text += "| " + code(row.code) + " | " + std::string(nameOf(row.severity)) + " | " +
                std::string(row.help) + " |\n";
    return text;
}

} // namespace

std::string languageManual() {
    std::string text(opening);
    text += "\n## Declarations\n";
    for (const DeclarationRow& row : schema()) text += section(row);
    return text + colours() + messages();
}

} // namespace carom
