// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/generators/generator.h"
#include "core/simulation/build.h"
#include "core/simulation/pipeline.h"
#include "core/simulation/world.h"
#include "tests/support/scenes.h"
#include "tests/support/test_class.h"
#include "tests/support/worlds.h"
#include "ui/viewport/overlay_tips.h"
#include "ui/viewport/overlays.h"

#include <QTest>

#include <set>

namespace carom {
namespace {

using test::cuboid;
using test::sceneOf;
using test::sphere;
using test::wall;

constexpr double inFloats = 1e-6;
/// A contact solved for to 1e-6 of the weight.
constexpr double solved = 1e-4;

Vec3 at(const LineVertex& vertex) { return {vertex.position[0], vertex.position[1], vertex.position[2]}; }

std::vector<LineVertex> linesOf(Overlay overlay, const Scene& scene) {
    const Pipeline pipeline(scene);
    const State& state = pipeline.initialState();
    const std::vector<TouchingPair> touching = touchingPairs(pipeline.bodies(), state);
    const std::vector<BodyPair> overlapping = overlappingPairs(pipeline.bodies(), state.pose);
    return overlayLines(static_cast<Overlays>(overlay), {.scene = pipeline.scene(),
                                                         .poses = state.pose,
                                                         .velocities = state.velocity,
                                                         .touching = touching,
                                                         .overlapping = overlapping,
                                                         .structure = {},
                                                         .size = 8});
}

} // namespace

class OverlaysTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aBoxIsTheTwelveEdgesOfABodysBounds() {
        const std::vector<LineVertex> lines =
            linesOf(Overlay::Boxes, sceneOf({cuboid({2, 4, 6}, 1, {1, 0, 0}), wall(Vec3::UnitY(), -9)}));
        QCOMPARE(lines.size(), 24U); // walls have none
        double total = 0;
        for (std::size_t i = 0; i < lines.size(); i += 2) total += (at(lines[i + 1]) - at(lines[i])).norm();
        QVERIFY(std::abs(total - 4 * (2 + 4 + 6)) < inFloats);
    }

    void aSpringIsACoilFromEndToEndWithoutAnyOverlay() {
        Scene scene = sceneOf({sphere(0.1, 1, {3, 0, 0})});
        Spring spring;
        spring.to = 0;
        spring.fromAt = Vec3(0, 4, 0);
        spring.toAt = Vec3(0.1, 0, 0);
        scene.springs.push_back(spring);
        const std::vector<LineVertex> lines = linesOf(Overlay{}, scene);
        QVERIFY(lines.size() > 100);
        QVERIFY((at(lines.front()) - Vec3(0, 4, 0)).norm() < inFloats);
        QVERIFY((at(lines.back()) - Vec3(3.1, 0, 0)).norm() < inFloats);
        for (std::size_t i = 2; i < lines.size(); i += 2)
            QVERIFY((at(lines[i]) - at(lines[i - 1])).norm() < inFloats); // in one piece
    }

    void aGhostIsWireWhereABodyIsElsewhereThanInTheOldRun() {
        const Scene scene = sceneOf({sphere(1, 1, {0, 0, 0}), cuboid({2, 2, 2}, 1, {9, 0, 0})});
        const State state = Pipeline(scene).initialState();
        std::vector<Pose> old = state.pose;
        const auto ghostOf = [&](const Scene& before) {
            return overlayLines(0, {.scene = scene,
                                    .poses = state.pose,
                                    .velocities = {},
                                    .touching = {},
                                    .overlapping = {},
                                    .structure = {},
                                    .ghost = {&before, old}});
        };
        QVERIFY(ghostOf(scene).empty());
        old[1].position.y() = 3;
        const std::vector<LineVertex> edges = ghostOf(scene);
        QCOMPARE(edges.size(), 24U); // the cuboid's, the sphere is where it was
        for (const LineVertex& vertex : edges) QVERIFY(std::abs(at(vertex).y() - 3) - 1 < inFloats);
        const Scene smaller = sceneOf({sphere(0.5, 1, {0, 0, 0}), cuboid({2, 2, 2}, 1, {9, 3, 0})});
        old = Pipeline(smaller).initialState().pose;
        old[1] = state.pose[1];
        for (const LineVertex& vertex : ghostOf(smaller)) QVERIFY(at(vertex).norm() < 0.5 + inFloats);
    }

    void aBodyWithAWarningIsOutlinedAndOthersAreNot() {
        const Scene scene =
            sceneOf({sphere(1, 1, {0, 0, 0}), cuboid({2, 2, 2}, 1, {9, 0, 0}), wall(Vec3::UnitY(), -9)});
        const State state = Pipeline(scene).initialState();
        const std::vector<BodyIndex> warned = {1, 2};
        const std::vector<LineVertex> edges = overlayLines(0, {.scene = scene,
                                                               .poses = state.pose,
                                                               .velocities = {},
                                                               .touching = {},
                                                               .overlapping = {},
                                                               .structure = {},
                                                               .warned = warned});
        QCOMPARE(edges.size(), 24U); // the cuboid's; a wall has no outline
        for (const LineVertex& vertex : edges) QVERIFY((at(vertex) - Vec3(9, 0, 0)).norm() < 2);
    }

    void contactForcesCarryTheBodiesAboveAndAreDrawnInProportion() {
        // Two cubes of 1 kg and 3 kg, one on the other: 29.4 N between them and 39.2 N on the floor.
        Scene scene = sceneOf(
            {wall(Vec3::UnitY(), 0), cuboid({1, 1, 1}, 1, {0, 0.5, 0}), cuboid({1, 1, 1}, 3, {0, 1.5, 0})});
        scene.gravity.acceleration = Vec3(0, -9.8, 0);
        World world(std::make_shared<const Pipeline>(scene));
        for (int frame = 0; frame < 30; ++frame) world.step();
        const Snapshot now = world.snapshot();
        double below = 0, between = 0;
        for (const ContactForce& one : now.contactForces)
            (one.at.y() < 0.5 ? below : between) += one.force.y();
        QVERIFY2(std::abs(below - 39.2) < solved * 39.2, qPrintable(QString::number(below)));
        QVERIFY2(std::abs(std::abs(between) - 29.4) < solved * 29.4, qPrintable(QString::number(between)));

        const std::vector<TouchingPair> touching = touchingPairs(world.pipeline().bodies(), world.state());
        const auto drawn = [&](std::span<const ContactForce> forces) {
            return overlayLines(static_cast<Overlays>(Overlay::Contacts), {.scene = scene,
                                                                           .poses = now.pose,
                                                                           .velocities = {},
                                                                           .touching = touching,
                                                                           .forces = forces,
                                                                           .overlapping = {},
                                                                           .structure = {}});
        };
        const std::size_t without = drawn({}).size();
        const std::vector<ContactForce> two = {{{0, 0, 0}, {0, 40, 0}}, {{1, 0, 0}, {0, 10, 0}}};
        const std::vector<LineVertex> lines = drawn(two);
        QVERIFY(lines.size() > without);
        double longest = 0, other = 0;
        for (std::size_t i = without; i < lines.size(); ++i)
            (at(lines[i]).x() < 0.5 ? longest : other) =
                std::max(at(lines[i]).x() < 0.5 ? longest : other, at(lines[i]).y());
        QVERIFY(std::abs(longest - 4 * other) < inFloats * longest * 10);
    }

    void contactsAndVelocitiesAreMarksAndSpringsAreWide() {
        Scene scene = sceneOf({sphere(1, 1, {0, 0.99, 0}, {1, 0, 0}), wall(Vec3::UnitY(), 0)});
        for (const Overlay overlay : {Overlay::Contacts, Overlay::Velocities})
            for (const LineVertex& vertex : linesOf(overlay, scene)) QCOMPARE(vertex.kind, LineKind::Mark);
        for (const LineVertex& vertex : linesOf(Overlay::Boxes, scene)) QCOMPARE(vertex.kind, LineKind::Fine);
        Spring spring;
        spring.to = 0;
        spring.fromAt = Vec3(0, 4, 0);
        scene.springs.push_back(spring);
        for (const LineVertex& vertex : linesOf(Overlay{}, scene)) QCOMPARE(vertex.kind, LineKind::Wide);
    }

    void aCardHouseAtRestShowsTheContactsThatBearIt() {
        // Cards stand a rounding apart, so that hardly a pair of them touches by its distance.
        World world(build(generate(*findGenerator("card_house"), {})).pipeline);
        for (int frame = 0; frame < 60; ++frame) world.step();
        const Snapshot now = world.snapshot();
        std::set<BodyPair> bearing;
        double onTheFloor = 0;
        for (const ContactForce& contact : now.contactForces) {
            bearing.insert(contact.pair);
            QVERIFY(std::abs(contact.normal.norm() - 1) < inFloats);
            if (isWall(world.pipeline().bodies().shape[contact.pair.a]) ||
                isWall(world.pipeline().bodies().shape[contact.pair.b]))
                onTheFloor += contact.force.y();
        }
        const std::vector<LineVertex> lines =
            overlayLines(static_cast<Overlays>(Overlay::Contacts), {.scene = world.pipeline().scene(),
                                                                    .poses = now.pose,
                                                                    .velocities = {},
                                                                    .touching = {},
                                                                    .forces = now.contactForces,
                                                                    .overlapping = {},
                                                                    .structure = {}});
        QCOMPARE(lines.size(), 2 * 10 * now.contactForces.size()); // a normal and a force each
        for (std::size_t i = 0; i < lines.size(); i += 10 * now.contactForces.size()) // cards are 1 mm thick
            QVERIFY((at(lines[i + 1]) - at(lines[i])).norm() > 0.01);
        double weight = 0;
        for (const Body& body : world.pipeline().scene().bodies)
            if (body.mobile()) weight += 9.81 * body.mass;
        QVERIFY2(std::abs(onTheFloor - weight) < 0.02 * weight,
                 qPrintable(QString::number(onTheFloor / weight)));
        // 15 cards in three storeys: 24 pairs, each on two corners of an edge.
        QCOMPARE(bearing.size(), std::size_t{24});
        QCOMPARE(now.contactForces.size(), std::size_t{48});
    }

    void theTipOfAContactSaysBodiesImpulseAndWhetherItSlides() {
        Scene scene = sceneOf({wall(Vec3::UnitY(), 0), cuboid({1, 1, 1}, 2, {0, 0.5, 0})});
        scene.gravity.acceleration = Vec3(0, -9.8, 0);
        scene.bodies[0].friction = scene.bodies[1].friction = 0.5;
        scene.bodies[1].label = "crate";
        World world(std::make_shared<const Pipeline>(scene));
        for (int frame = 0; frame < 30; ++frame) world.step();
        const Snapshot now = world.snapshot();
        QVERIFY(!now.contactForces.empty());
        Camera camera;
        const PictureSize size{800, 600};
        const Vec3 at = now.contactForces.front().at;
        const TipRequest request{.scene = scene,
                                 .snapshot = now,
                                 .overlays = static_cast<Overlays>(Overlay::Contacts),
                                 .frame = 1.0 / 60,
                                 .arrowTime = velocityTime};
        const QString tip = tipAt(request, camera, size, *projected(camera, size, at));
        QVERIFY2(tip.contains(QStringLiteral("wall 0 and crate")), qPrintable(tip));
        const QString force = QString::number(now.contactForces.front().force.norm(), 'g', 4);
        QVERIFY2(tip.contains(QStringLiteral("force %1 N, impulse ").arg(force)), qPrintable(tip));
        QVERIFY2(tip.contains(QStringLiteral("sticks; friction ")), qPrintable(tip));
        QVERIFY(tipAt(request, camera, size, {2, 2}).isEmpty());

        ContactForce sliding{.at = {}, .force = {2, 4, 0}, .normal = {0, 1, 0}, .friction = 0.5};
        QVERIFY(sliding.slides());
        sliding.force.x() = 1.9;
        QVERIFY(!sliding.slides());
    }

    void trailsJoinThePlacesPassedAndTheCentreOfMassIsMarked() {
        const Scene scene = sceneOf({sphere(1, 3, {0, 0, 0}), sphere(1, 1, {8, 0, 0})});
        const State state = Pipeline(scene).initialState();
        const std::vector<std::vector<Vec3>> trails = {{{0, 0, 0}, {1, 0, 0}, {1, 2, 0}}, {{8, 0, 0}}};
        const auto drawn = [&](Overlay overlay) {
            return overlayLines(static_cast<Overlays>(overlay), {.scene = scene,
                                                                 .poses = state.pose,
                                                                 .velocities = {},
                                                                 .touching = {},
                                                                 .overlapping = {},
                                                                 .structure = {},
                                                                 .trails = trails});
        };
        const std::vector<LineVertex> lines = drawn(Overlay::Trails);
        QCOMPARE(lines.size(), 4U);
        QVERIFY((at(lines[3]) - Vec3(1, 2, 0)).norm() < inFloats);
        const std::vector<LineVertex> star = drawn(Overlay::CentreOfMass);
        QCOMPARE(star.size(), 6U);
        Vec3 middle = Vec3::Zero();
        for (const LineVertex& vertex : star) middle += at(vertex) / 6;
        QVERIFY((middle - Vec3(2, 0, 0)).norm() < inFloats);
    }

    void aVelocityIsTheWayOfATenthOfASecond() {
        const Scene scene = sceneOf({sphere(1, 1, {1, 2, 3}, {10, 0, -5}), sphere(1, 1, {9, 9, 9})});
        const std::vector<LineVertex> lines = linesOf(Overlay::Velocities, scene);
        QCOMPARE(lines.size(), 10U); // a shaft and four strokes for the head; nothing for the ball at rest
        QVERIFY((at(lines[0]) - Vec3(1, 2, 3)).norm() < inFloats);
        QVERIFY((at(lines[1]) - Vec3(2, 2, 2.5)).norm() < inFloats);
    }

    void aContactIsDrawnWhereBodiesTouch() {
        const std::vector<LineVertex> lines =
            linesOf(Overlay::Contacts,
                    sceneOf({sphere(1, 1, {0, 0.99, 0}), wall(Vec3::UnitY(), 0), sphere(1, 1, {5, 5, 5})}));
        QCOMPARE(lines.size(), 10U);
        QVERIFY(at(lines[0]).norm() < 0.011); // within the overlap of the point that touches
    }

    void aPairIsALineAndTwoBoxesThoughTheBodiesDoNotTouch() {
        const Scene scene = sceneOf({sphere(1, 1, {0, 0, 0}), sphere(1, 1, {1.9, 1.9, 0}),
                                     sphere(1, 1, {0, 2.1, 0}), wall(Vec3::UnitY(), -1)});
        const std::vector<LineVertex> lines = linesOf(Overlay::Pairs, scene);
        QCOMPARE(lines.size(), 2U * (2 + 24 + 24)); // the first two balls and the last two; walls have no box
        QVERIFY(at(lines[0]).norm() < inFloats);
        QVERIFY((at(lines[1]) - Vec3(1.9, 1.9, 0)).norm() < inFloats);
    }

    void cellsAreDrawnAsBoxes() {
        const Scene scene = sceneOf({});
        const std::vector<Aabb> cells = {{Vec3(0, 0, 0), Vec3(1, 1, 1)}, {Vec3(2, 0, 0), Vec3(3, 1, 1)}};
        const std::vector<LineVertex> lines =
            overlayLines(static_cast<Overlays>(Overlay::Structure), {.scene = scene,
                                                                     .poses = {},
                                                                     .velocities = {},
                                                                     .touching = {},
                                                                     .overlapping = {},
                                                                     .structure = cells});
        QCOMPARE(lines.size(), 48U);
        QVERIFY((at(lines[24]) - Vec3(2, 0, 0)).norm() < inFloats);
    }

    void axesStartAtTheOriginInTheirColours() {
        const std::vector<LineVertex> lines = linesOf(Overlay::Axes, sceneOf({sphere(1, 1, {0, 0, 0})}));
        QCOMPARE(lines.size(), 30U);
        for (int axis = 0; axis < 3; ++axis) {
            const LineVertex& tip = lines[static_cast<std::size_t>(10 * axis + 1)];
            QVERIFY((at(tip) - 2 * Vec3::Unit(axis)).norm() < inFloats);
            for (int other = 0; other < 3; ++other)
                QVERIFY(other == axis || tip.colour[axis] > tip.colour[other]);
        }
    }

    void nothingIsDrawnThatIsNotAskedFor() {
        const Scene scene = sceneOf({sphere(1, 1, {0, 0, 0}, {1, 1, 1})});
        QVERIFY(linesOf(Overlay::Labels, scene).empty()); // words are not lines
        QVERIFY(overlayLines(0, {.scene = scene,
                                 .poses = {},
                                 .velocities = {},
                                 .touching = {},
                                 .overlapping = {},
                                 .structure = {}})
                    .empty());
    }
};

} // namespace carom

CAROM_TEST(overlays_test, carom::OverlaysTest)
#include "overlays_test.moc"
