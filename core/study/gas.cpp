// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/gas.h"

#include "core/study/references.h"

#include "core/dynamics/energy.h"
#include "core/effects/effect.h"
#include "core/simulation/method_choice.h"
#include "core/solvers/events/event_gas.h"

#include "core/math/distributions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace carom {

double theory::packingOf(double density, double diameter) {
    return std::numbers::pi / 6 * density * diameter * diameter * diameter;
}

double theory::compressibilityOf(double packing) {
    return reference::hardSphereCompressibility(6 / std::numbers::pi * packing);
}

double theory::freeTimeOf(double density, double diameter, double mass, double temperature) {
    const double packing = packingOf(density, diameter), left = 1 - packing;
    const double atContact = (1 - packing / 2) / (left * left * left);
    return 1 /
           (4 * std::sqrt(std::numbers::pi * temperature / mass) * density * diameter * diameter * atContact);
}

std::optional<GasObjection> gasObjection(const Pipeline& pipeline) {
    const Scene& scene = pipeline.scene();
    if (const std::optional<SolverObjection> objection = objectionTo(*findSolver("events"), scene))
        return GasObjection{objection->reason.text(), objection->place};
    if (const std::optional<Cause> damping = firstDamping(scene))
        return GasObjection{damping->reason.text() + "; a gas that loses energy cools and has no temperature",
                            damping->source.value_or(SourceRange{})};
    if (pipeline.gravity().isZero(0) &&
        std::none_of(scene.bodies.begin(), scene.bodies.end(),
                     [](const Body& body) { return body.mobile() && !body.velocity.isZero(0); }))
        return GasObjection{"nothing moves: a gas at rest has no temperature", {}};
    if (pipeline.bodies().mobileBodies.size() < 2)
        return GasObjection{"a gas needs at least two mobile spheres", {}};
    return std::nullopt;
}

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// Means of batches, for their mean and its uncertainty.
class Batches {
  public:
    void add(double value) { m_values.push_back(value); }
    const std::vector<double>& values() const { return m_values; }
    GasEstimate estimate(double theory) const {
        const double count = static_cast<double>(m_values.size());
        double sum = 0, squares = 0;
        for (const double value : m_values) sum += value;
        for (const double value : m_values) squares += (value - sum / count) * (value - sum / count);
        GasEstimate estimate{sum / count, nothing, theory};
        if (count > 1)
            estimate.uncertainty = studentFactor(count - 1) * std::sqrt(squares / (count * (count - 1)));
        return estimate;
    }

  private:
    std::vector<double> m_values;
};

/// Where centres can be, as far as walls along the axes bound it; infinite elsewhere.
struct Region {
    Aabb centres{Vec3::Constant(-never), Vec3::Constant(never)};
    bool onlyUpright = true; ///< no wall is slanted

    bool isClosed() const { return onlyUpright && centres.size().allFinite(); }
};

class Experiment {
  public:
    Experiment(const Pipeline& pipeline, const GasPlan& plan, const GasListener& goOn)
        : m_pipeline(pipeline), m_bodies(pipeline.bodies()), m_plan(plan), m_goOn(goOn),
          m_state(pipeline.initialState()), m_gas(m_bodies, m_state, pipeline.gravity()) {}

    GasStudy run(const std::function<void(const GasStudy&)>& measured);

  private:
    // Samples of positions and velocities in a batch: more are correlated, half as many lose accuracy.
    static constexpr int samplesPerBatch = 50;
    // Bins of the histograms: with twice as many each has half the balls, and 1.4 times the deviation.
    static constexpr std::size_t speedBins = 40, heightBins = 12;
    static constexpr double fastest = 5; // of the histogram, in √(kT/m): 1.5e-5 are faster, at half 10 %

    void lookAtScene();
    void measureRegion();
    void chooseInnerBox();
    bool liveThrough(double collisionsPerBall);
    bool measureBatch(double seconds);
    void sample();
    void closeBatch(double seconds, const ImpulseTally& before);
    GasStudy judged();
    void judgeSpeeds();
    void judgeHeights();
    void chooseTemperature();
    void layHeights();
    double energy() const;
    double heightOf(BodyIndex i) const { return m_up.dot(m_state.pose[i].position) - m_floor; }
    bool keepOn() const {
        return m_goOn(static_cast<std::int64_t>(m_gas.counts().collisions), m_collisionsInAll);
    }

    const Pipeline& m_pipeline;
    const Bodies& m_bodies;
    GasPlan m_plan;
    const GasListener& m_goOn;
    State m_state;
    EventGas m_gas;
    GasStudy m_study;
    double m_initialEnergy = 0; ///< [J]
    Region m_region;
    std::optional<Aabb> m_inner;
    Vec3 m_up = Vec3::Zero(); ///< zero without gravity
    double m_floor = -never;  ///< the lowest place of a centre along it [m]
    double m_lid = never;     ///< the highest
    double m_time = 0;
    double m_interval = 0; ///< about a quarter of the time between collisions of a ball [s]
    std::int64_t m_collisionsInAll = 1;

    std::array<double, speedBins + 1> m_speedCounts{}; ///< the last: faster
    double m_samples = 0;                              ///< in the batch, then in all
    double m_insideSum = 0;                            ///< centres in the inner box, over the batch's samples
    Batches m_virial, m_walls, m_freeTime;
    double m_density = 0; ///< n, sum over batches [1/m³]
    std::array<double, heightBins> m_heightCounts{};
    std::array<Batches, heightBins> m_heightTemperatures;
    std::array<double, heightBins> m_heightEnergy{}, m_heightBalls{}; ///< of the batch
};

void Experiment::lookAtScene() {
    double least = never, most = 0, lightest = never, heaviest = 0;
    for (const BodyIndex i : m_bodies.mobileBodies) {
        const double radius = std::get<Sphere>(m_bodies.shape[i]).radius, mass = m_bodies.mass[i];
        m_study.diameter += 2 * radius;
        m_study.mass += mass;
        least = std::min(least, radius), most = std::max(most, radius);
        lightest = std::min(lightest, mass), heaviest = std::max(heaviest, mass);
    }
    m_study.balls = m_bodies.mobileBodies.size();
    m_study.diameter /= static_cast<double>(m_study.balls);
    m_study.mass /= static_cast<double>(m_study.balls);
    m_study.alike = least == most && lightest == heaviest;
    if (!m_study.alike)
        m_study.remarks.push_back(
            "the balls differ in radius or mass: pressure and free time have no simple theory");
}

void Experiment::measureRegion() {
    for (const BodyIndex i : m_bodies.walls) {
        const Wall& wall = std::get<Wall>(m_bodies.shape[i]);
        Eigen::Index axis = 0;
        if (wall.normal.cwiseAbs().maxCoeff(&axis) < 1 - 1e-12) {
            m_region.onlyUpright = false;
        } else if (wall.normal[axis] > 0) {
            double& lower = m_region.centres.lower[axis];
            lower = std::max(lower, wall.offset + m_study.diameter / 2);
        } else {
            double& upper = m_region.centres.upper[axis];
            upper = std::min(upper, -wall.offset - m_study.diameter / 2);
        }
    }
    const Vec3 gravity = m_pipeline.gravity();
    if (gravity.isZero(0)) return;
    m_up = -gravity.normalized();
    for (const BodyIndex i : m_bodies.walls) {
        const Wall& wall = std::get<Wall>(m_bodies.shape[i]);
        const double facing = wall.normal.dot(m_up);
        if (facing > 1 - 1e-12) m_floor = std::max(m_floor, wall.offset + m_study.diameter / 2);
        if (facing < -1 + 1e-12) m_lid = std::min(m_lid, -wall.offset - m_study.diameter / 2);
    }
}

// Three diameters from the walls the density has come within a thousandth of the bulk's at moderate packing;
// a small box must do with less.
void Experiment::chooseInnerBox() {
    // Diameters, and part of the box. At half, the density near the walls is averaged in; at twice, fewer
    // balls are counted, and in a small box none.
    constexpr double reach = 3, shareAtMost = 0.25;
    if (!m_region.isClosed() || !m_up.isZero(0)) {
        m_study.remarks.push_back(m_up.isZero(0) ? "no closed box of upright walls: no pressure"
                                                 : "gravity: the pressure differs from height to height");
        return;
    }
    const Vec3 size = m_region.centres.size();
    const Vec3 margin = (shareAtMost * size).cwiseMin(reach * m_study.diameter);
    m_inner = Aabb{m_region.centres.lower + margin, m_region.centres.upper - margin};
    if (margin.minCoeff() < reach * m_study.diameter)
        m_study.remarks.push_back("the box is less than twelve diameters wide: walls disturb the pressure");
    m_gas.watch(*m_inner);
}

double Experiment::energy() const {
    const Invariants invariants = invariantsOf(m_bodies, m_state, m_pipeline.gravity());
    return invariants.kinetic + invariants.potential;
}

// Energy never changes, so the temperature at equilibrium is known before it is reached: 3/2 kT a ball
// without gravity; with it 3/2 kT + m g h, where h is the mean height of the barometric formula between floor
// and lid.
void Experiment::chooseTemperature() {
    const double balls = static_cast<double>(m_study.balls);
    if (m_up.isZero(0)) {
        m_study.temperature = 2 * energy() / (3 * balls);
        return;
    }
    const double weight = m_study.mass * m_pipeline.gravity().norm();
    const double each = energy() / balls - weight * m_floor;
    const double lid = m_lid - m_floor;
    const auto meanEnergy = [&](double kT) {
        const double lost = lid < never ? weight * lid / std::expm1(weight * lid / kT) : 0;
        return 2.5 * kT - lost;
    };
    double low = 0, high = each;
    for (int k = 0; k < 200; ++k) {
        const double middle = 0.5 * (low + high);
        (meanEnergy(middle) < each ? low : high) = middle;
    }
    m_study.temperature = 0.5 * (low + high);
}

// Layers that hold equally many balls each, by the barometric formula.
void Experiment::layHeights() {
    if (m_up.isZero(0) || !m_study.alike) return;
    if (!(m_floor > -never)) {
        m_study.remarks.push_back("no level floor: no heights");
        return;
    }
    const double scale = m_study.temperature / (m_study.mass * m_pipeline.gravity().norm());
    const double share = -std::expm1(-(m_lid - m_floor) / scale);
    const auto edgeAt = [&](std::size_t k) {
        return -scale * std::log1p(-share * static_cast<double>(k) / heightBins);
    };
    for (std::size_t k = 0; k < heightBins; ++k)
        m_study.heights.push_back({.from = edgeAt(k),
                                   .to = k + 1 < heightBins ? edgeAt(k + 1) : m_lid - m_floor,
                                   .balls = 0,
                                   .theory = static_cast<double>(m_study.balls) / heightBins,
                                   .temperature = {}});
}

bool Experiment::liveThrough(double collisionsPerBall) {
    const double balls = static_cast<double>(m_study.balls);
    const std::uint64_t target = static_cast<std::uint64_t>(collisionsPerBall * balls / 2);
    // A scene in which nothing meets would go on for ever: given up after so many times the expected time. At
    // a hundredth, gases of few collisions would be given up.
    constexpr double mostIntervals = 1000;
    const double giveUp = m_time + mostIntervals * (collisionsPerBall + 1) * 4 * m_interval;
    while (m_gas.counts().collisions < target) {
        if (!keepOn()) return false;
        if (m_time > giveUp) {
            m_study.remarks.push_back("the balls hardly meet: the gas does not settle");
            return false;
        }
        m_time += m_interval;
        if (m_gas.advanceTo(m_time)) return false;
    }
    return true;
}

void Experiment::sample() {
    m_gas.write(m_state);
    ++m_samples;
    const double unit = std::sqrt(m_study.temperature);
    for (const BodyIndex i : m_bodies.mobileBodies) {
        const double speed = m_state.velocity[i].norm() * std::sqrt(m_bodies.mass[i]) / unit;
        const std::size_t bin = static_cast<std::size_t>(std::min(speed / fastest, 1.0) * speedBins);
        ++m_speedCounts[bin];
        const Vec3& place = m_state.pose[i].position;
        if (m_inner && contains(*m_inner, {place, place})) ++m_insideSum;
        if (m_study.heights.empty() || m_up.isZero(0)) continue;
        for (std::size_t k = 0; k < heightBins; ++k) {
            const HeightBin& layer = m_study.heights[k];
            const double height = heightOf(i);
            if (height < layer.from || height >= layer.to) continue;
            ++m_heightBalls[k];
            m_heightEnergy[k] += m_bodies.mass[i] * m_state.velocity[i].squaredNorm() / 3;
        }
    }
}

bool Experiment::measureBatch(double seconds) {
    const ImpulseTally before = m_gas.tally();
    const std::uint64_t collisionsBefore = m_gas.counts().collisions;
    m_insideSum = 0;
    m_samples = 0;
    m_heightBalls.fill(0);
    m_heightEnergy.fill(0);
    for (int k = 0; k < samplesPerBatch; ++k) {
        if (!keepOn()) return false;
        m_time += seconds / samplesPerBatch;
        if (m_gas.advanceTo(m_time)) return false;
        sample();
    }
    m_study.collisions += m_gas.counts().collisions - collisionsBefore;
    m_study.simulated += seconds;
    ++m_study.batches;
    closeBatch(seconds, before);
    return true;
}

void Experiment::closeBatch(double seconds, const ImpulseTally& before) {
    const ImpulseTally& after = m_gas.tally();
    const double kT = m_study.temperature;
    if (m_inner && m_insideSum > 0) {
        const double inside = m_insideSum / m_samples;
        const Vec3 size = m_inner->size();
        const double density = inside / size.prod();
        m_density += density;
        m_virial.add(1 + (after.virial - before.virial) / (3 * inside * kT * seconds));
        double pressure = 0;
        for (std::size_t w = 0; w < m_bodies.walls.size(); ++w) {
            Eigen::Index axis = 0;
            std::get<Wall>(m_bodies.shape[m_bodies.walls[w]]).normal.cwiseAbs().maxCoeff(&axis);
            pressure += (after.walls[w] - before.walls[w]) * size[axis] / (size.prod() * seconds);
        }
        m_walls.add(pressure / static_cast<double>(m_bodies.walls.size()) / (density * kT));
        const double met = static_cast<double>(after.collisions - before.collisions);
        if (met > 0) m_freeTime.add(inside * seconds / (2 * met));
    }
    for (std::size_t k = 0; k < m_study.heights.size(); ++k) {
        m_heightCounts[k] += m_heightBalls[k] / m_samples;
        if (m_heightBalls[k] > 0) m_heightTemperatures[k].add(m_heightEnergy[k] / m_heightBalls[k] / kT);
    }
}

// The sample is of one moment: speeds at different moments are those of the same balls.
void Experiment::judgeSpeeds() {
    std::vector<double> speeds;
    for (const BodyIndex i : m_bodies.mobileBodies)
        speeds.push_back(m_state.velocity[i].norm() * std::sqrt(m_bodies.mass[i] / m_study.temperature));
    std::sort(speeds.begin(), speeds.end());
    m_study.speedDistance = kolmogorovDistance(speeds, maxwellShare);
    m_study.speedProbability = kolmogorovTail(m_study.speedDistance, speeds.size());
    double total = 0;
    for (const double count : m_speedCounts) total += count;
    const double width = fastest / speedBins;
    for (std::size_t k = 0; k < speedBins && total > 0; ++k) {
        const double from = width * static_cast<double>(k), to = from + width;
        m_study.speeds.push_back(
            {from, to, m_speedCounts[k] / (total * width), (maxwellShare(to) - maxwellShare(from)) / width});
    }
}

void Experiment::judgeHeights() {
    if (m_study.heights.empty() || m_study.batches == 0) return;
    for (std::size_t k = 0; k < heightBins; ++k) {
        m_study.heights[k].balls = m_heightCounts[k] / m_study.batches;
        m_study.heights[k].temperature = m_heightTemperatures[k].estimate(1);
    }
    // Of one moment, so that each ball counts once.
    std::array<double, heightBins> counts{};
    for (const BodyIndex i : m_bodies.mobileBodies)
        for (std::size_t k = 0; k < heightBins; ++k)
            if (heightOf(i) >= m_study.heights[k].from && heightOf(i) < m_study.heights[k].to) ++counts[k];
    m_study.heightChiSquare = 0;
    for (std::size_t k = 0; k < heightBins; ++k) {
        const double expected = m_study.heights[k].theory;
        m_study.heightChiSquare += (counts[k] - expected) * (counts[k] - expected) / expected;
    }
    m_study.heightDegrees = static_cast<int>(heightBins) - 1;
    m_study.heightProbability = chiSquareTail(m_study.heightChiSquare, m_study.heightDegrees);
}

GasStudy Experiment::run(const std::function<void(const GasStudy&)>& measured) {
    lookAtScene();
    measureRegion();
    chooseInnerBox();
    chooseTemperature();
    layHeights();
    m_initialEnergy = energy();

    // A first guess at the time between collisions, from the space the balls take up now.
    Aabb region{m_state.pose[m_bodies.mobileBodies.front()].position,
                m_state.pose[m_bodies.mobileBodies.front()].position};
    for (const BodyIndex i : m_bodies.mobileBodies)
        region = united(region, {m_state.pose[i].position, m_state.pose[i].position});
    const double volume = (region.size().array() + m_study.diameter).prod();
    const double density = static_cast<double>(m_study.balls) / volume;
    m_study.packing = theory::packingOf(density, m_study.diameter);
    m_interval = theory::freeTimeOf(density, m_study.diameter, m_study.mass, m_study.temperature) / 4;
    m_collisionsInAll = static_cast<std::int64_t>((m_plan.settling + m_plan.measuring) *
                                                  static_cast<double>(m_study.balls) / 2) +
                        1;

    bool goesOn = liveThrough(m_plan.settling);
    const double perCollision = m_time / std::max(m_plan.settling, 1.0);
    for (int batch = 0; batch < m_plan.batches && goesOn; ++batch) {
        goesOn = measureBatch(m_plan.measuring * perCollision / m_plan.batches);
        if (goesOn && measured) measured(judged());
    }
    m_study.complete = goesOn;
    return judged();
}

/// What the batches so far say.
GasStudy Experiment::judged() {
    const GasStudy unjudged = m_study;
    m_gas.write(m_state);
    m_study.events = m_gas.counts().events();
    m_study.energyDrift =
        (energy() - m_initialEnergy) / (1.5 * m_study.temperature * static_cast<double>(m_study.balls));

    judgeSpeeds();
    judgeHeights();
    if (m_inner && !m_virial.values().empty()) {
        const double n = m_density / static_cast<double>(m_virial.values().size());
        m_study.packing = theory::packingOf(n, m_study.diameter);
        const double z = m_study.alike ? theory::compressibilityOf(m_study.packing) : nothing;
        m_study.compressibility = m_virial.estimate(z);
        m_study.wallCompressibility = m_walls.estimate(z);
        m_study.compressibilityOfBatches = m_virial.values();
        if (!m_freeTime.values().empty())
            m_study.freeTime = m_freeTime.estimate(
                m_study.alike ? theory::freeTimeOf(n, m_study.diameter, m_study.mass, m_study.temperature)
                              : nothing);
    }
    // Packing, at which the pressure is 4 % above that of points; twice or half as much at twice or half of
    // it.
    constexpr double thin = 0.01;
    if (!m_study.heights.empty() && m_study.packing > thin)
        m_study.remarks.push_back(
            "the gas is not thin: its balls keep each other higher than the formula says");
    return std::exchange(m_study, unjudged);
}

} // namespace

GasStudy studyGas(const Pipeline& pipeline, const GasPlan& plan, const GasListener& goOn,
                  const std::function<void(const GasStudy&)>& measured) {
    return Experiment(pipeline, plan, goOn).run(measured);
}

} // namespace carom
