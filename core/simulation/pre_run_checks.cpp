// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/pre_run_checks.h"

#include "core/simulation/fix_its.h"

#include "core/integrators/integrator.h"

#include "core/broadphase/broadphase.h"
#include "core/broadphase/crowding.h"
#include "core/narrowphase/narrowphase.h"
#include "core/solvers/solver.h"

#include "core/base/figures.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {
namespace {

/// Warnings of one kind at most: a list that can be read. Twice or half changes its length only.
constexpr std::size_t mostOfAKind = 50;
/// Substeps that a fix-it proposes at most: more would take minutes a frame. At half, some scenes get a
/// warning without a fix-it.
constexpr double mostSubsteps = 10000;

/// Depth below which bodies count as touching, relative to the smaller body's half thickness: far above
/// rounding, far below what is visible: scenes stack bodies face on face. At a thousandth, rounding of their
/// positions would be reported as an overlap.
constexpr double touching = 1e-9;

SourceRange placeOf(const Scene& scene, BodyIndex body, std::string_view parameter) {
    const DeclarationSource& source = scene.bodies[body].source;
    const ParameterSource* given = scene.find(source, parameter);
    return given != nullptr ? given->value : source.type;
}

double thicknessOf(const Scene& scene, BodyIndex body) {
    return isWall(scene.bodies[body].shape) ? HUGE_VAL : halfThicknessOf(scene.bodies[body].shape);
}

/// Pairs of bodies and walls that are checked at most, in about a tenth of a second; at twice, the editor
/// waits twice as long in such a scene.
constexpr std::size_t mostWallPairs = 10'000'000;

/// A text that is being typed may have a hundred thousand bodies in one place, and the editor must still
/// respond. Bodies that are apart, or rest on each other, have at most a dozen neighbours each; where the
/// average is above this, only the first thousand bodies are checked for overlaps. At half of the first,
/// dense packings are not checked wholly; at twice of either, checks of such texts take twice as long; at
/// half of the second, fewer overlaps are named.
constexpr double mostNeighbours = 20;
constexpr std::size_t bodiesOfAHeap = 1000;

// Contacts at the start: bodies behind walls, overlaps and mass ratios, each reported at most mostOfAKind
// times.
class Touches {
  public:
    Touches(const Scene& scene, const RunSettings& settings)
        : m_scene(scene), m_settings(settings),
          m_leastLimit(limitFor(std::numeric_limits<std::size_t>::max()).most) {}

    void findAll(const Bodies& bodies, const WorkStage& stage) {
        // Part of the work that is done after each stage, in a gas. Other values change only how evenly the
        // progress that is shown runs.
        constexpr double besideWalls = 0.1, paired = 0.5;
        againstWalls(bodies, stage.part(0, besideWalls));

        std::vector<Aabb> boxes;
        std::vector<std::uint8_t> mobile;
        boxes.reserve(bodies.bounded.size());
        mobile.reserve(bodies.bounded.size());
        for (const BodyIndex i : bodies.bounded) {
            // A little grown: bodies that stand on each other may be a rounding apart.
            boxes.push_back(grown(boundsOf(bodies.shape[i], m_scene.bodies[i].pose),
                                  touching * bodies.boundingRadius[i]));
            mobile.push_back(bodies.mobile[i]);
        }
        std::size_t looked = boxes.size();
        if (neighboursPerBox(boxes) > mostNeighbours) looked = std::min(looked, bodiesOfAHeap);
        const BroadphaseInput input{std::span(boxes).first(looked), std::span(bodies.bounded).first(looked),
                                    std::span(mobile).first(looked)};
        const std::unique_ptr<Broadphase> broadphase = chooseBroadphase(input).row->create();
        stage.reach(besideWalls);
        broadphase->update(input);
        const std::span<const BodyPair> pairs = broadphase->pairs();
        const WorkStage pairing = stage.part(paired, 1);
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            pairing.reach(i, i, pairs.size());
            between(pairs[i].a, pairs[i].b);
        }
        sayRatios();
    }

    std::vector<Diagnostic> diagnostics;

  private:
    void againstWalls(const Bodies& bodies, const WorkStage& stage) {
        const std::size_t all = std::min(mostWallPairs, bodies.walls.size() * bodies.mobileBodies.size());
        std::size_t left = mostWallPairs;
        for (const BodyIndex wall : bodies.walls) {
            for (const BodyIndex body : bodies.mobileBodies) {
                if (left == 0) return;
                stage.reach(left, mostWallPairs - left, all);
                --left;
                againstWall(wall, body);
            }
        }
    }

    void againstWall(BodyIndex wallIndex, BodyIndex body) {
        const Wall& wall = *std::get_if<Wall>(&m_scene.bodies[wallIndex].shape);
        const double height = distanceTo(wall, m_scene.bodies[body].pose.position);
        if (height > boundingRadiusOf(m_scene.bodies[body].shape)) return;
        if (height >= 0) {
            between(wallIndex, body);
        } else if (m_behind++ < mostOfAKind) {
            diagnostics.push_back({.code = DiagnosticCode::OutsideWalls,
                                   .range = placeOf(m_scene, body, "centre"),
                                   .message = "the centre of " + m_scene.nameOf(body) + " is " +
                                              figure(-height) + " m behind " + m_scene.nameOf(wallIndex) +
                                              "; the free side is the one the normal points to",
                                   .notes = {{m_scene.bodies[wallIndex].source.type, "the wall is here"}},
                                   .fixIt = {}});
        }
    }

    void between(BodyIndex a, BodyIndex b) {
        const Body& bodyA = m_scene.bodies[a];
        const Body& bodyB = m_scene.bodies[b];
        const double slop = touching * std::min(thicknessOf(m_scene, a), thicknessOf(m_scene, b));
        if (!collide({&bodyA.shape, &bodyA.pose}, {&bodyB.shape, &bodyB.pose}, slop, m_manifold)) return;
        noteRatio(a, b);
        const double depth = -m_manifold.deepest().separation;
        if (depth <= slop || m_overlaps >= mostOfAKind) return;
        ++m_overlaps;
        // The later one of the text is named first: it is the one that was put into the other.
        const BodyIndex later = isWall(bodyB.shape) ? a : b;
        const BodyIndex earlier = later == a ? b : a;
        diagnostics.push_back(
            {.code = DiagnosticCode::OverlapAtStart,
             .range = placeOf(m_scene, later, "centre"),
             .message = m_scene.nameOf(later) + " overlaps " + m_scene.nameOf(earlier) + " by " +
                        figure(depth) + " m at the start; move them apart by at least that",
             .notes = {{m_scene.bodies[earlier].source.type, m_scene.nameOf(earlier) + " is here"}},
             .fixIt = movedApart(later, (later == b ? depth : -depth) * m_manifold.normal)});
    }

    // The centre moved by the overlap and a millionth of the body's thickness more, for what nine digits
    // round away. At a tenth of that an overlap can remain by rounding; at a thousand times, a gap would
    // show.
    std::optional<FixIt> movedApart(BodyIndex body, const Vec3& overlap) const {
        constexpr double more = 1e-6;
        constexpr int digits = 9;
        const Body& moved = m_scene.bodies[body];
        const Vec3 room = more * thicknessOf(m_scene, body) * overlap.normalized();
        const Vec3 centre = moved.pose.position + overlap + room;
        std::string text;
        for (Eigen::Index k = 0; k < 3; ++k)
            text.append(k == 0 ? "" : ", ").append(figure(centre[k] == 0 ? 0.0 : centre[k], digits));
        return valueFixIt(m_scene, moved.source, "centre", text);
    }

    void noteRatio(BodyIndex a, BodyIndex b) {
        m_points += static_cast<std::size_t>(m_manifold.count);
        if (!m_scene.bodies[a].mobile() || !m_scene.bodies[b].mobile() || m_ratios.size() >= mostOfAKind)
            return;
        const bool aIsHeavy = m_scene.bodies[a].mass > m_scene.bodies[b].mass;
        const Ratio ratio{aIsHeavy ? a : b, aIsHeavy ? b : a};
        if (ratioOf(ratio) > m_leastLimit) m_ratios.push_back(ratio);
    }

    void sayRatios() {
        const MassRatioLimit limit = limitFor(m_points);
        for (const Ratio& ratio : m_ratios) {
            if (!(ratioOf(ratio) > limit.most)) continue;
            diagnostics.push_back(
                {.code = DiagnosticCode::MassRatio,
                 .range = placeOf(m_scene, ratio.heavy, "mass"),
                 .message = m_scene.nameOf(ratio.heavy) + " is " + figure(ratioOf(ratio)) +
                            " times as heavy as " + m_scene.nameOf(ratio.light) + ", which it touches; " +
                            limit.reason,
                 .notes = {{placeOf(m_scene, ratio.light, "mass"), m_scene.nameOf(ratio.light) + " is here"}},
                 .fixIt = settingFixIt(m_scene, limit.parameter, std::string(limit.word))});
        }
    }

    /// What the method holds with so many contact points.
    MassRatioLimit limitFor(std::size_t points) const {
        const auto limit = m_settings.method->massRatioLimit;
        return limit != nullptr ? limit(m_settings.solver(false), points) : MassRatioLimit{};
    }

    struct Ratio {
        BodyIndex heavy = noBody, light = noBody;
    };
    double ratioOf(const Ratio& ratio) const {
        return m_scene.bodies[ratio.heavy].mass / m_scene.bodies[ratio.light].mass;
    }

    const Scene& m_scene;
    const RunSettings& m_settings;
    Manifold m_manifold;
    double m_leastLimit;         // whatever the number of contact points
    std::vector<Ratio> m_ratios; // beyond it
    std::size_t m_points = 0;    // of contact at the start
    std::size_t m_overlaps = 0;
    std::size_t m_behind = 0;
};

// A body that passes its own half-extent between two substeps can be in front of a thin body at the one and
// behind it at the other.
std::vector<Diagnostic> tunnelling(const Scene& scene, const RunSettings& settings) {
    std::vector<Diagnostic> found;
    if (scene.bodies.size() < 2 || settings.method->abilities.locatesImpacts) return found;
    for (BodyIndex i = 0; i < scene.bodies.size() && found.size() < mostOfAKind; ++i) {
        const Body& body = scene.bodies[i];
        if (!body.mobile()) continue;
        const double half = halfThicknessOf(body.shape);
        const double passed = body.velocity.norm() * settings.substep();
        if (passed <= half) continue;
        const double factor = std::ceil(passed / half); // of substeps that are needed
        std::optional<FixIt> fixIt;
        std::string message = scene.nameOf(i) + " moves " + figure(passed) +
                              " m a substep, more than its half-extent of " + figure(half) +
                              " m, and may pass through what it meets; ";
        if (std::isfinite(factor) && factor * settings.substeps <= mostSubsteps) {
            const std::string substeps = figure(factor * settings.substeps, 6);
            message += "`substeps " + substeps + "` would hold it";
            fixIt = settingFixIt(scene, "substeps", substeps);
        } else {
            message += "it is too fast for any sensible step";
        }
        found.push_back({.code = DiagnosticCode::Tunnelling,
                         .range = placeOf(scene, i, "vel"),
                         .message = std::move(message),
                         .notes = {},
                         .fixIt = std::move(fixIt)});
    }
    return found;
}

/// 1/m of one end of a spring as a pull along any direction meets it, at most [1/kg].
double complianceOf(const Scene& scene, BodyIndex body, const Vec3& at) {
    if (body == noBody || !scene.bodies[body].mobile()) return 0;
    const Body& end = scene.bodies[body];
    return 1 / end.mass + at.squaredNorm() / inertiaOf(end.shape, end.mass).minCoeff();
}

// An explicit scheme amplifies the oscillation of a spring that is too stiff for the substep: ω² = k (1/mA +
// 1/mB). With damping explicit Euler is stable from h k = c on.
std::vector<Diagnostic> instability(const Scene& scene, const RunSettings& settings) {
    std::vector<Diagnostic> found;
    const IntegratorRow& integrator = *settings.integrator;
    for (const Spring& spring : scene.springs) {
        const double compliance =
            complianceOf(scene, spring.from, spring.fromAt) + complianceOf(scene, spring.to, spring.toAt);
        const double phase = settings.substep() * std::sqrt(spring.stiffness * compliance);
        const bool held = integrator.stableUpTo > 0 ? phase <= integrator.stableUpTo
                                                    : settings.substep() * spring.stiffness <= spring.damping;
        if (held || compliance == 0 || found.size() >= mostOfAKind) continue;
        const std::string name(integrator.name);
        std::string message = "the oscillation of this spring grows without bound: ωh is " + figure(phase) +
                              ", and `" + name + "` holds ";
        if (integrator.stableUpTo > 0)
            message += "up to " + figure(integrator.stableUpTo) + "; `substeps " +
                       figure(std::ceil(settings.substeps * phase / integrator.stableUpTo), 6) +
                       "` or `integrator midpoint` would hold it";
        else
            message += "none that is not damped; `integrator verlet` or `midpoint` would hold it";
        found.push_back({.code = DiagnosticCode::UnstableSpring,
                         .range = spring.source.type,
                         .message = std::move(message),
                         .notes = {},
                         .fixIt = {}});
    }
    return found;
}

// An explicit scheme takes the force at the beginning for the whole substep: one that slows a body at the
// rate λ turns its velocity around where λh > 1, and from some λh on the velocity grows. The rate is the
// fastest one on the way from the start, under gravity.
std::vector<Diagnostic> overshooting(const Scene& scene, const RunSettings& settings, const Bodies& bodies) {
    std::vector<Diagnostic> found;
    const IntegratorRow& integrator = *settings.integrator;
    if (std::isinf(integrator.decaysUpTo)) return found;
    for (const auto& term : bodies.forces.terms) {
        std::vector<ForceSample> samples;
        for (BodyIndex i = 0; i < scene.bodies.size(); ++i) {
            const Body& body = scene.bodies[i];
            if (term->actsOn(i)) samples.push_back({i, body.pose, body.velocity, body.angularVelocity});
        }
        std::vector<double> rates(samples.size(), 0);
        term->addRates(samples, bodies.gravity.norm(), rates);
        const std::string parameter(term->parameter()), name(integrator.name);
        for (std::size_t k = 0; k < samples.size() && found.size() < mostOfAKind; ++k) {
            const double reach = rates[k] * settings.substep();
            if (!(reach > integrator.decaysUpTo)) continue;
            const double substeps = std::ceil(settings.substeps * reach / integrator.decaysUpTo);
            std::string message = "`" + parameter + "` may throw " + scene.nameOf(samples[k].body) +
                                  " back and forth: λh is " + figure(reach) + ", and `" + name +
                                  "` holds up to " + figure(integrator.decaysUpTo) + "; ";
            if (substeps <= mostSubsteps) message += "`substeps " + figure(substeps, 6) + "` or ";
            found.push_back({.code = DiagnosticCode::UnstableForce,
                             .range = placeOf(scene, samples[k].body, parameter),
                             .message = std::move(message) + "`integrator midpoint` would hold it",
                             .notes = {},
                             .fixIt = settingFixIt(scene, "integrator", "midpoint")});
        }
    }
    return found;
}

} // namespace

std::vector<Diagnostic> preRunWarnings(const Scene& scene, const RunSettings& settings, const Bodies& bodies,
                                       const WorkStage& stage) {
    std::vector<Diagnostic> found = tunnelling(scene, settings);
    for (Diagnostic& diagnostic : instability(scene, settings)) found.push_back(std::move(diagnostic));
    for (Diagnostic& diagnostic : overshooting(scene, settings, bodies))
        found.push_back(std::move(diagnostic));
    Touches touches(scene, settings);
    touches.findAll(bodies, stage);
    for (Diagnostic& diagnostic : touches.diagnostics) found.push_back(std::move(diagnostic));
    return found;
}

} // namespace carom
