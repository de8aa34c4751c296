// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/scene.h"

#include <algorithm>
#include <cmath>

namespace carom {

SimulationSettings overridden(const SimulationSettings& base, const SimulationSettings& over) {
    SimulationSettings result = base;
    const auto take = [](auto& into, const auto& from) {
        if (from) into = from;
    };
    take(result.step, over.step);
    take(result.substeps, over.substeps);
    take(result.method, over.method);
    take(result.integrator, over.integrator);
    take(result.broadphase, over.broadphase);
    take(result.boxes, over.boxes);
    take(result.iterations, over.iterations);
    take(result.tolerance, over.tolerance);
    take(result.impacts, over.impacts);
    take(result.preset, over.preset);
    take(result.duration, over.duration);
    take(result.threads, over.threads);
    return result;
}

const ParameterSource* Scene::find(const DeclarationSource& source, std::string_view parameter) const {
    for (std::uint32_t i = 0; i < source.parameterCount; ++i) {
        const ParameterSource& candidate = parameterSources[source.firstParameter + i];
        if (candidate.parameter == parameter) return &candidate;
    }
    return nullptr;
}

void EffectValues::set(std::string_view parameter, const Vec3& value) {
    const auto place = std::ranges::lower_bound(m_values, parameter, {}, &Value::parameter);
    if (place != m_values.end() && place->parameter == parameter)
        place->value = value;
    else
        m_values.insert(place, {parameter, value});
}

Vec3 EffectValues::vector(std::string_view parameter) const {
    const auto place = std::ranges::find(m_values, parameter, &Value::parameter);
    return place != m_values.end() ? place->value : Vec3(Vec3::Zero());
}

const EffectDeclaration* Scene::declared(std::string_view name) const {
    const auto place = std::ranges::find(effects, name, &EffectDeclaration::name);
    return place != effects.end() ? &*place : nullptr;
}

EffectDeclaration& Scene::declare(std::string_view name) {
    const auto place = std::ranges::find(effects, name, &EffectDeclaration::name);
    return place != effects.end()
               ? *place
               : effects.emplace_back(EffectDeclaration{.name = name, .values = {}, .source = {}});
}

std::string_view familyOf(std::string_view label) {
    const std::size_t last = label.find_last_not_of("0123456789");
    const bool numbered = last != label.npos && last + 1 < label.size();
    return numbered ? label.substr(0, last + 1) : std::string_view();
}

bool Scene::isGenerated(BodyIndex body) const {
    return generated && generated->source &&
           bodies[body].source.declaration == generated->source->declaration;
}

BodyIndex Scene::labelled(std::string_view label) const {
    for (std::size_t i = 0; i < bodies.size(); ++i)
        if (!label.empty() && bodies[i].label == label) return static_cast<BodyIndex>(i);
    return noBody;
}

std::string Scene::nameOf(BodyIndex body) const {
    if (body == noBody) return "the world";
    const Body& named = bodies[body];
    if (!named.label.empty()) return "`" + named.label + "`";
    return std::string(carom::nameOf(kindOf(named.shape))) + " " + std::to_string(body);
}

// The root of the product is exact where both are alike; the product of tiny coefficients underflows.
double pairFriction(double a, double b) {
    const double product = a * b;
    return std::isnormal(product) ? std::sqrt(product) : std::sqrt(a) * std::sqrt(b);
}

} // namespace carom
