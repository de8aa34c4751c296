// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/obvious_groups.h"
#include "tests/support/solver_rows.h"
#include "tests/support/test_class.h"

#include "core/solvers/contacts/contact_rows.h"

#include <QTest>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <vector>

// Groups of four contacts: everything that was put in is in them once, no body is twice in one, and where a
// pair goes depends on the pairs alone.

namespace carom {
namespace {

constexpr double roundingOfRows = 1e-12; // of products of a few numbers of the size of 1

using test::ObviousGroups;
using test::OwnedPair;
using test::RowKind;
using test::RowScene;

/// Where the rows have put the pairs: a list of sources for every group.
std::vector<std::array<std::uint32_t, wideLanes>> placementOf(const ContactRows& rows) {
    std::vector<std::array<std::uint32_t, wideLanes>> result;
    for (const RowGroup& group : rows.groups()) result.push_back(group.source);
    return result;
}

// One body in the middle of many contacts, and some beside it.
RowScene hub(Random& random, std::size_t contacts) {
    RowScene scene = test::randomBodies(random, contacts + 1);
    for (std::uint32_t i = 1; i <= contacts; ++i) {
        scene.pairs.push_back(test::randomPair(random, scene, 0, i, {}));
        if (i % 3 == 0) scene.pairs.push_back(test::randomPair(random, scene, i, i - 1, {}));
        if (i % 5 == 0) scene.pairs.push_back(test::randomPair(random, scene, scene.immobile(), i, {}));
        if (i % 7 == 0) scene.pairs.push_back(test::randomPair(random, scene, scene.immobile(), 0, {}));
    }
    return scene;
}

std::vector<RowScene> manyScenes() {
    qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
    Random random(test::seed);
    std::vector<RowScene> scenes;
    RowKind kind;
    kind.rolling = 0.1;
    for (int trial = 0; trial < 60; ++trial) {
        const std::size_t bodies = 1 + random.below(60);
        kind.immobileShare = random.uniform();
        scenes.push_back(test::randomRows(random, bodies, random.below(300), kind));
    }
    for (const std::size_t contacts : {63U, 64U, 65U, 66U, 200U, 500U})
        scenes.push_back(hub(random, contacts));
    return scenes;
}

/// Where pairs go: those with one point, with two, and with more have groups of their own.
std::vector<std::array<std::uint32_t, wideLanes>> obviousPlacementOf(const RowScene& scene) {
    std::vector<std::array<std::uint32_t, wideLanes>> result;
    ObviousGroups groups(scene.immobile());
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
        const OwnedPair& pair = scene.pairs[i];
        const std::size_t size = std::min<std::size_t>(pair.points.size(), 3) - 1;
        const ObviousGroups::Place place = groups.place(pair.laws.a, pair.laws.b, size);
        if (place.isNew) result.emplace_back().fill(ContactRows::noPair);
        result[place.group][place.lane] = static_cast<std::uint32_t>(i);
    }
    return result;
}

/// W of a point, by its definition: the velocity of the point of B relative to A after an impulse.
Mat3 responseOf(const SolverBody& a, const SolverBody& b, const PointInput& point) {
    Mat3 response;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const Vec3 p = Vec3::Unit(axis);
        const auto after = [&](const SolverBody& body, const Vec3& arm) -> Vec3 {
            const Vec3 spin = carom::inverseInertiaOf(body) * arm.cross(p);
            return body.inverseMass * p + spin.cross(arm);
        };
        response.col(axis) = after(a, point.armA) + after(b, point.armB);
    }
    return response;
}

} // namespace

/// Of a symmetric matrix, row by row: a b, b c.
double largerEigenvalue(double a, double b, double c) { return (a + c) / 2 + std::hypot((a - c) / 2, b); }

class ContactRowsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void noMobileBodyIsTwiceInAGroup() {
        for (const RowScene& scene : manyScenes()) {
            const ContactRows rows = scene.rows();
            for (const RowGroup& group : rows.groups()) {
                std::set<std::uint32_t> seen;
                for (std::size_t lane = 0; lane < wideLanes; ++lane)
                    for (const std::uint32_t body : {group.a[lane], group.b[lane]}) {
                        QVERIFY(body <= rows.immobile());
                        if (body != rows.immobile()) QVERIFY(seen.insert(body).second);
                    }
            }
        }
    }

    void everyPairIsKeptOnceWithItsData() {
        for (const RowScene& scene : manyScenes()) {
            const ContactRows rows = scene.rows();
            std::vector<int> found(scene.pairs.size(), 0);
            std::vector<int> owned(rows.points().size(), 0);
            for (const RowGroup& group : rows.groups()) {
                QVERIFY(group.points == 1 || group.points == 2 || group.points == 4);
                QVERIFY(group.firstPoint + group.points <= rows.points().size());
                for (std::uint32_t k = 0; k < group.points; ++k) ++owned[group.firstPoint + k];
                bool bounces = false;
                for (std::size_t lane = 0; lane < wideLanes; ++lane) {
                    if (group.source[lane] == ContactRows::noPair) {
                        QCOMPARE(group.a[lane], rows.immobile());
                        QCOMPARE(group.b[lane], rows.immobile());
                        for (std::uint32_t k = 0; k < group.points; ++k) {
                            const RowPoint& point = rows.points()[group.firstPoint + k];
                            QVERIFY(point.massNormal[lane] == 0 && point.massTangent[lane] == 0);
                            QVERIFY(rows.impulseOf(group, static_cast<int>(lane), k) == Vec3::Zero());
                        }
                        continue;
                    }
                    QVERIFY(group.source[lane] < scene.pairs.size());
                    ++found[group.source[lane]];
                    const OwnedPair& pair = scene.pairs[group.source[lane]];
                    QCOMPARE(group.a[lane], pair.laws.a);
                    QCOMPARE(group.b[lane], pair.laws.b);
                    QVERIFY(laneOf(group.normal, lane) == pair.laws.normal);
                    const Vec3 tangent = laneOf(group.tangent, lane);
                    QVERIFY(std::abs(tangent.norm() - 1) < roundingOfRows);
                    QVERIFY(std::abs(tangent.dot(pair.laws.normal)) < roundingOfRows);
                    QVERIFY(group.friction[lane] == pair.laws.friction);
                    QVERIFY(group.restitution[lane] == pair.laws.restitution);
                    QVERIFY(group.push[lane] == pair.laws.push);
                    const bool held = pair.laws.a == rows.immobile() || pair.laws.b == rows.immobile();
                    QVERIFY(group.hard[lane] == (held ? 1 : 0));
                    bounces = bounces || pair.laws.restitution > 0;
                    const std::size_t room = pair.points.size() == 3 ? 4 : pair.points.size();
                    QCOMPARE(std::size_t{group.points}, room);
                    comparePoints(scene, rows, group, lane);
                }
                QCOMPARE(group.bounces, bounces);
            }
            QVERIFY(std::ranges::all_of(found, [](int times) { return times == 1; }));
            QVERIFY(std::ranges::all_of(owned, [](int times) { return times == 1; }));
        }
    }

    void rollingRowsBelongToTheirPairs() {
        for (const RowScene& scene : manyScenes()) {
            ContactRows rows = scene.rows();
            std::size_t expected = 0;
            for (const OwnedPair& pair : scene.pairs) expected += pair.laws.rolling > 0;
            QCOMPARE(rows.rolling().size(), expected);
            std::set<std::uint32_t> seen;
            for (const RollingRow& row : rows.rolling()) {
                const std::uint32_t source = rows.groups()[row.group].source[row.lane];
                QVERIFY(seen.insert(source).second);
                const OwnedPair& pair = scene.pairs[source];
                QVERIFY(row.a == pair.laws.a && row.b == pair.laws.b);
                QVERIFY(row.rolling == pair.laws.rolling && row.normal == pair.laws.normal);
                QVERIFY(row.torque == Vec3::Zero());
                // 1 over the larger eigenvalue of the response across the normal.
                const Mat3 response = carom::inverseInertiaOf(scene.bodies[row.a]) +
                                      carom::inverseInertiaOf(scene.bodies[row.b]);
                const Vec3 t1 = row.normal.unitOrthogonal(), t2 = row.normal.cross(t1);
                const double larger =
                    largerEigenvalue(t1.dot(response * t1), t1.dot(response * t2), t2.dot(response * t2));
                QVERIFY(std::abs(row.inertia * larger - 1) < roundingOfRows);
            }
        }
    }

    void pairsGoWhereASearchThroughAllGroupsPutsThem() {
        std::size_t crowded = 0;
        for (const RowScene& scene : manyScenes()) {
            const auto expected = obviousPlacementOf(scene);
            QVERIFY(placementOf(scene.rows()) == expected);
            crowded += expected.size() > 64;
        }
        QVERIFY(crowded >= 3); // some scenes have more groups than can be open
    }

    void orderIsAFunctionOfThePairsAlone() {
        Random random(test::seed, 1);
        ContactRows used; // rows that held something else before
        for (const RowScene& scene : manyScenes()) {
            const auto expected = placementOf(scene.rows());
            scene.fill(used);
            QVERIFY(placementOf(used) == expected);

            RowScene other = scene; // other bodies and other contacts between the same pairs
            for (std::size_t i = 0; i < other.mobileCount(); ++i) other.bodies[i] = test::randomBody(random);
            for (OwnedPair& pair : other.pairs) {
                const std::size_t count = pair.points.size();
                pair = test::randomPair(random, other, pair.laws.a, pair.laws.b, {});
                pair.points.resize(count, pair.points.front());
            }
            QVERIFY(placementOf(other.rows()) == expected);

            RowScene larger = scene; // the same among more bodies
            larger.bodies.insert(larger.bodies.end(), 7, SolverBody());
            larger.places.insert(larger.places.end(), 7, Vec3::Zero());
            for (OwnedPair& pair : larger.pairs)
                for (std::uint32_t* body : {&pair.laws.a, &pair.laws.b})
                    if (*body == scene.immobile()) *body = larger.immobile();
            QVERIFY(placementOf(larger.rows()) == expected);
        }
    }

    // Pairs that get other points are as if they had been added with these, to the bit, and nothing else
    // changes; pairs that are removed have no effect.
    void pairsAreReplacedAndRemovedInTheirPlaces() {
        Random random(test::seed, 3);
        for (const RowScene& scene : manyScenes()) {
            RowScene other = scene;
            std::vector<int> fate(scene.pairs.size()); // 0: stays, 1: is replaced, 2: is removed
            for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
                fate[i] = static_cast<int>(random.below(3));
                OwnedPair& pair = other.pairs[i];
                const std::size_t count = pair.points.size();
                const PairInput laws = pair.laws;
                if (fate[i] == 1) pair = test::randomPair(random, scene, laws.a, laws.b, {});
                pair.points.resize(count, pair.points.front());
                const Vec3 normal = pair.laws.normal;
                pair.laws = laws;
                pair.laws.normal = normal;
            }
            ContactRows rows = scene.rows();
            const ContactRows expected = other.rows();
            for (std::uint32_t group = 0; group < rows.groups().size(); ++group)
                for (std::uint32_t lane = 0; lane < wideLanes; ++lane) {
                    const std::uint32_t source = rows.groups()[group].source[lane];
                    if (source == ContactRows::noPair) continue;
                    PairInput pair = other.pairs[source].laws;
                    pair.points = other.pairs[source].points;
                    if (fate[source] == 1) rows.replace(group, lane, pair, scene.bodies);
                    if (fate[source] == 2) rows.remove({group, lane});
                }
            for (std::uint32_t group = 0; group < rows.groups().size(); ++group)
                for (std::uint32_t lane = 0; lane < wideLanes; ++lane) {
                    const RowGroup &is = rows.groups()[group], &was = expected.groups()[group];
                    const bool isGone =
                        was.source[lane] != ContactRows::noPair && fate[was.source[lane]] == 2;
                    if (!isGone) QVERIFY(laneOf(is.normal, lane) == laneOf(was.normal, lane));
                    for (std::uint32_t k = 0; k < is.points; ++k) {
                        const RowPoint &one = rows.points()[is.firstPoint + k],
                                       &two = expected.points()[was.firstPoint + k];
                        for (const auto value : {&RowPoint::massNormal, &RowPoint::massTangent,
                                                 &RowPoint::normal, &RowPoint::along1, &RowPoint::along2})
                            QVERIFY((one.*value)[lane] == (isGone ? 0 : (two.*value)[lane]));
                        if (!isGone) QVERIFY(one.gap[lane] == two.gap[lane]);
                    }
                }
            for (const RollingRow& row : rows.rolling()) {
                const bool isGone = rows.groups()[row.group].source[row.lane] == ContactRows::noPair;
                QVERIFY(isGone == (row.rolling == 0) && (!isGone || row.torque == Vec3::Zero()));
            }
        }
    }

    void groupsOfIndependentPairsAreFull() {
        Random random(test::seed, 2);
        RowScene scene = test::randomBodies(random, 400);
        for (std::uint32_t i = 0; i < 400; i += 2) {
            OwnedPair pair = test::randomPair(random, scene, i, i + 1, {});
            pair.points.resize(2, pair.points.front());
            scene.pairs.push_back(pair);
        }
        QCOMPARE(scene.rows().groups().size(), 200U / wideLanes);
    }

    // Points in the frames of the bodies give the rows that the same points in the world give, and get their
    // forces back.
    void carriedPointsBecomeTheSameRows() {
        constexpr double duration = 0.25;
        Random random(test::seed, 4);
        for (RowScene scene : manyScenes()) {
            std::vector<Mat3> turns;
            std::vector<BodyFrame> frames;
            for (const Vec3& place : scene.places) {
                turns.push_back(fromRotationVector(test::uniformIn(random, 3)).toRotationMatrix());
                frames.emplace_back(turns.back(), place);
            }
            std::vector<std::array<CarriedPoint, 4>> carried(scene.pairs.size());
            ContactRows rows;
            rows.begin(scene.bodies.size(), scene.immobile());
            double deepest = 0;
            for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
                OwnedPair& pair = scene.pairs[i];
                const auto [a, b] = std::pair(pair.laws.a, pair.laws.b);
                const double middle = i % 2 == 0 ? 0.5 : 0;
                for (std::size_t k = 0; k < pair.points.size(); ++k) {
                    CarriedPoint& point = carried[i][k];
                    point = {test::uniformIn(random, 1), test::uniformIn(random, 1),
                             test::uniformIn(random, 1) + pair.laws.normal};
                    const Vec3 onA = turns[a] * point.onA, onB = turns[b] * point.onB;
                    const Vec3 gap = scene.places[b] + onB - scene.places[a] - onA;
                    pair.points[k] = {onA + middle * gap, onB - middle * gap, pair.laws.normal.dot(gap),
                                      duration * point.force};
                    deepest = std::max(deepest, -pair.points[k].separation);
                }
                PairInput laws = pair.laws;
                CarriedPoints points{.frameA = a, .frameB = b, .middle = middle};
                for (; points.count < pair.points.size(); ++points.count)
                    points.points[points.count] = &carried[i][points.count];
                const LanePacker::Place place =
                    rows.placeCarried(a, b, points.count, static_cast<std::uint32_t>(i));
                rows.setCarried(place, laws, points);
                if (laws.rolling > 0) rows.addRolling(laws, place, scene.bodies);
                pair.laws.torque *= duration;
            }
            QVERIFY(std::abs(rows.end(scene.bodies, frames, duration) - deepest) < roundingOfRows);
            QVERIFY(std::abs(rows.moveStart() - deepest) < roundingOfRows); // nothing has moved
            const ContactRows expected = scene.rows();
            QCOMPARE(rows.groups().size(), expected.groups().size());
            QCOMPARE(rows.points().size(), expected.points().size());
            const auto isNear = [](const Wide& one, const Wide& other, std::size_t lane) {
                return std::abs(one[lane] - other[lane]) <=
                       roundingOfRows * std::max({1.0, std::abs(one[lane]), std::abs(other[lane])});
            };
            const std::vector<std::array<CarriedPoint, 4>> before = carried;
            rows.storeForces(duration);
            for (const RowGroup& group : expected.groups())
                for (std::size_t lane = 0; lane < wideLanes; ++lane)
                    for (std::uint32_t k = 0; k < group.points; ++k) {
                        const RowPoint &one = rows.points()[group.firstPoint + k],
                                       &other = expected.points()[group.firstPoint + k];
                        for (const Wide RowPoint::*field :
                             {&RowPoint::start, &RowPoint::gap, &RowPoint::massNormal, &RowPoint::massTangent,
                              &RowPoint::perNormal, &RowPoint::perTangent, &RowPoint::normal,
                              &RowPoint::along1, &RowPoint::along2, &RowPoint::approach})
                            QVERIFY(isNear(one.*field, other.*field, lane));
                        if (!(other.massNormal[lane] > 0)) continue;
                        for (std::size_t axis = 0; axis < 3; ++axis) {
                            QVERIFY(isNear(one.armA[axis], other.armA[axis], lane));
                            QVERIFY(isNear(one.armB[axis], other.armB[axis], lane));
                        }
                        QVERIFY(isNear(one.coupling1, other.coupling1, lane));
                        QVERIFY(isNear(one.coupling2, other.coupling2, lane));
                        const std::size_t source = group.source[lane];
                        const Vec3& was = before[source][k].force;
                        const bool presses = was.dot(scene.pairs[source].laws.normal) > 0;
                        QVERIFY((carried[source][k].force - (presses ? was : Vec3(Vec3::Zero()))).norm() <
                                roundingOfRows);
                    }
            for (std::size_t i = 0; i < rows.rolling().size(); ++i)
                QVERIFY((rows.rolling()[i].torque - expected.rolling()[i].torque).norm() < roundingOfRows);
        }
    }

    // Bodies turn between two steps: rows of those that did have the masses of rows that are made anew, and
    // the others are left as they are, in the same group too.
    void massesAreThoseOfTheBodiesAsTheyHaveTurned() {
        Random random(test::seed, 5);
        for (RowScene scene : manyScenes()) {
            ContactRows rows = scene.rows();
            const ContactRows before = rows;
            std::vector<std::uint8_t> turned(scene.bodies.size(), 0);
            for (std::size_t i = 0; i < scene.mobileCount(); ++i) {
                if (random.below(3) != 0) continue;
                turned[i] = 1;
                const Mat3 turn = fromRotationVector(test::uniformIn(random, 3)).toRotationMatrix();
                SolverBody& body = scene.bodies[i];
                setInverseInertia(turn * carom::inverseInertiaOf(body) * turn.transpose(), body);
            }
            rows.renewMasses(scene.bodies, turned);
            const ContactRows anew = scene.rows();
            const auto isNear = [](double one, double other) {
                return std::abs(one - other) <= roundingOfRows * std::max(1.0, std::abs(other));
            };
            for (const RowGroup& group : rows.groups())
                for (std::size_t lane = 0; lane < wideLanes; ++lane)
                    for (std::uint32_t k = 0; k < group.points; ++k) {
                        const std::size_t number = group.firstPoint + k;
                        const bool hasTurned = (turned[group.a[lane]] | turned[group.b[lane]]) != 0;
                        const RowPoint &is = rows.points()[number], &was = before.points()[number],
                                       &expected = hasTurned ? anew.points()[number] : was;
                        for (const Wide RowPoint::*mass :
                             {&RowPoint::massNormal, &RowPoint::massTangent, &RowPoint::perNormal,
                              &RowPoint::perTangent, &RowPoint::coupling1, &RowPoint::coupling2})
                            QVERIFY(isNear((is.*mass)[lane], (expected.*mass)[lane]));
                        for (const Wide RowPoint::*kept :
                             {&RowPoint::normal, &RowPoint::along1, &RowPoint::along2, &RowPoint::gap})
                            QVERIFY((is.*kept)[lane] == (was.*kept)[lane]);
                    }
            for (std::size_t i = 0; i < rows.rolling().size(); ++i)
                QVERIFY(isNear(rows.rolling()[i].inertia, anew.rolling()[i].inertia));
        }
    }

  private:
    static void comparePoints(const RowScene& scene, const ContactRows& rows, const RowGroup& group,
                              std::size_t lane) {
        const OwnedPair& pair = scene.pairs[group.source[lane]];
        const Vec3 normal = laneOf(group.normal, lane), tangent = laneOf(group.tangent, lane);
        Mat3 frame;
        frame << normal.transpose(), tangent.transpose(), normal.cross(tangent).transpose();
        for (std::uint32_t k = 0; k < group.points; ++k) {
            const RowPoint& row = rows.points()[group.firstPoint + k];
            if (k >= pair.points.size()) { // the fourth of three points does nothing
                QVERIFY(row.massNormal[lane] == 0 && row.massTangent[lane] == 0);
                QVERIFY(rows.impulseOf(group, static_cast<int>(lane), k) == Vec3::Zero());
                continue;
            }
            const PointInput& point = pair.points[k];
            QVERIFY(laneOf(row.armA, lane) == point.armA);
            QVERIFY(laneOf(row.armB, lane) == point.armB);
            QVERIFY(row.gap[lane] == point.separation);
            QVERIFY((rows.impulseOf(group, static_cast<int>(lane), k) - point.impulse).norm() <
                    roundingOfRows);
            const Mat3 response = frame *
                                  responseOf(scene.bodies[pair.laws.a], scene.bodies[pair.laws.b], point) *
                                  frame.transpose();
            QVERIFY(std::abs(row.massNormal[lane] * response(0, 0) - 1) < roundingOfRows);
            const double larger = largerEigenvalue(response(1, 1), response(1, 2), response(2, 2));
            QVERIFY(std::abs(row.massTangent[lane] * larger - 1) < roundingOfRows);
            QVERIFY(std::abs(row.coupling1[lane] - response(0, 1)) < roundingOfRows * response.norm());
            QVERIFY(std::abs(row.coupling2[lane] - response(0, 2)) < roundingOfRows * response.norm());
        }
    }
};

} // namespace carom

CAROM_TEST(contact_rows_test, carom::ContactRowsTest)
#include "contact_rows_test.moc"
