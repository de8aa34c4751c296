// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/quantities.h"

#include "core/narrowphase/narrowphase.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace carom {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

const Bodies& bodiesOf(const Moment& moment) { return moment.pipeline.bodies(); }

Vec3 positionOf(const Moment& moment, BodyIndex i) { return moment.pose[i].position; }
Vec3 velocityOf(const Moment& moment, BodyIndex i) { return moment.velocity[i]; }
Vec3 spinOf(const Moment& moment, BodyIndex i) { return moment.angularVelocity[i]; }
Vec3 momentumOf(const Moment& moment, BodyIndex i) { return bodiesOf(moment).mass[i] * moment.velocity[i]; }

/// About the body's own centre [kg m²/s].
Vec3 angularMomentumOf(const Moment& moment, BodyIndex i) {
    const Pose& pose = moment.pose[i];
    return pose.directionToWorld(
        bodiesOf(moment).inertia[i].cwiseProduct(pose.directionToBody(moment.angularVelocity[i])));
}

/// What other bodies did to this one, springs included: F = m (Δv/Δt − g), the mean over the time since the
/// state before [N]. This is Newton's second law read backwards, so it holds for every method, and for
/// impacts as well as for rest.
Vec3 contactForceOf(const Moment& moment, BodyIndex i) {
    if (moment.velocityBefore.empty() || !(moment.elapsed > 0)) return Vec3::Constant(undefined);
    const Vec3 acceleration = (moment.velocity[i] - moment.velocityBefore[i]) / moment.elapsed;
    const Vec3 gravity = bodiesOf(moment).mobile[i] != 0 ? moment.pipeline.gravity() : Vec3::Zero();
    return bodiesOf(moment).mass[i] * (acceleration - gravity);
}

template<Vec3 (*vector)(const Moment&, BodyIndex), int axis>
double component(const Moment& moment, BodyIndex i) {
    return vector(moment, i)[axis];
}
template<Vec3 (*vector)(const Moment&, BodyIndex)>
double length(const Moment& moment, BodyIndex i) {
    return vector(moment, i).norm();
}

double kineticOf(const Moment& moment, BodyIndex i) {
    return 0.5 * (momentumOf(moment, i).dot(moment.velocity[i]) +
                  angularMomentumOf(moment, i).dot(moment.angularVelocity[i]));
}
double potentialOf(const Moment& moment, BodyIndex i) {
    return -bodiesOf(moment).mass[i] * moment.pipeline.gravity().dot(moment.pose[i].position);
}
double energyOf(const Moment& moment, BodyIndex i) { return kineticOf(moment, i) + potentialOf(moment, i); }

/// The deepest overlap with any other body [m], by the narrow phase.
double penetrationOf(const Moment& moment, BodyIndex i) {
    const Bodies& bodies = bodiesOf(moment);
    const PlacedShape a{&bodies.shape[i], &moment.pose[i]};
    double deepest = 0;
    Manifold manifold;
    for (BodyIndex k = 0; k < bodies.count(); ++k) {
        if (k == i || (bodies.mobile[i] == 0 && bodies.mobile[k] == 0)) continue;
        const bool wall = isWall(bodies.shape[k]);
        const double reach = bodies.boundingRadius[i] + bodies.boundingRadius[k];
        if (isWall(bodies.shape[i]) && wall) continue;
        if (!wall && !isWall(bodies.shape[i]) &&
            (moment.pose[k].position - moment.pose[i].position).norm() > reach)
            continue;
        if (collide(a, {&bodies.shape[k], &moment.pose[k]}, 0, manifold))
            deepest = std::max(deepest, -manifold.deepest().separation);
    }
    return deepest;
}

constexpr std::array bodyRows = {
    QuantityRow{"position x", "m", component<positionOf, 0>},
    QuantityRow{"position y", "m", component<positionOf, 1>},
    QuantityRow{"position z", "m", component<positionOf, 2>},
    QuantityRow{"speed", "m/s", length<velocityOf>},
    QuantityRow{"velocity x", "m/s", component<velocityOf, 0>},
    QuantityRow{"velocity y", "m/s", component<velocityOf, 1>},
    QuantityRow{"velocity z", "m/s", component<velocityOf, 2>},
    QuantityRow{"angular speed", "rad/s", length<spinOf>},
    QuantityRow{"angular velocity x", "rad/s", component<spinOf, 0>},
    QuantityRow{"angular velocity y", "rad/s", component<spinOf, 1>},
    QuantityRow{"angular velocity z", "rad/s", component<spinOf, 2>},
    QuantityRow{"kinetic energy", "J", kineticOf},
    QuantityRow{"potential energy", "J", potentialOf},
    QuantityRow{"energy", "J", energyOf},
    QuantityRow{"momentum x", "kg m/s", component<momentumOf, 0>},
    QuantityRow{"momentum y", "kg m/s", component<momentumOf, 1>},
    QuantityRow{"momentum z", "kg m/s", component<momentumOf, 2>},
    QuantityRow{"angular momentum", "kg m²/s", length<angularMomentumOf>},
    QuantityRow{"penetration", "m", penetrationOf},
    QuantityRow{"contact force", "N", length<contactForceOf>},
    QuantityRow{"contact force x", "N", component<contactForceOf, 0>},
    QuantityRow{"contact force y", "N", component<contactForceOf, 1>},
    QuantityRow{"contact force z", "N", component<contactForceOf, 2>},
};

/// Of everything that moves [m]; undefined where nothing does.
Vec3 centreOfMassOf(const Moment& moment, BodyIndex) {
    Vec3 sum = Vec3::Zero();
    double mass = 0;
    for (const BodyIndex i : bodiesOf(moment).mobileBodies) {
        sum += bodiesOf(moment).mass[i] * moment.pose[i].position;
        mass += bodiesOf(moment).mass[i];
    }
    return mass > 0 ? Vec3(sum / mass) : Vec3::Constant(undefined);
}

Vec3 totalMomentumOf(const Moment& moment, BodyIndex) { return moment.statistics.momentum; }
double totalKineticOf(const Moment& moment, BodyIndex) { return moment.statistics.kinetic; }
double totalPotentialOf(const Moment& moment, BodyIndex) { return moment.statistics.potential; }
double totalEnergyOf(const Moment& moment, BodyIndex) {
    return moment.statistics.kinetic + moment.statistics.potential;
}
double deepestOf(const Moment& moment, BodyIndex) { return moment.statistics.maxPenetration; }
double residualOf(const Moment& moment, BodyIndex) { return moment.statistics.residual; }
double contactsOf(const Moment& moment, BodyIndex) { return static_cast<double>(moment.statistics.contacts); }
double pairsOf(const Moment& moment, BodyIndex) { return static_cast<double>(moment.statistics.broad.pairs); }

template<std::uint64_t WorkCounters::*counter>
double workOf(const Moment& moment, BodyIndex) {
    return static_cast<double>(moment.statistics.work.*counter);
}

template<LedgerAccount account>
double bookedOf(const Moment& moment, BodyIndex) {
    return moment.statistics.ledger[account].energy;
}
double unexplainedOf(const Moment& moment, BodyIndex) { return moment.statistics.unexplained.energy; }

constexpr std::array wholeRows = {
    QuantityRow{"energy", "J", totalEnergyOf},
    QuantityRow{"kinetic energy", "J", totalKineticOf},
    QuantityRow{"potential energy", "J", totalPotentialOf},
    QuantityRow{"momentum", "kg m/s", length<totalMomentumOf>},
    QuantityRow{"momentum x", "kg m/s", component<totalMomentumOf, 0>},
    QuantityRow{"momentum y", "kg m/s", component<totalMomentumOf, 1>},
    QuantityRow{"momentum z", "kg m/s", component<totalMomentumOf, 2>},
    QuantityRow{"centre of mass x", "m", component<centreOfMassOf, 0>},
    QuantityRow{"centre of mass y", "m", component<centreOfMassOf, 1>},
    QuantityRow{"centre of mass z", "m", component<centreOfMassOf, 2>},
    QuantityRow{"deepest penetration", "m", deepestOf},
    QuantityRow{"contact residual", "m/s", residualOf},
    QuantityRow{"contacts", "", contactsOf},
    QuantityRow{"overlapping pairs", "", pairsOf},
    QuantityRow{"pairs collided", "", workOf<&WorkCounters::pairsCollided>},
    QuantityRow{"rows swept", "", workOf<&WorkCounters::rowsSwept>},
    QuantityRow{"factorisations", "", workOf<&WorkCounters::factorisations>},
    QuantityRow{"impacts", "", workOf<&WorkCounters::impacts>},
    QuantityRow{"searches", "", workOf<&WorkCounters::searches>},
    QuantityRow{"islands", "", workOf<&WorkCounters::islands>},
    QuantityRow{"islands unfinished", "", workOf<&WorkCounters::unfinished>},
    QuantityRow{"energy by gravity", "J", bookedOf<LedgerAccount::Gravity>, true},
    QuantityRow{"energy by restitution", "J", bookedOf<LedgerAccount::Restitution>, true},
    QuantityRow{"energy by contact", "J", bookedOf<LedgerAccount::Contact>, true},
    QuantityRow{"energy by friction", "J", bookedOf<LedgerAccount::Friction>, true},
    QuantityRow{"energy by rolling", "J", bookedOf<LedgerAccount::Rolling>, true},
    QuantityRow{"energy by spring", "J", bookedOf<LedgerAccount::Spring>, true},
    QuantityRow{"energy by rotation", "J", bookedOf<LedgerAccount::Rotation>, true},
    QuantityRow{"energy by parting", "J", bookedOf<LedgerAccount::Parting>, true},
    QuantityRow{"energy by rest", "J", bookedOf<LedgerAccount::Rest>, true},
    QuantityRow{"energy unexplained", "J", unexplainedOf, true},
};

} // namespace

Moment momentOf(const Pipeline& pipeline, const State& state, const FrameStatistics& statistics) {
    return {.pipeline = pipeline,
            .pose = state.pose,
            .velocity = state.velocity,
            .angularVelocity = state.angularVelocity,
            .statistics = statistics};
}

Moment momentOf(const Pipeline& pipeline, const Snapshot& snapshot) {
    return {.pipeline = pipeline,
            .pose = snapshot.pose,
            .velocity = snapshot.velocity,
            .angularVelocity = snapshot.angularVelocity,
            .statistics = snapshot.statistics};
}

std::span<const QuantityRow> bodyQuantities() { return bodyRows; }
std::span<const QuantityRow> wholeQuantities() { return wholeRows; }

bool Probes::needLedger() const {
    return std::any_of(m_probes.begin(), m_probes.end(),
                       [](const Probe& probe) { return probe.quantity->booked; });
}

std::vector<double> Probes::measure(const Pipeline& pipeline, const State& state,
                                    const FrameStatistics& statistics) {
    Moment moment = momentOf(pipeline, state, statistics);
    moment.velocityBefore = m_velocityBefore;
    moment.elapsed = state.time - m_timeBefore;
    std::vector<double> figures;
    m_sums.resize(m_probes.size());
    for (std::size_t i = 0; i < m_probes.size(); ++i) {
        const Probe& probe = m_probes[i];
        const bool there = probe.body == noBody || probe.body < pipeline.bodies().count();
        double figure = there ? probe.quantity->measure(moment, probe.body) : undefined;
        if (probe.quantity->booked) figure = m_sums[i] += figure;
        figures.push_back(figure);
    }
    m_velocityBefore = state.velocity;
    m_timeBefore = state.time;
    return figures;
}

} // namespace carom
