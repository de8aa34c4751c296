// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/schema_rows.h"

#include "core/math/rotation.h"

#include <array>
#include <cmath>
#include <numbers>
#include <type_traits>
#include <utility>

// The four bodies: what each takes, and how each value becomes a part of a Body. Values that arrive here have
// passed their row's kind and constraint.

namespace carom {
namespace {

constexpr double radiansPerDegree = std::numbers::pi / 180;

Body& body(Declared& declared) { return std::get<Body>(declared); }

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
        .words = yesOrNoWords(),
        .help = "Whether the body stays where it is, whatever hits it.",
        .layer = Layer::Carom,
        .store = [](Declared& into, const CheckedValue& value) { body(into).fixed = value.word == "yes"; }};
}

// What effects give to bodies, and the colour.
void addSurfaceRows(std::vector<ParameterRow>& rows, bool moving) {
    for (const EffectWords& words : effectWords())
        for (const ParameterRow& row : words.ofBodies)
            if (moving || !row.ofMoving) rows.push_back(row);
    rows.push_back(
        {.name = "colour",
         .kind = ValueKind::Colour,
         .defaultText = "1, 1, 1",
         .example = "1, 1, 1",
         .constraint = Constraint::UnitRange,
         .help = "Red, green and blue, each from 0 to 1, or one of the sixteen basic colour names.",
         .store = [](Declared& into, const CheckedValue& value) { body(into).colour = value.vector; }});
}

} // namespace

DeclarationRow sphereDeclaration() {
    std::vector<ParameterRow> rows = {radiusRow("Distance from the centre to the surface.",
                                                [](Declared& into, const CheckedValue& value) {
                                                    shape<Sphere>(into).radius = value.number;
                                                }),
                                      massRow(), centreRow(), velRow(), angvelRow(Layer::Carom)};
    addSurfaceRows(rows, true);
    rows.push_back(fixedRow());
    return {.name = Sphere::name,
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
    addSurfaceRows(rows, true);
    rows.push_back(fixedRow());
    return {.name = Cylinder::name,
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
    addSurfaceRows(rows, false);
    return {.name = Wall::name,
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
    addSurfaceRows(rows, true);
    rows.push_back(fixedRow());
    for (ParameterRow& row : rows) row.layer = Layer::Carom;
    return {.name = Cuboid::name,
            .help = "A solid box of uniform density.",
            .layer = Layer::Carom,
            .isBody = true,
            .parameters = std::move(rows),
            .begin = beginBody<Cuboid>,
            .example = "cuboid { size 1, 1, 1  mass 1  centre 0, 2, 0  rotation 0, 45, 0 }"};
}

} // namespace carom
