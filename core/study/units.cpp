// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/units.h"

namespace carom {
namespace {

Shape scaled(const Shape& shape, double metre) {
    struct Scale {
        double metre;
        Shape operator()(Sphere sphere) const { return Sphere{sphere.radius * metre}; }
        Shape operator()(Wall wall) const { return Wall{wall.normal, wall.offset * metre}; }
        Shape operator()(Cylinder cylinder) const {
            return Cylinder{cylinder.radius * metre, cylinder.halfHeight * metre};
        }
        Shape operator()(Cuboid cuboid) const { return Cuboid{cuboid.halfSize * metre}; }
    };
    return std::visit(Scale{metre}, shape);
}

} // namespace

Scene scaled(Scene scene, const Units& units) {
    const double metre = units.metre(), second = units.second(), kilogram = units.kilogram();
    for (Body& body : scene.bodies) {
        body.shape = scaled(body.shape, metre);
        body.pose.position *= metre;
        body.velocity *= metre / second;
        body.angularVelocity /= second;
        body.mass *= kilogram;
        body.rolling *= metre;
    }
    for (Spring& spring : scene.springs) {
        spring.fromAt *= metre;
        spring.toAt *= metre;
        spring.stiffness *= kilogram / (second * second);
        spring.damping *= kilogram / second;
        if (spring.length) spring.length = *spring.length * metre;
    }
    scene.air.density *= kilogram / (metre * metre * metre);
    scene.air.wind *= metre / second;
    return scene;
}

Scene moved(Scene scene, const Vec3& by) {
    for (Body& body : scene.bodies) {
        if (Wall* wall = std::get_if<Wall>(&body.shape))
            wall->offset += wall->normal.dot(by);
        else
            body.pose.position += by;
    }
    for (Spring& spring : scene.springs) {
        if (spring.from == noBody) spring.fromAt += by;
        if (spring.to == noBody) spring.toAt += by;
    }
    return scene;
}

} // namespace carom
