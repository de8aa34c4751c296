// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scene/scene.h"

#include <cstdint>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

// The one table that knows the scene language's declarations. The validator, completion, hover help, the
// formatter, the manual page and the language reference are all made from it: a new parameter is one new row.
// Effects bring their own rows (effects.def): nothing here includes an effect, and none is known by name.

namespace carom {

enum class ValueKind : std::uint8_t {
    Number,      ///< one scalar
    WholeNumber, ///< one scalar without a fraction
    Vector,      ///< three scalars
    Word,        ///< one of ParameterRow::words
    Label,       ///< a body's label, or `world`
    Text,        ///< anything between quotation marks
    Colour,      ///< three scalars in 0..1, or one of the sixteen basic colour names
};

/// What a value must hold beyond its kind.
enum class Constraint : std::uint8_t {
    None,
    Positive,      ///< > 0 (a number), each > 0 (a vector)
    NotNegative,   ///< >= 0
    NonzeroVector, ///< not 0,0,0
    UnitRange,     ///< each component in 0..1
    AtLeastOne,    ///< >= 1
    FieldOfView,   ///< 0 < x < 180
};

/// How a message or the manual says it: "must be greater than 0"; empty for None.
std::string_view sentenceOf(Constraint constraint);
/// "a number", "three numbers separated by commas", "a word", ...
std::string_view phraseOf(ValueKind kind);

/// A value that has passed its row's checks.
struct CheckedValue {
    double number = 0;
    Vec3 vector = Vec3::Zero();
    std::string_view word;   ///< Word: the row's own word; Label: as written; Text: without its marks
    SourceRange place;       ///< of the value
    BodyIndex body = noBody; ///< Label: the body it names; noBody is the world
    BodyFamily family =
        {}; ///< Label: the bodies it names, where the row takes families and no body is called so
};

/// What one declaration builds, while its parameters are stored into it.
using Declared = std::variant<Body, Spring, Gravity, EffectDeclaration, SimulationSettings, CameraSettings,
                              Expectation, Generated, SweepRequest>;

enum class Layer : std::uint8_t { Reference, Carom };

struct ParameterRow {
    std::string_view name = {};
    ValueKind kind = ValueKind::Number;
    std::string_view unit = {}; ///< "m", "rad/s", "" for none
    bool required = false;
    std::string_view requiredUnless = {}; ///< not required where the parameter of this name is `yes`
    std::string_view defaultText = {};    ///< as one would write it, or a phrase; "" where required
    std::string_view example = {};        ///< a value one might write; what a fix-it or a snippet puts in
    bool inSnippet = false;               ///< a snippet gives it although it is not required
    Constraint constraint = Constraint::None;
    std::span<const std::string_view> words = {}; ///< for ValueKind::Word
    bool takesFamily = false;                     ///< for ValueKind::Label: a family of bodies will do, too
    bool repeats = false;                         ///< may be given again, another value each time
    std::string_view help = {};                   ///< one line
    Layer layer = Layer::Reference;
    bool ofMoving = false; ///< of a body: means something only for one that may move; walls lack it
    std::string_view title =
        {};             ///< of a body's number: what a panel calls it, "drag coefficient"; "": not shown
    double typical = 0; ///< its largest value in most scenes, in its unit: the range of a slider
    /// Null, for numbers and vectors of effects: by name into the EffectValues of what is declared.
    void (*store)(Declared& into, const CheckedValue& value) = nullptr;
    /// Of a body's number that has a title. Null: by name from its EffectValues.
    double (*read)(const Body& body) = nullptr;
};

/// Stores a value that has passed its row's checks.
void storeValue(const ParameterRow& row, const CheckedValue& value, Declared& into);
/// The number of a body that the row stores [the row's unit].
double numberOf(const ParameterRow& row, const Body& body);

struct DeclarationRow {
    std::string_view name = {};
    std::string_view help = {}; ///< one line
    Layer layer = Layer::Reference;
    bool isBody = false;          ///< may carry a label that others name it by
    std::string_view labels = {}; ///< what its label labels where that is no body: "an expectation"
    bool once = false;            ///< a scene has at most one
    std::vector<ParameterRow> parameters = {};
    /// An empty one, defaults in place. Null: an EffectDeclaration.
    Declared (*begin)() = nullptr;
    std::string_view example = {}; ///< a snippet that validates by itself (with the bodies it names)

    const ParameterRow* find(std::string_view parameter) const;
    bool takesLabel() const { return isBody || !labels.empty(); }
    /// Whether it names bodies, and so can be built only when all bodies are known.
    bool takesLabels() const;
    Declared begun() const;
};

/// What an effect adds to the language.
struct EffectWords {
    std::vector<DeclarationRow> declarations = {};
    std::vector<ParameterRow> ofBodies = {}; ///< of every body; walls lack those of moving bodies
};

/// Every declaration of the language, in the order of the manual.
std::span<const DeclarationRow> schema();
const DeclarationRow* findDeclaration(std::string_view name);

/// The sixteen basic colour names and their values.
struct NamedColour {
    std::string_view name;
    Vec3 colour;
};
std::span<const NamedColour> namedColours();

std::span<const std::string_view> yesOrNoWords();

/// Words of `simulation`; the one place where the language and the catalogues of methods must agree (a test
/// holds them to it).
std::span<const std::string_view> methodWords();
std::span<const std::string_view> integratorWords();
std::span<const std::string_view> broadphaseWords();
std::span<const std::string_view> boxesWords();
std::span<const std::string_view> impactsWords();
std::span<const std::string_view> presetWords();
/// Words of `generate`'s `scene`.
std::span<const std::string_view> generatorWords();
/// Words of `expect`'s `quantity`; those that only the whole scene has, and those of two bodies.
std::span<const std::string_view> quantityWords();
bool isOfWholeOnly(std::string_view quantity);
bool isOfTwoBodies(std::string_view quantity);

} // namespace carom
