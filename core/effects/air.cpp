// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/effects/effect.h"
#include "core/effects/scene_facts.h"
#include "core/scene/schema.h"

#include "core/base/figures.h"
#include "core/dynamics/force_term.h"
#include "core/shapes/shape.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

// Drag of air at high Reynolds numbers (I. Newton, Principia, 1687, book II, section VII; L. Prandtl, 1914,
// for what the coefficient stands for):
//
//     F = −½ ρ C A |u| u      −∂F/∂u = ½ ρ C A (|u| 1 + u uᵀ/|u|), at most ρ C A |u|
//
//     legend   ρ  density of the air [kg/m³]         u  velocity relative to the wind [m/s]
//              C  the body's drag coefficient        A  its area projected along u [m²]
//
// It acts at the centre. Its power F · v is negative without wind; wind may give energy. A body that falls
// from rest has the speed v tanh(g t/v), where v = √(2 m g/(ρ C A)) is its terminal speed. On the way no rate
// is larger than 2 k max(|u|, √(a/k)), with k = ½ ρ C A/m and a the acceleration by other forces: u does not
// outgrow the speed at which drag balances a.

namespace carom {
namespace airEffect {
namespace {

class AirDrag final : public ForceTerm {
  public:
    struct Dragged {
        Shape shape;
        double factor = 0; ///< ½ ρ C [kg/m³]; 0: nothing drags on the body
        double mass = 0;   ///< [kg]
        double area = 0;   ///< the largest [m²]
    };

    AirDrag(const Vec3& wind, std::vector<Dragged> bodies) : m_wind(wind), m_bodies(std::move(bodies)) {}

    LedgerAccount account() const override { return LedgerAccount::Drag; }
    std::string_view parameter() const override { return "drag"; }
    bool actsOn(BodyIndex body) const override { return m_bodies[body].factor > 0; }

    void add(std::span<const ForceSample> samples, std::span<ForceValue> values) const override {
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const Dragged& body = m_bodies[samples[i].body];
            const Vec3 u = samples[i].velocity - m_wind;
            const double speed = u.norm();
            if (body.factor == 0 || speed == 0) continue;
            const Vec3 along = samples[i].pose.directionToBody(u / speed);
            const double strength = body.factor * projectedArea(body.shape, along) * speed;
            values[i].force -= strength * u;
            values[i].slope += 2 * strength;
        }
    }

    void addRates(std::span<const ForceSample> samples, double acceleration,
                  std::span<double> rates) const override {
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const double k = mostPerMass(samples[i].body);
            rates[i] += 2 * std::max(k * (samples[i].velocity - m_wind).norm(), std::sqrt(k * acceleration));
        }
    }

    // It never accelerates a body that is faster than the wind, and others by no more than a body at rest: of
    // u = v − w the part −|u| u · v/|v| is at most |w|².
    SpeedGain gainOf(BodyIndex body) const override {
        return {mostPerMass(body) * m_wind.squaredNorm(), m_wind.norm()};
    }

    double mostForce(BodyIndex body, double speed) const override {
        return m_bodies[body].factor * m_bodies[body].area * std::pow(speed + m_wind.norm(), 2);
    }

    std::shared_ptr<const ForceTerm> renumbered(std::span<const BodyIndex> order,
                                                const Vec3&) const override {
        std::vector<Dragged> bodies;
        for (const BodyIndex i : order) bodies.push_back(m_bodies[i]);
        return std::make_shared<AirDrag>(m_wind, std::move(bodies));
    }

  private:
    /// k with the largest area [1/m].
    double mostPerMass(BodyIndex body) const {
        const Dragged& dragged = m_bodies[body];
        return dragged.factor > 0 ? dragged.factor * dragged.area / dragged.mass : 0;
    }

    Vec3 m_wind; // [m/s]
    std::vector<Dragged> m_bodies;
};

double dragOf(const Body& body) { return body.values.number("drag"); }

bool isDragged(const Body& body) { return body.mobile() && !isWall(body.shape) && dragOf(body) > 0; }

/// All 0 where none is declared.
EffectDeclaration airOf(const Scene& scene) {
    const EffectDeclaration* declared = scene.declared("air");
    return declared != nullptr ? *declared : EffectDeclaration{.name = "air", .values = {}, .source = {}};
}

EffectDecision decide(const Scene& scene, const RunFacts& run) {
    EffectDecision decision{.effect = "air"};
    const EffectDeclaration air = airOf(scene);
    const double density = air.values.number("density");
    if (air.source) decision.source = placeOf(scene, *air.source, "density");
    const auto dragged = std::find_if(scene.bodies.begin(), scene.bodies.end(), isDragged);
    if (!air.source && !(density > 0)) {
        decision.reason = Sentence{"none is declared"};
    } else if (!(density > 0)) {
        decision.reason = Sentence{"its density is 0"};
    } else if (dragged == scene.bodies.end()) {
        decision.reason = Sentence{"nothing that can move has `drag`"};
    } else {
        decision.status = run.method.bentPaths ? EffectStatus::On : EffectStatus::NotSimulatedYet;
        decision.reason =
            Sentence{"air of %1 kg/m³ slows %2, which has drag %3",
                     {figure(density), scene.nameOf(indexOf(scene, *dragged)), figure(dragOf(*dragged))}};
        if (!run.method.bentPaths) {
            decision.reason.add(Sentence{"it moves as in a vacuum"});
            decision.unmet.push_back(decision.source.value_or(SourceRange{}));
        }
    }
    return decision;
}

void contribute(const Scene& scene, Bodies& bodies) {
    const EffectValues air = airOf(scene).values;
    const double density = air.number("density");
    std::vector<AirDrag::Dragged> dragged;
    dragged.reserve(scene.bodies.size());
    for (const Body& body : scene.bodies) {
        const bool drags = isDragged(body);
        dragged.push_back({body.shape, drags ? 0.5 * density * dragOf(body) : 0, body.mass,
                           drags ? largestProjectedArea(body.shape) : 0});
    }
    bodies.forces.addTerm(std::make_shared<AirDrag>(air.vector("wind"), std::move(dragged)), bodies.count());
}

std::optional<double> gives(const Scene& scene) {
    const EffectValues air = airOf(scene).values;
    const bool pushes = air.number("density") > 0 && air.vector("wind") != Vec3::Zero() &&
                        std::ranges::any_of(scene.bodies, isDragged);
    return pushes ? std::nullopt : std::optional<double>(0);
}

std::optional<Cause> damps(const Scene& scene) {
    const auto dragged = std::ranges::find_if(scene.bodies, isDragged);
    if (!(airOf(scene).values.number("density") > 0) || dragged == scene.bodies.end()) return std::nullopt;
    return Cause{
        Sentence{"air slows %1, so bodies can come to rest", {scene.nameOf(indexOf(scene, *dragged))}},
        placeOf(scene, dragged->source, "drag")};
}

void hint(const Scene& scene, std::vector<Diagnostic>& hints) {
    const bool hasAir = airOf(scene).source.has_value();
    std::size_t count = 0;
    for (BodyIndex i = 0; i < scene.bodies.size() && count < mostHintsOfAKind; ++i) {
        const Body& body = scene.bodies[i];
        const ParameterSource* given = scene.find(body.source, "drag");
        if (given == nullptr || !(dragOf(body) > 0) || (body.mobile() && hasAir)) continue;
        ++count;
        hints.push_back(noEffectHint(
            given->value,
            body.mobile()
                ? "`drag` has no effect: the scene has no air; declare it with `air { "
                  "density 1.2 }`"
                : "`drag` has no effect: " + scene.nameOf(i) + " is fixed; only what is not fixed moves"));
    }
}

} // namespace
} // namespace airEffect

EffectWords airWords() {
    DeclarationRow air = {.name = "air",
                          .help =
                              "Air that drags on bodies by their `drag`; a scene without it is in a vacuum.",
                          .layer = Layer::Carom,
                          .once = true,
                          .parameters = {{.name = "density",
                                          .kind = ValueKind::Number,
                                          .unit = "kg/m³",
                                          .required = true,
                                          .example = "1.2",
                                          .constraint = Constraint::NotNegative,
                                          .help = "Mass per volume; 1.2 near the ground.",
                                          .layer = Layer::Carom},
                                         {.name = "wind",
                                          .kind = ValueKind::Vector,
                                          .unit = "m/s",
                                          .defaultText = "0, 0, 0",
                                          .example = "0, 0, 0",
                                          .help = "Velocity of the air.",
                                          .layer = Layer::Carom}},
                          .example = "air { density 1.2  wind 3, 0, 0 }"};
    ParameterRow drag = {.name = "drag",
                         .kind = ValueKind::Number,
                         .defaultText = "0",
                         .example = "0.47",
                         .constraint = Constraint::NotNegative,
                         .help = "Drag coefficient in `air`: 0.47 for a smooth ball, about 1 for a box.",
                         .layer = Layer::Carom,
                         .ofMoving = true,
                         .title = "drag coefficient",
                         .typical = 2}; // of blunt bodies
    return {.declarations = {air}, .ofBodies = {drag}};
}

extern const EffectRow airRow;
constinit const EffectRow airRow = {
    .name = "air",
    .title = "Air drag",
    .help = "Air slows bodies by the square of their speed, and wind carries them along.",
    .decide = airEffect::decide,
    .unmetMessage = "air drag is not simulated yet; bodies move as in a vacuum",
    .exactObjection = "air slows bodies between events",
    .contribute = airEffect::contribute,
    .gives = airEffect::gives,
    .damps = airEffect::damps,
    .hint = airEffect::hint,
};

} // namespace carom
