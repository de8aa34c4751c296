// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/events/event_gas.h"
#include "core/solvers/joint_impulses.h"

#include <algorithm>
#include <cmath>

// Clusters of simultaneous impacts: a rack that is broken, a ball hit from two sides at once. The impacts
// have no order in time, and in an order by place the mirror image of a scene would move in another way. So
// the rule of method `contacts` (contacts/impacts.h) holds here, too: of all pairs of touching balls the one
// that closes fastest collides first, together with those that tie with it; ties that share a ball are solved
// for jointly,
//
//     W p = −(1+e) u      Wₖₗ = sum over the balls of pairs k and l of ± nₖ·nₗ/m,  u = n·(vⱼ − vᵢ) before
//
// in both orders of elimination, averaged. What closes then is the next event, at the same time. Solving all
// that touch at once instead would make all balls of Newton's cradle move.

namespace carom {
namespace {

/// Balls with a gap up to this part of the sum of their radii touch: far above the rounding of positions
/// near the scene, far below any gap that is intended. At a hundredth, rounding would separate touching
/// balls; at a million times, balls that meet a little later would collide at once.
constexpr double touching = 1e-12;
/// Speeds that differ by less than this part of the fastest are simultaneous: rounding of a symmetric scene
/// stays below a thousandth of it, and intended differences are above. At a millionth, rounding would break
/// symmetry.
constexpr double tie = 1e-9;
/// A cluster of touching balls is followed so far: enough for racks of 31 rows. What is beyond is hit one
/// after the other, so at half of it larger racks may break unsymmetrically.
constexpr std::size_t mostTouching = 512;

} // namespace

// Whether another event has the same time: of a ball with two predicted collisions at one time the record
// says so, the others are in the queue.
bool EventGas::isInCluster(std::uint32_t i, std::uint32_t j, double time) {
    if ((m_records[i].tied | m_records[j].tied) != 0) return true;
    if (!m_queue.mayHaveMore(time + m_tie)) return false;
    m_queue.remove(m_records, j); // it may have predicted the same collision
    return earliest(time + m_tie) != nobody;
}

// All pairs that touch, from i and j on over mobile balls.
void EventGas::gatherCluster(std::uint32_t i, std::uint32_t j, double time) {
    m_cluster.assign({i, j});
    m_touches.clear();
    for (std::size_t member = 0; member < m_cluster.size(); ++member) {
        const std::uint32_t ball = m_cluster[member];
        if (!isMobile(ball)) continue;
        const Vec3 position = positionAt(m_origins[ball], accelerationOf(ball), time);
        const Vec3 velocity = velocityAt(m_origins[ball], accelerationOf(ball), time);
        m_cells.aroundBall(m_records, ball, [&](std::uint32_t k) {
            const Vec3 between = positionAt(m_origins[k], accelerationOf(k), time) - position;
            const double radii = m_origins[ball].radius + m_origins[k].radius;
            const double distance = between.norm();
            if (!(distance - radii <= touching * radii)) return;
            const auto known = std::find(m_cluster.begin(), m_cluster.end(), k);
            const std::size_t place = static_cast<std::size_t>(known - m_cluster.begin());
            if (place < member && isMobile(k)) return; // the other one has found it
            if (known == m_cluster.end() && m_cluster.size() < mostTouching) m_cluster.push_back(k);
            Touch touch{std::min(ball, k), std::max(ball, k)};
            touch.normal = (k == touch.b ? 1 : -1) * between / distance;
            const Vec3 relative = velocityAt(m_origins[k], accelerationOf(k), time) - velocity;
            touch.closing = -between.dot(relative) / distance;
            const bool justMet = m_records[ball].last == k && m_records[k].last == ball;
            if (touch.closing > 0 && !justMet) m_touches.push_back(touch);
        });
    }
    m_lookedAt += m_cluster.size();
}

void EventGas::collideCluster(std::uint32_t i, std::uint32_t j, double time) {
    gatherCluster(i, j, time);
    double fastest = 0;
    for (const Touch& touch : m_touches) fastest = std::max(fastest, touch.closing);
    if (m_touches.empty()) { // the two do not touch, by rounding
        m_touches.push_back({std::min(i, j), std::max(i, j)});
        fastest = 0;
    }
    std::erase_if(m_touches, [&](const Touch& touch) { return touch.closing < (1 - tie) * fastest; });
    std::sort(m_touches.begin(), m_touches.end(),
              [this](const Touch& x, const Touch& y) { return pairBefore(x.a, x.b, y.a, y.b); });

    m_cluster.clear();
    for (const Touch& touch : m_touches)
        for (const std::uint32_t ball : {touch.a, touch.b})
            if (std::find(m_cluster.begin(), m_cluster.end(), ball) == m_cluster.end())
                m_cluster.push_back(ball);
    for (const std::uint32_t ball : m_cluster) {
        m_queue.remove(m_records, ball);
        moveOrigin(ball, time);
    }
    while (!m_touches.empty()) {
        takeGroup();
        collideJointly(time);
    }
    for (const std::uint32_t ball : m_cluster) finishCollision(ball);
    for (const std::uint32_t ball : {i, j}) // these were taken from the queue, and others came first
        if (std::find(m_cluster.begin(), m_cluster.end(), ball) == m_cluster.end() && isMobile(ball)) {
            m_queue.remove(m_records, ball);
            planPairs(ball);
            m_queue.insert(m_records, ball);
        }
}

// Takes a first pair and all that share mobile balls with it out of m_touches, into m_group.
void EventGas::takeGroup() {
    m_group.assign(1, m_touches.front());
    m_touches.erase(m_touches.begin());
    const auto shares = [this](const Touch& x, const Touch& y) {
        return (isMobile(x.a) && (x.a == y.a || x.a == y.b)) || (isMobile(x.b) && (x.b == y.a || x.b == y.b));
    };
    for (std::size_t member = 0; member < m_group.size(); ++member)
        for (std::size_t k = 0; k < m_touches.size();) {
            if (shares(m_group[member], m_touches[k])) {
                m_group.push_back(m_touches[k]);
                m_touches.erase(m_touches.begin() + static_cast<std::ptrdiff_t>(k));
            } else {
                ++k;
            }
        }
}

void EventGas::collideJointly(double time) {
    const Eigen::Index size = static_cast<Eigen::Index>(m_group.size());
    JointValues impulses;
    bool areJoint = false;
    if (size > 1 && size <= mostJointContacts) {
        JointResponse w(size, size);
        JointValues wanted(size);
        const auto coupling = [this](const Touch& x, const Touch& y) {
            const double along = x.normal.dot(y.normal);
            double sum = 0;
            if (x.a == y.a) sum += inverseMassOf(x.a) * along;
            if (x.b == y.b) sum += inverseMassOf(x.b) * along;
            if (x.a == y.b) sum -= inverseMassOf(x.a) * along;
            if (x.b == y.a) sum -= inverseMassOf(x.b) * along;
            return sum;
        };
        for (Eigen::Index k = 0; k < size; ++k) {
            const Touch& touch = m_group[static_cast<std::size_t>(k)];
            wanted[k] = touch.closing + separationSpeedAt(touch, time);
            for (Eigen::Index l = 0; l < size; ++l)
                w(k, l) = coupling(touch, m_group[static_cast<std::size_t>(l)]);
        }
        areJoint = jointImpulses(w, wanted, impulses);
    }
    if (!areJoint) { // alone, or too many: by place
        for (const Touch& touch : m_group) collidePair(touch.a, touch.b, time);
        return;
    }
    for (Eigen::Index k = 0; k < size; ++k) {
        const Touch& touch = m_group[static_cast<std::size_t>(k)];
        push(touch.a, touch.b, touch.normal, impulses[k]);
        m_records[touch.a].last = touch.b;
        m_records[touch.b].last = touch.a;
        ++m_counts.collisions;
    }
}

} // namespace carom
