// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/quick_contact.h"
#include "tests/support/scenes.h"

#include "core/math/rotation.h"
#include "core/solvers/contacts/manifolds.h"

namespace carom::test {

inline constexpr double duration = 1.0 / 240;     // of a substep [s]
inline constexpr double margin = 0.05;            // [m]
inline constexpr double roundingOfPlaces = 1e-13; // of lengths of about 1 m

/// Two bodies and the input of their contact. Not to be copied: the input refers to the rest.
struct Two {
    explicit Two(const Body& a, const Body& b, const Vec3& gravity = Vec3::Zero())
        : scene(sceneOf({a, b}, gravity)), bodies(bodiesOf(scene)),
          state(initialStateOf(scene)), input{bodies, state, gravity, duration} {
        manifold.pair = {0, 1};
    }
    Two(const Two&) = delete;

    bool update(double within = margin) { return updateManifold(input, within, manifold); }
    void moveBy(BodyIndex i, const Vec3& shift, const Vec3& turn = Vec3::Zero()) {
        state.pose[i].position += shift;
        state.pose[i].orientation = fromRotationVector(turn) * state.pose[i].orientation;
    }
    Manifold found() const {
        Manifold result;
        const PlacedShape a{&bodies.shape[0], &state.pose[0]}, b{&bodies.shape[1], &state.pose[1]};
        if (haveCores(*a.shape, *b.shape))
            collideQuickly(a, b, (b.pose->position - a.pose->position).normalized(), margin, result);
        else
            collide(a, b, margin, result);
        return result;
    }
    PlacedManifold here() const { return placed(input, manifold); }

    Scene scene;
    Bodies bodies;
    State state;
    ManifoldInput input;
    PersistentManifold manifold;
};

inline Body turnedBy(Body body, const Vec3& rotation) {
    body.pose.orientation = fromRotationVector(rotation) * body.pose.orientation;
    return body;
}

inline Body fixedOne(Body body) {
    body.fixed = true;
    body.mass = 0;
    return body;
}

} // namespace carom::test
