// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dynamics/contact_memory.h"
#include "core/solvers/contacts/contact_settings.h"
#include "core/solvers/contacts/island_motion.h"

#include <algorithm>
#include <limits>
#include <variant>

// A cylinder that stands is held by all of its rim, of which the narrow phase gives four points: on a slope
// it would turn about the chord between two of them before its weight leaves the disc. So after a solution
// a point of the rim that comes down joins the others, and the forces are found again, until none
// comes down: constraints are generated as they are violated (R. Hettich, K. Kortanek, "Semi-infinite
// programming: theory, methods, and applications", SIAM Review 35, 1993). The speed at which
// surfaces part is linear in the place,
//
//     u(x) = u₀ + x · (n × w)        w = ω_B − ω_A,  n the normal
//
// so it is least where the rim is furthest along w × n, in the middle between two points that bear the load.
// Better guesses are where these would bear it as one, towards the centre of pressure; by turns, both are
// sure to halve the arc in two rounds. How fast a point over a short arc comes down is a small part of the
// speed at which the body turns, so what is found next is solved for to a finer tolerance.

namespace carom {
namespace {

/// Points no further apart than this part of the smaller body are one; forces could not be told apart. Where
/// it is the height that makes it large a disc of a tenth of that seems smaller by 5e-4 of its radius.
constexpr double leastDistance = 0.01;
/// Solves of a part at most, each with other points of rims. At half, a disc may be left that sinks in at a
/// place of its rim; at twice, such a part costs up to twice as much.
constexpr int mostRimRounds = 8;
/// A distance at which a place stands for a direction, in units of the body's size: the directions from two
/// places of the body differ by a millionth. Twice or half changes that only.
constexpr double farAway = 1e6;
/// A point that bears up to this part of what another one of the contact bears may be replaced. At a tenth,
/// there is less often a place for a new point; at ten times, points are replaced that bear a hundredth of
/// the load.
constexpr double idlePart = 1e-3;

} // namespace

// Solves again with points of rims added that the solution lets move into the other body.
void IslandMotion::holdRims(const MotionInput& input, double duration, bool findsImpacts) {
    const double tolerance = m_tolerance;
    for (int round = 0; round < mostRimRounds && !m_unsolved && remaining(input) > 0; ++round) {
        const double closing = addRimPoints(input, round % 2 != 0);
        if (!(closing > 0)) break;
        double fastest = 0;
        for (const ContactBody& body : m_problem.bodies) fastest = std::max(fastest, fastestPart(body));
        m_tolerance = std::max({std::min(m_tolerance, finerTolerance * closing), leastTolerance * m_scale,
                                speedRounding * fastest});
        keepForces(duration);
        beginPart(input, duration);
        chooseRows(input, duration, findsImpacts);
        solveForces(input, duration);
    }
    m_tolerance = tolerance;
}

// Adds such points. Returns the closing speed of the slowest one [m/s]; 0 if there is none. A point that is
// in the contact already counts if the body is nearly at rest: then the tolerance of the solve lets it turn.
double IslandMotion::addRimPoints(const MotionInput& input, bool fastest) {
    const auto spinOf = [&](BodyIndex body) -> Vec3 {
        const int local = localOf(body);
        if (local == immobile) return Vec3::Zero();
        return m_problem.bodies[at(local)].velocity.tail<3>();
    };
    const auto isCylinder = [&](BodyIndex body) {
        return std::holds_alternative<Cylinder>(input.bodies.shape[body]);
    };
    double slowest = 0;
    for (std::uint32_t p = 0; p < m_contacts.pairs.size(); ++p) {
        const ContactPair pair = m_contacts.pairs[p];
        if (pair.count < 2 || (!isCylinder(pair.a) && !isCylinder(pair.b))) continue;
        const Mat3 frame = m_contacts.points[pair.first].frame;
        const Vec3 down = (spinOf(pair.b) - spinOf(pair.a)).cross(Vec3(frame.row(0)));
        const double speed = down.norm() * pair.size;
        if (speed <= m_still) continue;
        const Vec3& centre = input.state.pose[input.bodies.mobile[pair.a] != 0 ? pair.a : pair.b].position;
        const Vec3 towards = fastest ? Vec3(centre + farAway * pair.size * down.normalized())
                                     : Vec3(centre + centreOfPressure(input.bodies, p));
        m_onRims.clear();
        appendRimPoints(input.bodies, input.state, pair.bodies(), frame, towards, m_onRims);
        for (const ContactConstraint& point : m_onRims) {
            const double closing = -relativeVelocity(m_problem, rowOf(input.bodies, pair, point)).x();
            if (point.separation > touchingWithin(pair) || !(closing > 0)) continue;
            const std::span<const ContactConstraint> points = m_contacts.pointsOf(m_contacts.pairs[p]);
            const bool isThere = std::any_of(points.begin(), points.end(), [&](const ContactConstraint& old) {
                return (old.anchor - point.anchor).norm() <= leastDistance * pair.size;
            });
            if (isThere ? speed > nearlyStill * m_still : !insertPoint(p, point)) continue;
            slowest = slowest > 0 ? std::min(slowest, closing) : closing;
        }
    }
    return slowest;
}

// The centre of pressure of a pair, relative to the centre of its first mobile body [m]; that itself where no
// point bears.
Vec3 IslandMotion::centreOfPressure(const Bodies& bodies, std::uint32_t index) const {
    const ContactPair& pair = m_contacts.pairs[index];
    Vec3 sum = Vec3::Zero();
    double force = 0;
    for (std::size_t i = 0; i < m_rowPoint.size(); ++i) {
        if (m_pairOf[m_rowPoint[i]] != index) continue;
        const ContactRow& row = m_problem.rows[i];
        sum += row.impulse.x() * (bodies.mobile[pair.a] != 0 ? row.armA : row.armB);
        force += row.impulse.x();
    }
    return force > 0 ? Vec3(sum / force) : sum;
}

// False if the contact has no room for another.
bool IslandMotion::insertPoint(std::uint32_t index, const ContactConstraint& point) {
    ContactPair& pair = m_contacts.pairs[index];
    if (pair.count < Manifold::capacity) {
        const std::uint32_t place = pair.first + pair.count++;
        m_contacts.points.insert(m_contacts.points.begin() + place, point);
        m_pairOf.insert(m_pairOf.begin() + place, index);
        for (std::uint32_t& number : m_rowPoint) number += number >= place ? 1 : 0;
        for (std::uint32_t k = index + 1; k < m_contacts.pairs.size(); ++k) ++m_contacts.pairs[k].first;
        return true;
    }
    // Replaces the nearest point that bears next to nothing.
    double most = 0;
    for (const ContactConstraint& old : m_contacts.pointsOf(pair)) most = std::max(most, old.force.x());
    ContactConstraint* idle = nullptr;
    double nearest = std::numeric_limits<double>::infinity();
    for (ContactConstraint& old : m_contacts.pointsOf(pair)) {
        const double distance = (old.anchor - point.anchor).squaredNorm();
        if (old.force.x() > idlePart * most || !(distance < nearest)) continue;
        nearest = distance;
        idle = &old;
    }
    if (idle == nullptr) return false;
    *idle = point;
    return true;
}

} // namespace carom
