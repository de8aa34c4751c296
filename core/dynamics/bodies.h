// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/index.h"
#include "core/dynamics/force_term.h"
#include "core/dynamics/spring_force.h"
#include "core/math/types.h"
#include "core/scene/scene.h"
#include "core/shapes/shape.h"

#include <cstddef>
#include <cstdint>
#include <utility>
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
        boundingRadius;               ///< [m], of the ball about the centre that holds the body; 0 for walls
    std::vector<std::uint8_t> mobile; ///< 1 where the body can move
    /// 1 where a frictionless impulse can turn the body: mobile and no sphere.
    std::vector<std::uint8_t> turnedByImpacts;

    std::vector<BodyIndex> mobileBodies; ///< ascending
    std::vector<BodyIndex> walls;        ///< ascending
    std::vector<BodyIndex> bounded;      ///< everything that is not a wall, ascending
    /// Mobile bodies whose orientation can change, ascending: those that spin at the start, those that are no
    /// spheres and can be hit (a frictionless impulse passes through a sphere's centre and never turns it),
    /// and those that an effect can turn.
    std::vector<BodyIndex> rotating;

    // What effects contribute (effects/effect.h): without it bodies move uniformly until they meet, and then
    // stay together without friction.
    std::vector<double> elastic;      ///< restitution; a pair has the smaller of its two
    std::vector<double> friction;     ///< Coulomb's coefficient; a pair has the geometric mean
    std::vector<double> rolling;      ///< resistance, a lever arm [m]; a pair has the larger
    Vec3 gravity = Vec3::Zero();      ///< acceleration of whatever can move [m/s²]
    std::vector<SpringForce> springs; ///< those with an end that can move
    Forces forces;                    ///< on single bodies
    bool canComeToRest = false;       ///< something makes energy less: bodies at rest may be left alone

    std::vector<BodyIndex> order;   ///< all bodies, canonically (numbering.h)
    Vec3 origin = Vec3::Zero();     ///< where coordinates had better begin [m] (numbering.h)
    BoxKind boxes = BoxKind::Tight; ///< that the broad-phase works on

    std::size_t count() const { return shape.size(); }
    /// Of a bounded body.
    Aabb boxAt(BodyIndex body, const Pose& pose) const { return boxOf(shape[body], pose, boxes); }
};

/// Without what effects contribute.
Bodies bareBodiesOf(const Scene& scene);

/// Whether a body's orientation can change although no effect turns it: the first part of the rule behind
/// Bodies::rotating.
bool canRotate(const Scene& scene, const Body& body);

/// Whether any two bodies can meet: at least two bodies, one of them mobile.
bool anyCanMeet(const Bodies& bodies);

/// Whether the moments of inertia of a body that can turn differ, so that its angular velocity precesses
/// where nothing acts on it.
bool anyPrecesses(const Bodies& bodies);

/// Mobile bodies for which `turns(body)` holds can rotate, too.
template<class Predicate>
void addRotating(Bodies& bodies, const Predicate& turns) {
    std::vector<BodyIndex> all;
    std::size_t next = 0;
    for (const BodyIndex i : bodies.mobileBodies) {
        const bool already = next < bodies.rotating.size() && bodies.rotating[next] == i;
        if (already) ++next;
        if (already || turns(i)) all.push_back(i);
    }
    bodies.rotating = std::move(all);
}

} // namespace carom
