// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/schema.h"

#include "core/math/rotation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

// The table itself: what each declaration takes, and how each value becomes a part of the Scene. Values that
// arrive here have passed their row's kind and constraint.

namespace carom {
namespace {

constexpr double radiansPerDegree = std::numbers::pi / 180;
constexpr std::array<std::string_view, 2> yesOrNo = {"yes", "no"};

Body& body(Declared& declared) { return std::get<Body>(declared); }
Spring& spring(Declared& declared) { return std::get<Spring>(declared); }
SimulationSettings& simulation(Declared& declared) { return std::get<SimulationSettings>(declared); }
CameraSettings& camera(Declared& declared) { return std::get<CameraSettings>(declared); }

template<class S>
S& shape(Declared& declared) {
    return std::get<S>(body(declared).shape);
}

template<class S>
Declared beginBody() {
    Body begun;
    begun.shape = S{};
    begun.fixed = std::is_same_v<S, Wall>;
    return begun;
}

// A nonzero vector over its own power of two: exact, and its square can neither overflow nor vanish.
Vec3 broughtNearOne(const Vec3& v, int& exponent) {
    std::frexp(v.cwiseAbs().maxCoeff(), &exponent);
    return {std::ldexp(v.x(), -exponent), std::ldexp(v.y(), -exponent), std::ldexp(v.z(), -exponent)};
}

Vec3 directionOf(const Vec3& v) {
    int exponent = 0;
    return broughtNearOne(v, exponent).normalized();
}

// Whole turns are taken off in degrees, where that is exact. An angle beyond the range of doubles gives a
// rotation that is not finite; the validator reports it.
Quat rotationOfDegrees(const Vec3& degrees) {
    if (degrees.isZero(0)) return Quat::Identity();
    int exponent = 0;
    const Vec3 near = broughtNearOne(degrees, exponent);
    const double angle = std::remainder(std::ldexp(near.norm(), exponent), 360.0);
    return fromRotationVector(near.normalized() * (angle * radiansPerDegree));
}

ParameterRow radiusRow(std::string_view help, void (*store)(Declared&, const CheckedValue&)) {
    return {.name = "radius",
            .kind = ValueKind::Number,
            .unit = "m",
            .required = true,
            .example = "1",
            .constraint = Constraint::Positive,
            .help = help,
            .store = store};
}

ParameterRow massRow() {
    return {.name = "mass",
            .kind = ValueKind::Number,
            .unit = "kg",
            .required = true,
            .requiredUnless = "fixed",
            .example = "1",
            .constraint = Constraint::Positive,
            .help = "Mass, spread evenly over the volume; not needed where `fixed` is `yes`.",
            .store = [](Declared& into, const CheckedValue& value) { body(into).mass = value.number; }};
}

ParameterRow centreRow() {
    return {
        .name = "centre",
        .kind = ValueKind::Vector,
        .unit = "m",
        .required = true,
        .example = "0, 0, 0",
        .help = "Where its centre is at the start.",
        .store = [](Declared& into, const CheckedValue& value) { body(into).pose.position = value.vector; }};
}

ParameterRow velRow() {
    return {.name = "vel",
            .kind = ValueKind::Vector,
            .unit = "m/s",
            .defaultText = "0, 0, 0",
            .example = "0, 0, 0",
            .help = "Velocity at the start.",
            .store = [](Declared& into, const CheckedValue& value) { body(into).velocity = value.vector; }};
}

ParameterRow angvelRow(Layer layer) {
    return {.name = "angvel",
            .kind = ValueKind::Vector,
            .unit = "rad/s",
            .defaultText = "0, 0, 0",
            .example = "0, 0, 0",
            .help = "Angular velocity at the start, about the world's axes.",
            .layer = layer,
            .store = [](Declared& into, const CheckedValue& value) {
                body(into).angularVelocity = value.vector;
            }};
}

ParameterRow fixedRow() {
    return {
        .name = "fixed",
        .kind = ValueKind::Word,
        .defaultText = "no",
        .example = "yes",
        .words = yesOrNo,
        .help = "Whether the body stays where it is, whatever hits it.",
        .layer = Layer::Carom,
        .store = [](Declared& into, const CheckedValue& value) { body(into).fixed = value.word == "yes"; }};
}

// What every body has.
void addSurfaceRows(std::vector<ParameterRow>& rows) {
    rows.push_back(
        {.name = "elastic",
         .kind = ValueKind::Number,
         .defaultText = "1",
         .example = "1",
         .constraint = Constraint::NotNegative,
         .help = "Coefficient of restitution; a pair has the smaller of its two.",
         .store = [](Declared& into, const CheckedValue& value) { body(into).elastic = value.number; }});
    rows.push_back(
        {.name = "colour",
         .kind = ValueKind::Colour,
         .defaultText = "1, 1, 1",
         .example = "1, 1, 1",
         .constraint = Constraint::UnitRange,
         .help = "Red, green and blue, each from 0 to 1, or one of the sixteen basic colour names.",
         .store = [](Declared& into, const CheckedValue& value) { body(into).colour = value.vector; }});
    rows.push_back(
        {.name = "friction",
         .kind = ValueKind::Number,
         .defaultText = "0",
         .example = "0.3",
         .constraint = Constraint::NotNegative,
         .help = "Coulomb coefficient of friction; a pair has the geometric mean of its two.",
         .layer = Layer::Carom,
         .store = [](Declared& into, const CheckedValue& value) { body(into).friction = value.number; }});
    rows.push_back(
        {.name = "rolling",
         .kind = ValueKind::Number,
         .unit = "m",
         .defaultText = "0",
         .example = "0.001",
         .constraint = Constraint::NotNegative,
         .help = "Rolling resistance, a lever arm; a pair has the larger of its two.",
         .layer = Layer::Carom,
         .store = [](Declared& into, const CheckedValue& value) { body(into).rolling = value.number; }});
}

DeclarationRow sphereDeclaration() {
    std::vector<ParameterRow> rows = {radiusRow("Distance from the centre to the surface.",
                                                [](Declared& into, const CheckedValue& value) {
                                                    shape<Sphere>(into).radius = value.number;
                                                }),
                                      massRow(), centreRow(), velRow(), angvelRow(Layer::Carom)};
    addSurfaceRows(rows);
    rows.push_back(fixedRow());
    return {.name = "sphere",
            .help = "A solid ball of uniform density.",
            .isBody = true,
            .parameters = std::move(rows),
            .begin = beginBody<Sphere>,
            .example = "sphere { radius 1  mass 1  centre 0, 2, 0 }"};
}

DeclarationRow cylinderDeclaration() {
    std::vector<ParameterRow> rows = {
        radiusRow(
            "Distance from the axis to the round surface.",
            [](Declared& into, const CheckedValue& value) { shape<Cylinder>(into).radius = value.number; }),
        {.name = "height",
         .kind = ValueKind::Number,
         .unit = "m",
         .required = true,
         .example = "1",
         .constraint = Constraint::Positive,
         .help = "Length along the axis, from cap to cap.",
         .store = [](Declared& into,
                     const CheckedValue& value) { shape<Cylinder>(into).halfHeight = 0.5 * value.number; }},
        massRow(),
        centreRow(),
        {.name = "axis",
         .kind = ValueKind::Vector,
         .required = true,
         .example = "0, 1, 0",
         .constraint = Constraint::NonzeroVector,
         .help = "Direction of the axis; its length does not matter.",
         .store =
             [](Declared& into, const CheckedValue& value) {
                 body(into).pose.orientation = shortestRotation(Vec3::UnitY(), directionOf(value.vector));
             }},
        velRow(),
        angvelRow(Layer::Reference)};
    addSurfaceRows(rows);
    rows.push_back(fixedRow());
    return {.name = "cylinder",
            .help = "A solid cylinder of uniform density.",
            .isBody = true,
            .parameters = std::move(rows),
            .begin = beginBody<Cylinder>,
            .example = "cylinder { radius 0.5  height 2  mass 1  centre 0, 2, 0  axis 0, 1, 0 }"};
}

DeclarationRow wallDeclaration() {
    std::vector<ParameterRow> rows = {
        {.name = "normal",
         .kind = ValueKind::Vector,
         .required = true,
         .example = "0, 1, 0",
         .constraint = Constraint::NonzeroVector,
         .help = "Direction away from the solid; its length does not matter.",
         .store = [](Declared& into,
                     const CheckedValue& value) { shape<Wall>(into).normal = directionOf(value.vector); }},
        {.name = "toOrig",
         .kind = ValueKind::Number,
         .unit = "m",
         .required = true,
         .example = "0",
         .help =
             "Signed distance from the wall to the origin along the unit normal: positive where the origin "
             "lies on the side the normal points to.",
         .store = [](Declared& into, const CheckedValue& value) {
             shape<Wall>(into).offset = -value.number;
         }}};
    addSurfaceRows(rows);
    return {.name = "wall",
            .help = "An immobile half-space: everything behind a plane is solid.",
            .isBody = true,
            .parameters = std::move(rows),
            .begin = beginBody<Wall>,
            .example = "wall { normal 0, 1, 0  toOrig 0 }"};
}

DeclarationRow cuboidDeclaration() {
    std::vector<ParameterRow> rows = {
        {.name = "size",
         .kind = ValueKind::Vector,
         .unit = "m",
         .required = true,
         .example = "1, 1, 1",
         .constraint = Constraint::Positive,
         .help = "Lengths of its edges along its own x, y and z.",
         .layer = Layer::Carom,
         .store = [](Declared& into,
                     const CheckedValue& value) { shape<Cuboid>(into).halfSize = 0.5 * value.vector; }},
        massRow(),
        centreRow(),
        {.name = "rotation",
         .kind = ValueKind::Vector,
         .unit = "degrees",
         .defaultText = "0, 0, 0",
         .example = "0, 45, 0",
         .help = "Rotation vector: the axis times the angle in degrees.",
         .layer = Layer::Carom,
         .store =
             [](Declared& into, const CheckedValue& value) {
                 body(into).pose.orientation = rotationOfDegrees(value.vector);
             }},
        velRow(),
        angvelRow(Layer::Carom)};
    addSurfaceRows(rows);
    rows.push_back(fixedRow());
    for (ParameterRow& row : rows) row.layer = Layer::Carom;
    return {.name = "cuboid",
            .help = "A solid box of uniform density.",
            .layer = Layer::Carom,
            .isBody = true,
            .parameters = std::move(rows),
            .begin = beginBody<Cuboid>,
            .example = "cuboid { size 1, 1, 1  mass 1  centre 0, 2, 0  rotation 0, 45, 0 }"};
}

DeclarationRow gravityDeclaration() {
    return {.name = "gravity",
            .help = "The acceleration of free fall; a scene without it has 9.8 m/s² downwards.",
            .layer = Layer::Carom,
            .once = true,
            .parameters = {{.name = "accel",
                            .kind = ValueKind::Vector,
                            .unit = "m/s²",
                            .defaultText = "0, -9.8, 0",
                            .example = "0, -9.8, 0",
                            .help = "Acceleration of everything that can move.",
                            .layer = Layer::Carom,
                            .store =
                                [](Declared& into, const CheckedValue& value) {
                                    std::get<Gravity>(into).acceleration = value.vector;
                                }}},
            .begin = []() -> Declared { return Gravity{}; },
            .example = "gravity { accel 0, -1.62, 0 }"};
}

DeclarationRow springDeclaration() {
    std::vector<ParameterRow> rows = {
        {.name = "from",
         .kind = ValueKind::Label,
         .required = true,
         .example = "world",
         .help = "Label of the body at its first end, or `world`.",
         .store = [](Declared& into, const CheckedValue& value) { spring(into).from = value.body; }},
        {.name = "to",
         .kind = ValueKind::Label,
         .required = true,
         .example = "world",
         .help = "Label of the body at its second end, or `world`.",
         .store = [](Declared& into, const CheckedValue& value) { spring(into).to = value.body; }},
        {.name = "stiffness",
         .kind = ValueKind::Number,
         .unit = "N/m",
         .required = true,
         .example = "100",
         .constraint = Constraint::Positive,
         .help = "Force per length of stretch.",
         .store = [](Declared& into, const CheckedValue& value) { spring(into).stiffness = value.number; }},
        {.name = "damping",
         .kind = ValueKind::Number,
         .unit = "N·s/m",
         .defaultText = "0",
         .example = "1",
         .constraint = Constraint::NotNegative,
         .help = "Force per speed of stretching.",
         .store = [](Declared& into, const CheckedValue& value) { spring(into).damping = value.number; }},
        {.name = "length",
         .kind = ValueKind::Number,
         .unit = "m",
         .defaultText = "the distance between its ends at the start",
         .example = "1",
         .constraint = Constraint::NotNegative,
         .help = "Length at which it neither pulls nor pushes.",
         .store = [](Declared& into, const CheckedValue& value) { spring(into).length = value.number; }},
        {.name = "fromAt",
         .kind = ValueKind::Vector,
         .unit = "m",
         .defaultText = "0, 0, 0",
         .example = "0, 0, 0",
         .help = "Where the first end is attached, in the body's own frame, or in the world's for `world`.",
         .store = [](Declared& into, const CheckedValue& value) { spring(into).fromAt = value.vector; }},
        {.name = "toAt",
         .kind = ValueKind::Vector,
         .unit = "m",
         .defaultText = "0, 0, 0",
         .example = "0, 0, 0",
         .help = "Where the second end is attached, in the body's own frame, or in the world's for `world`.",
         .store = [](Declared& into, const CheckedValue& value) { spring(into).toAt = value.vector; }}};
    for (ParameterRow& row : rows) row.layer = Layer::Carom;
    return {.name = "spring",
            .help = "A straight spring with a damper between two bodies, or a body and the world.",
            .layer = Layer::Carom,
            .parameters = std::move(rows),
            .begin = []() -> Declared { return Spring{}; },
            .example = "sphere bob { radius 0.1  mass 1  centre 0, 1, 0 }\n"
                       "spring { from world  to bob  fromAt 0, 2, 0  stiffness 100 }"};
}

ParameterRow simulationNumber(std::string_view name, std::string_view unit, std::string_view help,
                              void (*store)(Declared&, const CheckedValue&)) {
    return {.name = name,
            .kind = ValueKind::Number,
            .unit = unit,
            .defaultText = "what the preset says",
            .constraint = Constraint::Positive,
            .help = help,
            .store = store};
}

ParameterRow simulationCount(std::string_view name, std::string_view help,
                             void (*store)(Declared&, const CheckedValue&)) {
    return {.name = name,
            .kind = ValueKind::WholeNumber,
            .defaultText = "what the preset says",
            .example = "4",
            .constraint = Constraint::AtLeastOne,
            .help = help,
            .store = store};
}

ParameterRow simulationWord(std::string_view name, std::span<const std::string_view> words,
                            std::string_view help, void (*store)(Declared&, const CheckedValue&)) {
    return {.name = name,
            .kind = ValueKind::Word,
            .defaultText = "what the preset says",
            .example = words.front(),
            .words = words,
            .help = help,
            .store = store};
}

DeclarationRow simulationDeclaration() {
    using D = Declared;
    using V = CheckedValue;
    std::vector<ParameterRow> rows = {
        simulationNumber("step", "s", "Time from one frame to the next.",
                         [](D& into, const V& value) { simulation(into).step = value.number; }),
        simulationCount(
            "substeps", "Equal parts a frame is computed in.",
            [](D& into, const V& value) { simulation(into).substeps = static_cast<int>(value.number); }),
        simulationWord("method", methodWords(), "How collisions are treated.",
                       [](D& into, const V& value) { simulation(into).method = std::string(value.word); }),
        simulationWord(
            "integrator", integratorWords(), "How motion between collisions is computed.",
            [](D& into, const V& value) { simulation(into).integrator = std::string(value.word); }),
        simulationWord(
            "broadphase", broadphaseWords(), "How pairs that may touch are found.",
            [](D& into, const V& value) { simulation(into).broadphase = std::string(value.word); }),
        simulationCount(
            "iterations", "Rounds of the contact solver in a substep.",
            [](D& into, const V& value) { simulation(into).iterations = static_cast<int>(value.number); }),
        simulationNumber("tolerance", "", "Relative residual at which the contact solver stops.",
                         [](D& into, const V& value) { simulation(into).tolerance = value.number; }),
        simulationWord("impacts", impactsWords(),
                       "Whether impacts at one moment follow each other or act as one.",
                       [](D& into, const V& value) { simulation(into).impacts = std::string(value.word); }),
        simulationWord("preset", presetWords(), "Sets whatever is not set here.",
                       [](D& into, const V& value) { simulation(into).preset = std::string(value.word); }),
        simulationNumber("duration", "s", "Time after which the run ends.",
                         [](D& into, const V& value) { simulation(into).duration = value.number; })};
    for (ParameterRow& row : rows) row.layer = Layer::Carom;
    const auto amend = [&rows](std::string_view name, std::string_view defaultText,
                               std::string_view example) {
        for (ParameterRow& row : rows) {
            if (row.name != name) continue;
            row.defaultText = defaultText;
            row.example = example;
        }
    };
    amend("step", "1/60 s: one frame", "0.01");
    amend("tolerance", "what the preset says", "1e-6");
    amend("broadphase", "auto", "auto");
    amend("preset", "default", "accurate");
    amend("duration", "no end", "10");
    return {.name = "simulation",
            .help = "How the scene is simulated.",
            .layer = Layer::Carom,
            .once = true,
            .parameters = std::move(rows),
            .begin = []() -> Declared { return SimulationSettings{}; },
            .example = "simulation { preset accurate  duration 10 }"};
}

DeclarationRow cameraDeclaration() {
    std::vector<ParameterRow> rows = {
        {.name = "position",
         .kind = ValueKind::Vector,
         .unit = "m",
         .defaultText = "where the whole scene is in view",
         .example = "0, 2, 10",
         .help = "Where the camera is.",
         .store = [](Declared& into, const CheckedValue& value) { camera(into).position = value.vector; }},
        {.name = "target",
         .kind = ValueKind::Vector,
         .unit = "m",
         .defaultText = "the middle of the scene",
         .example = "0, 0, 0",
         .help = "The point it looks at.",
         .store = [](Declared& into, const CheckedValue& value) { camera(into).target = value.vector; }},
        {.name = "fov",
         .kind = ValueKind::Number,
         .unit = "degrees",
         .defaultText = "what the window has",
         .example = "45",
         .constraint = Constraint::FieldOfView,
         .help = "Vertical angle of view.",
         .store = [](Declared& into, const CheckedValue& value) {
             camera(into).fieldOfView = value.number * radiansPerDegree;
         }}};
    for (ParameterRow& row : rows) row.layer = Layer::Carom;
    return {.name = "camera",
            .help = "From where the scene is looked at.",
            .layer = Layer::Carom,
            .once = true,
            .parameters = std::move(rows),
            .begin = []() -> Declared { return CameraSettings{}; },
            .example = "camera { position 0, 2, 10  target 0, 0, 0  fov 45 }"};
}

} // namespace

std::span<const DeclarationRow> schema() {
    static const std::array<DeclarationRow, 8> rows = {
        sphereDeclaration(),  cylinderDeclaration(), wallDeclaration(),       cuboidDeclaration(),
        gravityDeclaration(), springDeclaration(),   simulationDeclaration(), cameraDeclaration()};
    return rows;
}

} // namespace carom
