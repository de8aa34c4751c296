// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/scenes.h"

#include "core/math/rotation.h"

#include <QTest>

// What the tests of method `contacts` share: bodies with friction, and slopes.

namespace carom::test {

/// Standard gravity of the hard cases [m/s²].
constexpr double gravity = 9.81;
inline Vec3 downwards() { return {0, -gravity, 0}; }

inline Body rough(Body body, double friction, double elastic = 0, double rolling = 0) {
    body.friction = friction;
    body.elastic = elastic;
    body.rolling = rolling;
    return body;
}

inline Body moving(Body body, const Vec3& velocity, const Vec3& angularVelocity = Vec3::Zero()) {
    body.velocity = velocity;
    body.angularVelocity = angularVelocity;
    return body;
}

/// Turned about its centre by a rotation vector [rad].
inline Body turned(Body body, const Vec3& rotation) {
    body.pose.orientation = fromRotationVector(rotation) * body.pose.orientation;
    return body;
}

inline Body floorOf(double friction, double elastic = 0) {
    return rough(wall(Vec3::UnitY(), 0), friction, elastic);
}

/// A plane through the origin that falls towards +x at `angle`.
struct Slope {
    double angle; ///< [rad]

    Vec3 normal() const { return {std::sin(angle), std::cos(angle), 0}; }
    Vec3 down() const { return {std::cos(angle), -std::sin(angle), 0}; }
    /// Turns a body that stands upright so that it stands on the slope.
    Body onIt(Body body, double height) const {
        body.pose.position = height * normal();
        return turned(body, Vec3(0, 0, -angle));
    }
};

/// Rows of a test: it holds with the settings one gets and with the accurate ones.
inline void bothPresets() {
    QTest::addColumn<QByteArray>("preset");
    QTest::newRow("default") << QByteArray("default");
    QTest::newRow("accurate") << QByteArray("accurate");
}

} // namespace carom::test
