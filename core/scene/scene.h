// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/index.h"
#include "core/base/source.h"
#include "core/math/pose.h"
#include "core/shapes/shape.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// What a scene is: plain data in SI units, each value knowing the place in the text that gave it. A Scene is
// what a text means; how it is simulated is decided later, by the compiler of core/simulation.

namespace carom {

/// Where one parameter was written. The name points into the schema table, which is constant.
struct ParameterSource {
    std::string_view parameter; ///< "friction"
    SourceRange name;
    SourceRange value;
};

/// The places of one declaration.
struct DeclarationSource {
    SourceRange declaration;          ///< from the type's name to the closing brace or semicolon
    SourceRange type;                 ///< the type's name, e.g. `sphere`
    SourceRange label;                ///< empty where there is none
    std::uint32_t firstParameter = 0; ///< into Scene::parameterSources
    std::uint32_t parameterCount = 0;
};

/// What effects' own parameters are given, by the parameter's name (schema.h). What is not given is 0.
class EffectValues {
  public:
    /// A number stands in x.
    struct Value {
        std::string_view parameter; ///< of the schema's row, which is constant
        Vec3 value = Vec3::Zero();
    };

    void set(std::string_view parameter, const Vec3& value);
    void set(std::string_view parameter, double value) { set(parameter, Vec3(value, 0, 0)); }
    double number(std::string_view parameter) const { return vector(parameter).x(); }
    Vec3 vector(std::string_view parameter) const;
    const std::vector<Value>& all() const { return m_values; } ///< by name, ascending
    std::vector<Value>& all() { return m_values; }

  private:
    std::vector<Value> m_values;
};

struct Body {
    Shape shape;                         ///< walls carry their own place; their pose is the identity
    Pose pose;                           ///< at the start
    Vec3 velocity = Vec3::Zero();        ///< [m/s]
    Vec3 angularVelocity = Vec3::Zero(); ///< [rad/s], world
    double mass = 0;                     ///< [kg]; 0 for walls and for fixed bodies without one
    bool fixed = false;                  ///< immobile; always true for walls
    double elastic = 1;                  ///< restitution; a pair has the smaller of its two
    double friction = 0;                 ///< Coulomb; a pair has the geometric mean
    double rolling = 0;                  ///< rolling resistance, a lever arm [m]; a pair has the larger
    EffectValues values;                 ///< of the other parameters that effects give to bodies
    Vec3 colour = Vec3::Ones();          ///< red, green, blue in 0..1
    std::string label;                   ///< empty where there is none
    DeclarationSource source;

    bool mobile() const { return !fixed; }
};

struct Gravity {
    Vec3 acceleration{0, -9.8, 0};           ///< [m/s²]
    std::optional<DeclarationSource> source; ///< absent: nothing declared it, the reference's default holds
};

struct Spring {
    BodyIndex from = noBody; ///< noBody is the world
    BodyIndex to = noBody;
    Vec3 fromAt = Vec3::Zero(); ///< [m], the body's own frame, or world coordinates for the world
    Vec3 toAt = Vec3::Zero();
    double stiffness = 0;         ///< [N/m]
    double damping = 0;           ///< [N s/m]
    std::optional<double> length; ///< at rest [m]; absent: the distance between its ends at the start
    DeclarationSource source;
};

/// A declaration that an effect brings, such as `air`: only the effect knows what its values are.
struct EffectDeclaration {
    std::string_view name; ///< of the schema's row
    EffectValues values;
    std::optional<DeclarationSource> source; ///< absent in scenes without a text
};

/// What a `simulation` declaration or a command line asks for; what is absent is left to the preset.
struct SimulationSettings {
    std::optional<double> step;        ///< one frame [s]
    std::optional<int> substeps;       ///< equal substeps a frame
    std::optional<std::string> method; ///< names of catalogue rows
    std::optional<std::string> integrator;
    std::optional<std::string> broadphase;
    std::optional<std::string> boxes; ///< that the broad-phase works on
    std::optional<int> iterations;
    std::optional<double> tolerance; ///< relative contact residual
    std::optional<std::string> impacts;
    std::optional<std::string> preset;
    std::optional<double> duration; ///< [s]
    std::optional<int> threads;     ///< command line only
    std::optional<DeclarationSource> source;
};

/// `over` wins wherever it says something.
SimulationSettings overridden(const SimulationSettings& base, const SimulationSettings& over);

/// Bodies whose labels are the same but for the number at their end: `log1`, `log2`, ... are the family
/// `log`.
struct BodyFamily {
    std::string name;
    std::shared_ptr<const std::vector<BodyIndex>> bodies; ///< in the order of the text; null: no family

    explicit operator bool() const { return bodies != nullptr; }
};

/// `log` of `log12`; empty where no number ends the label.
std::string_view familyOf(std::string_view label);

/// What must come out of a run: an `expect` declaration. It watches and never changes the motion.
struct Expectation {
    std::string label;                 ///< empty where there is none
    std::string_view quantity;         ///< a word of quantityWords(); empty where only rest is asked for
    BodyIndex of = noBody;             ///< noBody: the whole scene, or each of its mobile bodies, or ...
    BodyFamily ofEach;                 ///< ... each body of a family
    BodyIndex to = noBody;             ///< of `distance`: the other body
    std::optional<double> at;          ///< one moment [s]
    std::optional<double> from, until; ///< a span [s]; absent: from the start, to the end of the run
    std::optional<double> value;       ///< in the quantity's unit
    std::optional<double> within;      ///< by how much it may be off `value`, in the quantity's unit
    std::optional<double> relative;    ///< the same, of `value`
    std::optional<double> least, most; ///< `min`, `max`, in the quantity's unit
    std::optional<double> drift;       ///< relative change since the beginning of its time
    bool rest = false;                 ///< nothing moves
    int repeat = 1;                    ///< runs of the generated scene, each with the next seed
    std::optional<int> seed;           ///< of the first of them; absent: that of the `generate` declaration
    std::string_view preset;           ///< judged in runs with this preset only; empty: in all
    DeclarationSource source;
};

struct CameraSettings {
    std::optional<Vec3> position;      ///< [m]
    std::optional<Vec3> target;        ///< [m]
    std::optional<double> fieldOfView; ///< vertical [rad]
    std::optional<DeclarationSource> source;
};

/// A `generate` declaration: bodies that a generator makes. The language knows their number as little as it
/// knows the generators; core/simulation puts them in.
struct Generated {
    std::string_view generator; ///< a word of generatorWords()
    std::optional<int> count;   ///< `n`; absent: the generator's default
    int seed = 1;
    Vec3 offset = Vec3::Zero(); ///< by which everything it makes is moved [m]
    BodyFamily bodies;          ///< by the declaration's label: what moves of them, once they are there
    std::optional<DeclarationSource> source;
};

/// A text in quotation marks, and where it stands.
struct QuotedText {
    std::string text; ///< without the marks
    SourceRange place;
};

/// A `sweep` declaration: a study of the scene over ranges of its numbers.
struct SweepRequest {
    std::vector<QuotedText> vary, measures; ///< core/language/sweep_words.h reads them
    bool zip = false;
    std::optional<int> random, seeds, frames;
    std::optional<DeclarationSource> source;
};

struct Scene {
    std::vector<Body> bodies; ///< in the order of the text, walls included; BodyIndex points here
    std::vector<Spring> springs;
    Gravity gravity;
    std::vector<EffectDeclaration> effects; ///< in the order of the text
    SimulationSettings simulation;
    CameraSettings camera;
    std::vector<Expectation> expectations;
    std::optional<Generated> generated;
    std::optional<SweepRequest> sweep;
    std::vector<ParameterSource> parameterSources;

    /// Where a declaration gave a parameter; nothing if it did not.
    const ParameterSource* find(const DeclarationSource& source, std::string_view parameter) const;
    /// The first declaration of an effect's by its name, or none.
    const EffectDeclaration* declared(std::string_view name) const;
    /// The same, made where there is none.
    EffectDeclaration& declare(std::string_view name);
    /// The body that carries a label, or noBody.
    BodyIndex labelled(std::string_view label) const;
    /// Whether a generator made the body: it has no declaration of its own in the text.
    bool isGenerated(BodyIndex body) const;
    /// How messages name a body: "`cue`" by its label, else "sphere 4" by kind and index.
    std::string nameOf(BodyIndex body) const;
};

// The contact law of a pair has of the two coefficients that its bodies declare ...

/// ... the smaller.
inline double pairRestitution(double a, double b) { return std::min(a, b); }
/// ... the geometric mean, positive however small they are.
double pairFriction(double a, double b);
/// ... the larger [m].
inline double pairRolling(double a, double b) { return std::max(a, b); }

} // namespace carom
