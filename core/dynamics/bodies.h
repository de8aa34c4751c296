// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/index.h"
#include "core/dynamics/force_term.h"
#include "core/dynamics/spring_force.h"
#include "core/math/types.h"
#include "core/scene/scene.h"
#include "core/shapes/shape.h"

#include <cstdint>
#include <vector>

namespace carom {

/// What integration does not change, one array a quantity, indexed by BodyIndex; walls have their entries
/// too.
struct Bodies {
    std::vector<Shape> shape;
    std::vector<double> mass;         ///< [kg], 0 for immobile bodies
    std::vector<double> inverseMass;  ///< [1/kg], 0 for immobile bodies
    std::vector<Vec3> inertia;        ///< principal, body axes [kg m²], 0 for immobile bodies
    std::vector<Vec3> inverseInertia; ///< [1/(kg m²)], 0 for immobile bodies
    std::vector<double>
        boundingRadius; ///< [m], of the ball about the centre that holds the body; 0 for walls
    std::vector<double> elastic, friction, rolling;
    std::vector<std::uint8_t> mobile; ///< 1 where the body can move
    /// 1 where a frictionless impulse can turn the body: mobile and no sphere.
    std::vector<std::uint8_t> turnedByImpacts;

    std::vector<BodyIndex> mobileBodies; ///< ascending
    std::vector<BodyIndex> walls;        ///< ascending
    std::vector<BodyIndex> bounded;      ///< everything that is not a wall, ascending
    /// Mobile bodies whose orientation can change, ascending: those that spin at the start, those that are no
    /// spheres and can be hit, and those that a spring pulls beside their centre. A frictionless impulse
    /// passes through a sphere's centre and never turns it; friction may, so where two bodies that can meet
    /// have some, all that have some are here too; and so may rolling resistance, of which a pair has the
    /// larger: with one body that has some, all are.
    std::vector<BodyIndex> rotating;

    // What effects contribute (effects/effect.h): without it bodies move uniformly until they meet.
    Vec3 gravity = Vec3::Zero();      ///< acceleration of whatever can move [m/s²]
    std::vector<SpringForce> springs; ///< those with an end that can move
    Forces forces;                    ///< on single bodies

    std::vector<BodyIndex> order;   ///< all bodies, canonically (numbering.h)
    Vec3 origin = Vec3::Zero();     ///< where coordinates had better begin [m] (numbering.h)
    BoxKind boxes = BoxKind::Tight; ///< that the broad-phase works on

    std::size_t count() const { return shape.size(); }
    /// Of a bounded body.
    Aabb boxAt(BodyIndex body, const Pose& pose) const { return boxOf(shape[body], pose, boxes); }
};

/// Without what effects contribute.
Bodies bodiesOf(const Scene& scene);

/// Whether a body's orientation can change without springs, friction and rolling resistance: the first part
/// of the rule behind Bodies::rotating.
bool canRotate(const Scene& scene, const Body& body);

} // namespace carom
