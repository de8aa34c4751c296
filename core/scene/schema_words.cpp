// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/schema.h"

#include <algorithm>
#include <array>

// The words of the scene language and the phrases by which messages and the manual name its rules.

namespace carom {
namespace {

constexpr auto methods = std::to_array<std::string_view>({
    "auto",
#define CAROM_METHOD(word, row) #word,
#include "core/scene/methods.def"
#undef CAROM_METHOD
});
constexpr auto integratorNames = std::to_array<std::string_view>({
#define CAROM_INTEGRATOR(word, row) #word,
#include "core/scene/integrators.def"
#undef CAROM_INTEGRATOR
});
constexpr auto broadphaseNames = std::to_array<std::string_view>({
    "auto",
#define CAROM_BROADPHASE(word, row) #word,
#include "core/scene/broadphases.def"
#undef CAROM_BROADPHASE
});
constexpr auto presets = std::to_array<std::string_view>({
#define CAROM_PRESET(word, help) #word,
#include "core/scene/presets.def"
#undef CAROM_PRESET
});
constexpr auto generatorNames = std::to_array<std::string_view>({
#define CAROM_GENERATOR(word, function) #word,
#include "core/scene/generators.def"
#undef CAROM_GENERATOR
});
constexpr std::array<std::string_view, 2> boxesNames = {"tight", "cube"};
constexpr std::array<std::string_view, 2> impactsNames = {"sequential", "simultaneous"};
// Of a body, or of each; then what is found by other means; then of the whole scene only.
constexpr auto quantities = std::to_array<std::string_view>({
#define CAROM_BODY_QUANTITY(word, name, unit, ...) #word,
#include "core/scene/quantities.def"
    "impacts",
    "distance",
#define CAROM_WHOLE_ONLY_QUANTITY(word, name, unit, ...) #word,
#include "core/scene/quantities.def"
#define CAROM_LEDGER_ACCOUNT(account, word) "energy_by_" #word,
#include "core/scene/ledger_accounts.def"
#undef CAROM_LEDGER_ACCOUNT
    "energy_unexplained",
});
constexpr std::string_view lastOfBodies = "distance";

constexpr std::array<std::string_view, 2> yesOrNo = {"yes", "no"};

} // namespace

std::span<const std::string_view> methodWords() { return methods; }
std::span<const std::string_view> integratorWords() { return integratorNames; }
std::span<const std::string_view> broadphaseWords() { return broadphaseNames; }
std::span<const std::string_view> boxesWords() { return boxesNames; }
std::span<const std::string_view> impactsWords() { return impactsNames; }
std::span<const std::string_view> yesOrNoWords() { return yesOrNo; }
std::span<const std::string_view> generatorWords() { return generatorNames; }
std::span<const std::string_view> presetWords() { return presets; }
std::span<const std::string_view> quantityWords() { return quantities; }
bool isOfWholeOnly(std::string_view quantity) {
    const auto* const last = std::ranges::find(quantities, lastOfBodies);
    return std::find(last + 1, quantities.end(), quantity) != quantities.end();
}
bool isOfTwoBodies(std::string_view quantity) { return quantity == "distance"; }

std::span<const NamedColour> namedColours() {
    // CSS Color Module Level 3 (W3C, 2011), section 4.1: components are 0, 128, 192 or 255 of 255.
    constexpr double half = 128.0 / 255.0;
    constexpr double threeQuarters = 192.0 / 255.0;
    static const std::array<NamedColour, 16> colours = {{
        {"aqua", {0, 1, 1}},
        {"black", {0, 0, 0}},
        {"blue", {0, 0, 1}},
        {"fuchsia", {1, 0, 1}},
        {"gray", {half, half, half}},
        {"green", {0, half, 0}},
        {"lime", {0, 1, 0}},
        {"maroon", {half, 0, 0}},
        {"navy", {0, 0, half}},
        {"olive", {half, half, 0}},
        {"purple", {half, 0, half}},
        {"red", {1, 0, 0}},
        {"silver", {threeQuarters, threeQuarters, threeQuarters}},
        {"teal", {0, half, half}},
        {"white", {1, 1, 1}},
        {"yellow", {1, 1, 0}},
    }};
    return colours;
}

std::string_view sentenceOf(Constraint constraint) {
    switch (constraint) {
    case Constraint::None:
        return "";
    case Constraint::Positive:
        return "must be greater than 0";
    case Constraint::NotNegative:
        return "must not be negative";
    case Constraint::NonzeroVector:
        return "must not be 0, 0, 0";
    case Constraint::UnitRange:
        return "must be from 0 to 1 in each component";
    case Constraint::AtLeastOne:
        return "must be at least 1";
    case Constraint::FieldOfView:
        return "must be greater than 0 and less than 180 degrees";
    }
    return "";
}

std::string_view phraseOf(ValueKind kind) {
    switch (kind) {
    case ValueKind::Number:
        return "a number";
    case ValueKind::WholeNumber:
        return "a whole number";
    case ValueKind::Vector:
        return "a vector (three numbers separated by commas)";
    case ValueKind::Word:
        return "a word";
    case ValueKind::Label:
        return "a body's label or `world`";
    case ValueKind::Text:
        return "a text in quotation marks";
    case ValueKind::Colour:
        return "a colour (three numbers from 0 to 1 separated by commas, or a colour's name)";
    }
    return "a value";
}

} // namespace carom
