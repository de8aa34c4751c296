// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/units.h"

#include "core/base/assert.h"
#include "core/base/catalogue.h"
#include "core/scene/schema.h"

#include <cmath>
#include <span>
#include <string_view>

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

/// What a figure in a unit of the schema is multiplied by: symbols with a space or a dot between them,
/// squared and cubed ones among them, and what stands behind a slash divides.
double factorOf(std::string_view unit, const Units& units) {
    struct Symbol {
        std::string_view name;
        double factor;
    };
    const double force = units.kilogram() * units.metre() / (units.second() * units.second());
    const Symbol symbols[] = {{"kg", units.kilogram()},     {"m", units.metre()},
                              {"s", units.second()},        {"N", force},
                              {"J", force * units.metre()}, {"rad", 1}};
    double factor = 1;
    int power = 1; // of what comes next
    while (!unit.empty()) {
        const auto taken = [&unit](std::string_view start) {
            if (!unit.starts_with(start)) return false;
            unit.remove_prefix(start.size());
            return true;
        };
        if (taken(" ") || taken("·")) continue;
        if (taken("/")) {
            power = -1;
            continue;
        }
        const std::string_view name = unit.substr(0, unit.find_first_of(" /\xC2"));
        const Symbol* symbol = findByName(std::span<const Symbol>(symbols), name);
        ASSERT(symbol != nullptr); // a new one is a line above
        unit.remove_prefix(name.size());
        const int exponent = taken("²") ? 2 : taken("³") ? 3 : 1;
        factor *= std::pow(symbol->factor, power * exponent);
    }
    return factor;
}

void scale(EffectValues& values, std::string_view declaration, const Units& units) {
    for (auto& [parameter, value] : values.all())
        value *= factorOf(findDeclaration(declaration)->find(parameter)->unit, units);
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
        scale(body.values, nameOf(kindOf(body.shape)), units);
    }
    for (Spring& spring : scene.springs) {
        spring.fromAt *= metre;
        spring.toAt *= metre;
        spring.stiffness *= kilogram / (second * second);
        spring.damping *= kilogram / second;
        if (spring.length) spring.length = *spring.length * metre;
    }
    for (EffectDeclaration& effect : scene.effects) scale(effect.values, effect.name, units);
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
