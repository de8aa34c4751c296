// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/ball_rows.h"

#include "core/solvers/contacts/contact_law.h"
#include "core/solvers/contacts/manifolds.h"

#include <algorithm>
#include <limits>

namespace carom {
namespace {

CAROM_INLINE Wide3 gatherPlace(const BodyPlace* places, const std::array<std::uint32_t, 4>& index) {
    return gatherThree<BodyPlace>(places->position.data(), index);
}

CAROM_INLINE Wide3 choose(const auto& where, const Wide3& one, const Wide3& other) {
    return {where ? one.x : other.x, where ? one.y : other.y, where ? one.z : other.z};
}

/// Applies impulses along n, t1 and t2 to both bodies.
CAROM_INLINE void apply(const BallGroup& group, const Wide3& n, const Wide3& t1, const Wide3& t2,
                        const Wide3& impulse, Motion& a, Motion& b) {
    const Wide3 p = impulse.x * n + impulse.y * t1 + impulse.z * t2;
    const Wide3 turning = impulse.y * t2 - impulse.z * t1; // n × p
    a.velocity = a.velocity - a.inverseMass * p;
    b.velocity = b.velocity + b.inverseMass * p;
    a.spin = a.spin - (a.roundInverse * group.radiusA) * turning;
    b.spin = b.spin - (b.roundInverse * group.radiusB) * turning;
}

/// Velocity of B's contact point relative to A's.
CAROM_INLINE Wide3 relativeVelocity(const BallGroup& group, const Wide3& n, const Motion& a,
                                    const Motion& b) {
    const Wide3 spin = group.radiusB * b.spin + group.radiusA * a.spin;
    return b.velocity - a.velocity - cross(spin, n);
}

CAROM_INLINE Wide gapNow(const BallGroup& group, const Wide3& n, const Displacement* moved) {
    return group.gap + dot(n, gatherShift(moved, group.b) - gatherShift(moved, group.a));
}

template<Pass pass>
CAROM_INLINE void solveGroup(BallGroup& group, SolverBody* bodies, const Displacement* moved,
                             const StepSettings& settings, const Softnesses& softness, Wide& worst) {
    if (group.idle) return;
    Motion a, b;
    gatherVelocity(bodies, group.a, a);
    gatherVelocity(bodies, group.b, b);
    const Wide3 n = load(group.normal), t1 = load(group.tangent), t2 = cross(n, t1);
    const Wide3 u = relativeVelocity(group, n, a, b);
    const Wide3 change = solvePoint<pass>({dot(n, u), dot(t1, u), dot(t2, u)}, gapNow(group, n, moved), group,
                                          select(group.hard, softness), settings.duration, group.row, worst);
    apply(group, n, t1, t2, change, a, b);
    scatter(bodies, group.a, a);
    scatter(bodies, group.b, b);
}

/// Removes from the velocities of a group the effect of contacts whose impulses have grown by more than a
/// closing speed at rest explains: impacts, which are then treated by Newton's law.
CAROM_INLINE void takeBack(BallGroup& group, SolverBody* bodies, double resting, const ActiveBodies& active) {
    if (group.idle || !group.bounces) return;
    BallRow& row = group.row;
    const Wide zero{}, one = wideOf(1), added = row.normal - row.carried;
    const auto isStruck = (added > resting * row.massNormal) & (group.restitution > zero);
    const Wide lanes = isStruck ? one : zero;
    if (!anyLane(lanes)) return;
    const Wide part = isStruck ? added / row.normal : zero;
    const Wide3 back{-part * row.normal, -part * row.along1, -part * row.along2};
    Motion a, b;
    gatherVelocity(bodies, group.a, a);
    gatherVelocity(bodies, group.b, b);
    const Wide3 n = load(group.normal), t1 = load(group.tangent);
    apply(group, n, t1, cross(n, t1), back, a, b);
    scatter(bodies, group.a, a);
    scatter(bodies, group.b, b);
    activateLanes(group, lanes, active);
}

/// Solves impacts of pairs that touch and close, with Newton's law, if an impact has changed the velocity of
/// one of their bodies in the pass before or in this one. Returns the closing speeds of those that bounce
/// [m/s].
CAROM_INLINE Wide strike(const BallGroup& group, SolverBody* bodies, const Displacement* moved,
                         const Wide& resting, int pass, const ActiveBodies& active) {
    const Wide zero{}, one = wideOf(1);
    if (group.idle) return zero;
    Wide activeIn{};
    for (std::size_t lane = 0; lane < wideLanes; ++lane)
        activeIn[lane] = std::max(active.bodies[group.a[lane]], active.bodies[group.b[lane]]);
    const auto isActive = activeIn >= wideOf(pass);
    if (!anyLane(isActive ? one : zero)) return zero;
    Motion a, b;
    gatherVelocity(bodies, group.a, a);
    gatherVelocity(bodies, group.b, b);
    const Wide3 n = load(group.normal), t1 = load(group.tangent), t2 = cross(n, t1);
    const Wide3 u = relativeVelocity(group, n, a, b);
    const Wide closing = -dot(n, u);
    const auto touches = gapNow(group, n, moved) <= openBeyond * (group.radiusA + group.radiusB);
    const auto meets = isActive & touches & (closing > zero) & (group.row.massNormal > zero);
    const auto bounces = meets & (closing > resting) & (group.restitution > zero);
    if (!anyLane(meets ? one : zero)) return zero;
    const Wide normal =
        meets ? group.row.massNormal * closing * (bounces ? one + group.restitution : one) : zero;
    const Wide q1 = -group.row.massTangent * dot(t1, u), q2 = -group.row.massTangent * dot(t2, u);
    const Wide most = group.friction * normal, size = rootOf(q1 * q1 + q2 * q2);
    const Wide part = size > most ? most / (size > zero ? size : one) : one;
    apply(group, n, t1, t2, {normal, meets ? part * q1 : zero, meets ? part * q2 : zero}, a, b);
    scatter(bodies, group.a, a);
    scatter(bodies, group.b, b);
    const Wide fastest = meets & (closing > resting) ? closing : zero;
    activateLanes(group, fastest, active, static_cast<std::uint8_t>(pass + 1));
    return bounces ? closing : zero;
}

/// Reduces the force of pairs that separate faster than a contact at rest to what it was when the step began.
CAROM_INLINE void forgetImpact(BallGroup& group, const SolverBody* bodies, double resting) {
    if (group.idle || !group.bounces) return;
    Motion a, b;
    gatherVelocity(bodies, group.a, a);
    gatherVelocity(bodies, group.b, b);
    const Wide zero{}, one = wideOf(1);
    const Wide separation = dot(load(group.normal), b.velocity - a.velocity);
    BallRow& row = group.row;
    const auto leaves = (separation > wideOf(resting)) & (row.normal > zero) & (group.restitution > zero);
    if (!anyLane(leaves ? one : zero)) return;
    const Wide part = leaves ? smaller(row.carried / row.normal, one) : one;
    row.normal = part * row.normal;
    row.along1 = part * row.along1;
    row.along2 = part * row.along2;
}

struct Sweep {
    std::span<BallGroup> groups;
    SolverBody* bodies;
    const Displacement* moved;
    const StepSettings& settings;
    bool back;
};

template<Pass pass>
CAROM_INLINE double sweepGroups(const Sweep& with) {
    Wide worst{};
    const Softnesses softness = softnessesOf(with.settings);
    const std::size_t count = with.groups.size();
    for (std::size_t i = 0; i < count; ++i)
        solveGroup<pass>(with.groups[with.back ? count - 1 - i : i], with.bodies, with.moved, with.settings,
                         softness, worst);
    return std::max(std::max(worst[0], worst[1]), std::max(worst[2], worst[3]));
}

CAROM_WIDE double sweep(Pass pass, const Sweep& with) {
    switch (pass) {
    case Pass::Relax:
        return sweepGroups<Pass::Relax>(with);
    case Pass::Rebound: // strikes
    case Pass::Feedback:
        break;
    }
    return sweepGroups<Pass::Feedback>(with);
}

CAROM_WIDE void passBack(std::span<BallGroup> groups, SolverBody* bodies, double resting,
                         const ActiveBodies& active) {
    for (BallGroup& group : groups) takeBack(group, bodies, resting, active);
}

// True if any bounced.
CAROM_WIDE bool passStrikes(std::span<const BallGroup> groups, SolverBody* bodies, const Displacement* moved,
                            double resting, int pass, const ActiveBodies& active) {
    const bool back = pass % 2 == 0;
    Wide fastest{};
    const std::size_t count = groups.size();
    for (std::size_t i = 0; i < count; ++i)
        fastest = larger(
            fastest, strike(groups[back ? count - 1 - i : i], bodies, moved, wideOf(resting), pass, active));
    return anyLane(fastest);
}

CAROM_WIDE bool passApproach(BallGroup* groups, std::size_t count, const SolverBody* bodies, double resting) {
    Wide any{};
    for (std::size_t i = 0; i < count; ++i) {
        BallGroup& group = groups[i];
        if (group.idle || !group.bounces) continue;
        Motion a, b;
        gatherVelocity(bodies, group.a, a);
        gatherVelocity(bodies, group.b, b);
        group.row.carried = group.row.normal;
        const Wide closing = dot(load(group.normal), a.velocity - b.velocity);
        group.row.approach = approachOf(group, group.row, closing, resting);
        any = larger(any, group.row.approach);
    }
    return anyLane(any);
}

CAROM_WIDE void passWarm(const BallGroup* groups, std::size_t count, SolverBody* bodies) {
    for (std::size_t i = 0; i < count; ++i) {
        const BallGroup& group = groups[i];
        if (group.idle) continue;
        Motion a, b;
        gatherVelocity(bodies, group.a, a);
        gatherVelocity(bodies, group.b, b);
        const Wide3 n = load(group.normal), t1 = load(group.tangent);
        apply(group, n, t1, cross(n, t1), {group.row.normal, group.row.along1, group.row.along2}, a, b);
        scatter(bodies, group.a, a);
        scatter(bodies, group.b, b);
    }
}

/// One pair of a group, with its rows.
void copyLane(const BallGroup& from, std::size_t lane, BallGroup& to, std::size_t toLane) {
    to.a[toLane] = from.a[lane];
    to.b[toLane] = from.b[lane];
    for (std::size_t k = 0; k < 3; ++k) {
        to.normal[k][toLane] = from.normal[k][lane];
        to.tangent[k][toLane] = from.tangent[k][lane];
    }
    for (Wide BallGroup::*value :
         {&BallGroup::radiusA, &BallGroup::radiusB, &BallGroup::friction, &BallGroup::restitution,
          &BallGroup::push, &BallGroup::hard, &BallGroup::gap})
        (to.*value)[toLane] = (from.*value)[lane];
    for (Wide BallRow::*value : {&BallRow::massNormal, &BallRow::massTangent, &BallRow::normal,
                                 &BallRow::along1, &BallRow::along2, &BallRow::approach, &BallRow::carried})
        (to.row.*value)[toLane] = (from.row.*value)[lane];
}

} // namespace

struct BallRows::Refresh {
    BallGroup* groups;
    const Fixed* fixed;
    std::size_t count;
    const SolverBody* bodies;
    const BodyPlace* places;
    const Displacement* moved; ///< null: no body has moved
    double duration;
    Vec3 gravity;
};

// Updates all lanes, or those that are `struck`. Always inlined into the wide versions below.
[[gnu::always_inline]] inline void BallRows::refreshGroup(const Refresh& with, std::size_t i,
                                                          const Wide* struck) {
    BallGroup& group = with.groups[i];
    if (group.held) return;
    BallRow& row = group.row;
    const Fixed& fixed = with.fixed[i];
    Motion a, b;
    gatherVelocity(with.bodies, group.a, a);
    gatherVelocity(with.bodies, group.b, b);
    const Wide3 d = gatherPlace(with.places, group.b) - gatherPlace(with.places, group.a) - load(fixed.place);
    const Wide zero{}, one = wideOf(1), duration = wideOf(with.duration);
    const auto isWall = fixed.wall > zero;
    const Wide3 old = load(group.normal);
    const Wide centres = rootOf(dot(d, d));
    const Wide distance = isWall ? dot(old, d) : centres, radii = group.radiusA + group.radiusB;
    const Wide gap = distance - radii;

    // The time of impact, or of the closest approach, within `duration`. If one of the bodies does not move,
    // the other accelerates with gravity relative to it.
    Wide3 v = b.velocity - a.velocity;
    const Wide half = 0.5 * duration;
    const Wide falls = a.inverseMass == zero ? half : (b.inverseMass == zero ? -half : zero);
    v = v + Wide3{falls * with.gravity.x(), falls * with.gravity.y(), falls * with.gravity.z()};
    const Wide closing = -dot(d, v), square = dot(v, v);
    const Wide inner = closing * closing - square * (distance * distance - radii * radii);
    const Wide impactTime =
        inner > zero ? gap * (distance + radii) / (closing + rootOf(larger(inner, zero))) : closing / square;
    const Wide time = closing > zero ? smaller(impactTime, duration) : zero;
    const Wide3 then = d + time * v;
    const Wide thenCentres = rootOf(dot(then, then));
    const Wide least = isWall ? gap + smaller(zero, duration * dot(old, v)) : thenCentres - radii;

    const double fall = with.gravity.norm() * with.duration * with.duration;
    const Wide smallest = isWall ? group.radiusB : smaller(group.radiusA, group.radiusB);
    const Wide slack = slackPart * smallest + wideOf(fall);
    const auto used = fixed.massNormal > zero;
    const auto meets = used & ((gap <= slack) | (least <= slack));

    const auto ahead = (gap > openBeyond * radii) & (thenCentres > zero);
    const Wide3 towards = choose(ahead, then, d);
    const Wide length = ahead ? thenCentres : centres;
    const auto turns = used & (fixed.wall == zero) & (length > zero);
    const Wide per = one / (turns ? length : one);
    const Wide3 n = choose(turns, per * towards, old);
    const Wide3 t = tangentOf(n), t2 = cross(n, t);
    Wide now = dot(n, d) - radii;
    if (with.moved != nullptr) // the contact law adds it again
        now = now - dot(n, gatherShift(with.moved, group.b) - gatherShift(with.moved, group.a));

    const Wide3 oldT = load(group.tangent);
    const Wide3 friction = row.along1 * oldT + row.along2 * cross(old, oldT);
    const Wide lanes = struck != nullptr ? *struck : one;
    const auto changes = lanes > zero, acts = struck != nullptr ? changes : meets;
    row.normal = changes ? (meets ? row.normal : zero) : row.normal;
    row.along1 = changes ? (meets ? dot(t, friction) : zero) : row.along1;
    row.along2 = changes ? (meets ? dot(t2, friction) : zero) : row.along2;
    row.massNormal = changes ? (acts ? fixed.massNormal : zero) : row.massNormal;
    row.massTangent = changes ? (acts ? fixed.massTangent : zero) : row.massTangent;
    store(group.normal, choose(changes, n, old));
    store(group.tangent, choose(changes, t, oldT));
    group.gap = changes ? (used | (fixed.isHeld > zero) ? now : zero) : group.gap;
    const auto solved = row.massNormal > zero;
    group.idle = !anyLane(solved ? one : zero);
    group.watched = anyLane(used & (row.massNormal == zero) ? one : zero);
}

CAROM_WIDE void BallRows::refreshAll(const Refresh& with) {
    for (std::size_t i = 0; i < with.count; ++i) refreshGroup(with, i, nullptr);
}

CAROM_WIDE bool BallRows::findStruckIn(const Refresh& with) {
    bool any = false;
    for (std::size_t i = 0; i < with.count; ++i) {
        const BallGroup& group = with.groups[i];
        if (!group.watched) continue;
        Motion a, b;
        gatherVelocity(with.bodies, group.a, a);
        gatherVelocity(with.bodies, group.b, b);
        const Wide3 moved = gatherShift(with.moved, group.b) - gatherShift(with.moved, group.a);
        const Wide3 n = load(group.normal);
        const Wide then = group.gap + dot(n, moved + wideOf(with.duration) * (b.velocity - a.velocity));
        const auto isWatched = (with.fixed[i].massNormal > Wide{}) & (group.row.massNormal == Wide{});
        const Wide closes = isWatched & (then < Wide{}) ? wideOf(1) : Wide{};
        if (!anyLane(closes)) continue;
        refreshGroup(with, i, &closes);
        any = true;
    }
    return any;
}

void BallRows::clear() {
    m_groups.clear();
    m_fixed.clear();
    m_packer.clear();
    m_active = m_watched = 0;
    m_heldDeepest = 0;
}

BallGroup BallRows::emptyGroup(std::uint32_t immobile) {
    BallGroup group;
    group.a.fill(immobile);
    group.b.fill(immobile);
    group.normal[1] = wideOf(1);
    group.tangent[0] = wideOf(1);
    return group;
}

void BallRows::add(const BallPair& pair, std::uint32_t source, std::uint32_t immobile,
                   std::span<const SolverBody> bodies) {
    m_packer.reserve(bodies.size());
    const LanePacker::Place place = m_packer.place(pair.a, pair.b, immobile);
    if (place.isNew) {
        m_groups.push_back(emptyGroup(immobile));
        m_fixed.emplace_back();
    }
    BallGroup& group = m_groups[place.group];
    Fixed& fixed = m_fixed[place.group];
    const std::size_t lane = place.lane;
    const auto set = [lane](std::array<Wide, 3>& to, const Vec3& value) {
        for (std::size_t k = 0; k < 3; ++k) to[k][lane] = value[static_cast<Eigen::Index>(k)];
    };
    group.a[lane] = pair.a;
    group.b[lane] = pair.b;
    group.radiusA[lane] = pair.radiusA;
    group.radiusB[lane] = pair.radiusB;
    group.friction[lane] = pair.friction;
    group.restitution[lane] = pair.restitution;
    group.push[lane] = pair.push;
    group.hard[lane] = pair.a == immobile ? 1 : 0;
    group.bounces = group.bounces || pair.restitution > 0;
    setMasses(group, lane, bodies, fixed);
    group.row.massNormal[lane] = fixed.massNormal[lane];
    group.row.massTangent[lane] = fixed.massTangent[lane];
    group.held = false;
    const Wide3 n{wideOf(pair.normal.x()), wideOf(pair.normal.y()), wideOf(pair.normal.z())};
    const Wide3 t = tangentOf(n);
    const Vec3 tangent(t.x[0], t.y[0], t.z[0]);
    set(group.normal, pair.normal);
    set(group.tangent, tangent);
    const double pressing = pair.normal.dot(pair.impulse);
    const Vec3 impulse =
        pressing > 0 ? pair.impulse : Vec3(Vec3::Zero()); // else the bodies have passed each other
    group.row.normal[lane] = std::max(pressing, 0.0);
    group.row.along1[lane] = tangent.dot(impulse);
    group.row.along2[lane] = pair.normal.cross(tangent).dot(impulse);
    set(fixed.place, pair.fixed);
    fixed.wall[lane] = pair.wall ? 1 : 0;
    fixed.source[lane] = source;
}

void BallRows::copyFixed(const Fixed& from, std::size_t lane, Fixed& to, std::size_t toLane) {
    for (std::size_t k = 0; k < 3; ++k) to.place[k][toLane] = from.place[k][lane];
    for (Wide Fixed::*value : {&Fixed::wall, &Fixed::massNormal, &Fixed::massTangent, &Fixed::isHeld})
        (to.*value)[toLane] = (from.*value)[lane];
    for (std::size_t k = 0; k < 3; ++k) to.held[k][toLane] = from.held[k][lane];
    to.source[toLane] = from.source[lane];
}

void BallRows::reorder(std::span<const std::uint32_t> sources, std::uint32_t immobile) {
    std::swap<std::vector<BallGroup>>(m_groups, m_before);
    std::swap<std::vector<Fixed>>(m_fixed, m_fixedBefore);
    m_groups.clear();
    m_fixed.clear();
    m_groups.reserve(m_before.size());
    m_fixed.reserve(m_before.size());
    m_packer.restart();
    for (std::uint32_t i = 0; i < m_fixedBefore.size(); ++i)
        for (std::uint32_t lane = 0; lane < wideLanes; ++lane) {
            const std::uint32_t source = m_fixedBefore[i].source[lane];
            if (source == noPair) continue;
            if (m_laneOf.size() <= source) m_laneOf.resize(source + 1);
            m_laneOf[source] = wideLanes * i + lane;
        }
    for (const std::uint32_t source : sources) {
        const std::uint32_t from = m_laneOf[source] / wideLanes, lane = m_laneOf[source] % wideLanes;
        const BallGroup& group = m_before[from];
        const LanePacker::Place place = m_packer.place(group.a[lane], group.b[lane], immobile);
        if (place.isNew) {
            m_groups.push_back(emptyGroup(immobile));
            m_fixed.emplace_back();
        }
        BallGroup& to = m_groups[place.group];
        copyLane(group, lane, to, place.lane);
        copyFixed(m_fixedBefore[from], lane, m_fixed[place.group], place.lane);
        to.bounces = to.bounces || to.restitution[place.lane] > 0;
    }
    markHeld();
    countGroups();
}

void BallRows::keep(std::span<const std::uint32_t> sources, std::span<const std::uint32_t> bodies,
                    std::uint32_t immobile) {
    m_packer.restart();
    const BallGroup empty = emptyGroup(immobile);
    std::uint32_t kept = 0;
    for (std::size_t i = 0; i < m_groups.size(); ++i) {
        BallGroup& group = m_groups[i];
        Fixed& fixed = m_fixed[i];
        unsigned used = 0;
        for (std::size_t lane = 0; lane < wideLanes; ++lane) {
            if (fixed.source[lane] == noPair) continue;
            fixed.source[lane] = sources[fixed.source[lane]];
            if (fixed.source[lane] == noPair) {
                copyLane(empty, lane, group, lane);
                for (Wide& place : fixed.place) place[lane] = 0;
                for (Wide& impulse : fixed.held) impulse[lane] = 0;
                fixed.wall[lane] = fixed.massNormal[lane] = fixed.massTangent[lane] = fixed.isHeld[lane] = 0;
                continue;
            }
            group.a[lane] = bodies[group.a[lane]];
            group.b[lane] = bodies[group.b[lane]];
            used |= 1U << lane;
        }
        if (used == 0) continue;
        m_packer.keep(group.a, group.b, used);
        if (kept != i) {
            m_groups[kept] = group;
            m_fixed[kept] = fixed;
        }
        ++kept;
    }
    m_groups.resize(kept);
    m_fixed.resize(kept);
    markHeld();
    countGroups();
}

// A pair of two bodies that stand still or cannot move has no effective mass: it is 0 here.
void BallRows::setMasses(const BallGroup& group, std::size_t lane, std::span<const SolverBody> bodies,
                         Fixed& fixed) {
    const SolverBody &a = bodies[group.a[lane]], &b = bodies[group.b[lane]];
    const double radiusA = group.radiusA[lane], radiusB = group.radiusB[lane];
    const double masses = a.inverseMass + b.inverseMass;
    fixed.massNormal[lane] = masses > 0 ? 1 / masses : 0;
    fixed.massTangent[lane] =
        masses > 0 ? 1 / (masses + a.roundInverse * radiusA * radiusA + b.roundInverse * radiusB * radiusB)
                   : 0;
}

void BallRows::hold(std::span<const std::uint8_t> still, std::span<const std::uint8_t> changed,
                    std::span<const SolverBody> bodies) {
    for (std::size_t i = 0; i < m_groups.size(); ++i) {
        BallGroup& group = m_groups[i];
        Fixed& fixed = m_fixed[i];
        for (std::size_t lane = 0; lane < wideLanes; ++lane) {
            if ((changed[group.a[lane]] | changed[group.b[lane]]) == 0 || fixed.source[lane] == noPair)
                continue;
            const bool isHeld = (still[group.a[lane]] & still[group.b[lane]]) != 0;
            setMasses(group, lane, bodies, fixed);
            if (isHeld == (fixed.isHeld[lane] > 0)) continue;
            fixed.isHeld[lane] = isHeld ? 1 : 0;
            Wide* const held[] = {&fixed.held[0], &fixed.held[1], &fixed.held[2]};
            Wide* const solved[] = {&group.row.normal, &group.row.along1, &group.row.along2};
            for (std::size_t k = 0; k < 3; ++k) {
                Wide &from = *(isHeld ? solved : held)[k], &to = *(isHeld ? held : solved)[k];
                to[lane] = from[lane];
                from[lane] = 0;
            }
            if (isHeld) group.row.massNormal[lane] = group.row.massTangent[lane] = 0;
        }
    }
    markHeld();
    countGroups();
}

// Marks the groups of which all pairs are held.
void BallRows::markHeld() {
    Wide deepest{};
    m_heldContacts = 0;
    for (std::size_t i = 0; i < m_groups.size(); ++i) {
        const Fixed& fixed = m_fixed[i];
        deepest = fixed.isHeld > Wide{} ? larger(deepest, -m_groups[i].gap) : deepest;
        bool isHeld = true;
        for (std::size_t lane = 0; lane < wideLanes; ++lane) {
            isHeld = isHeld && (fixed.source[lane] == noPair || fixed.isHeld[lane] > 0);
            m_heldContacts += fixed.held[0][lane] > 0 ? 1 : 0;
        }
        m_groups[i].held = isHeld;
        if (isHeld) m_groups[i].idle = true, m_groups[i].watched = false;
    }
    m_heldDeepest = std::max(std::max(deepest[0], deepest[1]), std::max(deepest[2], deepest[3]));
}

void BallRows::countGroups() {
    m_active = m_watched = 0;
    for (const BallGroup& group : m_groups) {
        m_active += group.idle ? 0 : 1;
        m_watched += group.watched ? 1 : 0;
    }
}

void BallRows::refresh(std::span<const SolverBody> bodies, std::span<const BodyPlace> places, double duration,
                       const Vec3& gravity) {
    refreshAll({m_groups.data(), m_fixed.data(), m_groups.size(), bodies.data(), places.data(), nullptr,
                duration, gravity});
    countGroups();
    Wide deepest{};
    for (const BallGroup& group : m_groups)
        deepest = group.row.massNormal > Wide{} ? larger(deepest, -group.gap) : deepest;
    m_deepest = std::max(std::max(deepest[0], deepest[1]), std::max(deepest[2], deepest[3]));
}

bool BallRows::findStruck(std::span<const SolverBody> bodies, std::span<const BodyPlace> places,
                          std::span<const Displacement> moved, double duration, const Vec3& gravity) {
    if (m_watched == 0) return false;
    const bool any = findStruckIn({m_groups.data(), m_fixed.data(), m_groups.size(), bodies.data(),
                                   places.data(), moved.data(), duration, gravity});
    if (any) countGroups();
    return any;
}

bool BallRows::recordApproach(std::span<const SolverBody> bodies, const StepSettings& settings) {
    return passApproach(m_groups.data(), m_groups.size(), bodies.data(), settings.resting);
}

void BallRows::warmStart(std::span<SolverBody> bodies) const {
    passWarm(m_groups.data(), m_groups.size(), bodies.data());
}

void BallRows::solve(std::span<SolverBody> bodies, std::span<const Displacement> moved,
                     const StepSettings& settings, bool back) {
    sweep(Pass::Feedback, {m_groups, bodies.data(), moved.data(), settings, back});
}

void BallRows::addCorrection(std::span<const Displacement> moved, const StepSettings& settings,
                             std::span<double> to) const {
    const Softnesses softness = softnessesOf(settings);
    for (const BallGroup& group : m_groups)
        if (!group.idle)
            carom::addCorrection(group, group.row, gapNow(group, load(group.normal), moved.data()), softness,
                                 to);
}

double BallRows::relax(std::span<SolverBody> bodies, std::span<const Displacement> moved,
                       const StepSettings& settings, bool back) {
    return sweep(Pass::Relax, {m_groups, bodies.data(), moved.data(), settings, back});
}

int BallRows::activate(const ActiveBodies& active) const {
    int struck = 0;
    for (const BallGroup& group : m_groups) {
        if (group.idle || !group.bounces) continue;
        const Wide lanes = isImpact(group.row) ? wideOf(1) : Wide{};
        struck += lanesOf(lanes);
        activateLanes(group, lanes, active);
    }
    return struck;
}

int BallRows::rebound(std::span<SolverBody> bodies, std::span<const Displacement> moved,
                      const StepSettings& settings, int passes, const ActiveBodies& active) {
    passBack(m_groups, bodies.data(), settings.resting, active);
    int pass = 1;
    while (pass <= passes &&
           passStrikes(m_groups, bodies.data(), moved.data(), settings.resting, pass, active))
        ++pass;
    for (BallGroup& group : m_groups) forgetImpact(group, bodies.data(), settings.resting);
    return std::min(pass, passes);
}

} // namespace carom
