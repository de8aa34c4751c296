// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/ball_rows.h"

#include "core/base/shared_extremes.h"
#include "core/solvers/contacts/contact_law.h"
#include "core/solvers/contacts/manifolds.h"

#include <algorithm>
#include <atomic>
#include <cstddef>

namespace carom {
namespace {

CAROM_INLINE Wide3 gatherPlace(const BodyPlace* places, const std::array<std::uint32_t, 4>& index) {
    return gatherThree<BodyPlace>(places->position.data(), index);
}

CAROM_INLINE Wide3 choose(const auto& where, const Wide3& one, const Wide3& other) {
    return {where ? one.x : other.x, where ? one.y : other.y, where ? one.z : other.z};
}

/// Groups that one thread lists at least.
constexpr std::size_t fewListed = Workers::enoughOf(3);
/// Pairs that one thread puts into groups at least, and groups of which it renumbers the pairs.
constexpr std::size_t fewPacked = Workers::enoughOf(15), fewRenumbered = Workers::enoughOf(10);

/// The vectors of a group, from `radiusA` to the end of its row, and where they begin as doubles.
constexpr std::size_t valuesOfGroup =
    (offsetof(BallGroup, row) + sizeof(BallRow) - offsetof(BallGroup, radiusA)) / sizeof(Wide);
static_assert(valuesOfGroup == 20);
const double* valuesOf(const BallGroup& group) { return reinterpret_cast<const double*>(&group.radiusA); }
double* valuesOf(BallGroup& group) { return reinterpret_cast<double*>(&group.radiusA); }

/// Copies one lane of `count` vectors.
CAROM_INLINE void copyValues(std::size_t count, const double* from, std::size_t lane, double* to,
                             std::size_t toLane) {
    for (std::size_t k = 0; k < count; ++k) to[wideLanes * k + toLane] = from[wideLanes * k + lane];
}

/// Makes `count` vectors of four, of each of which the pointer is to the lane that is wanted.
CAROM_INLINE void gatherValues(std::size_t count, const std::array<const double*, wideLanes>& from,
                               double* to) {
    for (std::size_t k = 0; k < wideLanes * count; k += wideLanes)
        storeWide(to + k, Wide{from[0][k], from[1][k], from[2][k], from[3][k]});
}

/// One pair of a group, with its rows.
void copyLane(const BallGroup& from, std::size_t lane, BallGroup& to, std::size_t toLane) {
    to.a[toLane] = from.a[lane];
    to.b[toLane] = from.b[lane];
    copyValues(valuesOfGroup, valuesOf(from), lane, valuesOf(to), toLane);
}

} // namespace

struct BallRows::Refresh {
    std::span<const std::uint32_t> list; ///< of groups
    BallGroup* groups;
    const Fixed* fixed;
    const SolverBody* bodies;
    const BodyPlace* places;
    const Displacement* moved; ///< null: no body has moved
    double duration;
    Vec3 gravity;
};

// Updates all lanes, or those that are `struck`. Always inlined into the wide versions below.
CAROM_INLINE void BallRows::refreshGroup(const Refresh& with, std::size_t i, const Wide* struck) {
    BallGroup& group = with.groups[i];
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
    group.gap = changes ? ((used | (fixed.isHeld > zero)) ? now : zero) : group.gap;
    group.idle = !anyLane(row.massNormal > zero);
    group.watched = anyLane(used & (row.massNormal == zero));
}

CAROM_WIDE double BallRows::refreshAll(const Refresh& with) {
    Wide deepest{};
    for (const std::uint32_t i : with.list) {
        refreshGroup(with, i, nullptr);
        const BallGroup& group = with.groups[i];
        deepest = group.row.massNormal > Wide{} ? larger(deepest, -group.gap) : deepest;
    }
    return largestLane(deepest);
}

CAROM_WIDE bool BallRows::findStruckIn(const Refresh& with) {
    bool any = false;
    for (const std::uint32_t i : with.list) {
        const BallGroup& group = with.groups[i];
        Motion a, b;
        gatherVelocity(with.bodies, group.a, a);
        gatherVelocity(with.bodies, group.b, b);
        const Wide3 moved = gatherShift(with.moved, group.b) - gatherShift(with.moved, group.a);
        const Wide3 n = load(group.normal);
        const Wide then = group.gap + dot(n, moved + wideOf(with.duration) * (b.velocity - a.velocity));
        const auto isWatched = (with.fixed[i].massNormal > Wide{}) & (group.row.massNormal == Wide{});
        const auto closes = isWatched & (then < Wide{});
        if (!anyLane(closes)) continue;
        const Wide struck = closes ? wideOf(1) : Wide{};
        refreshGroup(with, i, &struck);
        any = true;
    }
    return any;
}

void BallRows::clear() {
    m_groups.clear();
    m_fixed.clear();
    m_packer.clear();
    m_sections.clear();
    m_lists.areKnown = false;
    m_heldDeepest = 0;
}

void BallRows::findSolved(Workers& workers) {
    m_lists.solved.clear();
    workers.forLists(m_groups.size(), fewListed, m_lists.solved,
                     [this](std::size_t begin, std::size_t end, std::vector<std::uint32_t>& solved) {
                         for (std::size_t i = begin; i < end; ++i)
                             if (!m_groups[i].held) solved.push_back(static_cast<std::uint32_t>(i));
                     });
}

void BallRows::findLists() {
    findSolved(Workers::alone());
    listAfter(Workers::alone(), fewListed, [](std::span<const std::uint32_t>) {});
    m_lists.areKnown = true;
}

// Tells what is done with the groups that are not held, after work(groups) for parts of them.
template<class Work>
void BallRows::listAfter(Workers& workers, std::size_t least, const Work& work) {
    const std::span<const std::uint32_t> solved = m_lists.solved;
    const std::span<Lists> parts = workers.forKeptLists(
        solved.size(), least, m_parts, [&](std::size_t begin, std::size_t end, Lists& to) {
            const std::span<const std::uint32_t> groups = solved.subspan(begin, end - begin);
            work(groups);
            for (const std::uint32_t i : groups) {
                if (!m_groups[i].idle) to.active.push_back(i);
                if (m_groups[i].watched) to.watched.push_back(i);
            }
        });
    for (auto list : {&Lists::active, &Lists::watched}) {
        std::swap(m_lists.*list, parts.front().*list);
        for (const Lists& part : parts.subspan(1))
            (m_lists.*list).insert((m_lists.*list).end(), (part.*list).begin(), (part.*list).end());
    }
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
    m_lists.areKnown = false;
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

// Makes a group of the lanes of old ones that are to be in it.
void BallRows::fillGroup(std::size_t i, const BallGroup& empty, const Fixed& emptyFixed) {
    constexpr std::size_t valuesOfFixed = offsetof(Fixed, source) / sizeof(Wide);
    BallGroup& to = m_groups[i];
    Fixed& toFixed = m_fixed[i];
    std::array<const double*, wideLanes> values, fixedValues;
    to.bounces = to.idle = to.watched = to.held = false;
    for (std::size_t lane = 0; lane < wideLanes; ++lane) {
        const std::uint32_t from = m_from[i][lane];
        const bool isUsed = from != noPair;
        const BallGroup& group = isUsed ? m_before[from / wideLanes] : empty;
        const Fixed& fixed = isUsed ? m_fixedBefore[from / wideLanes] : emptyFixed;
        const std::size_t at = isUsed ? from % wideLanes : lane;
        to.a[lane] = group.a[at];
        to.b[lane] = group.b[at];
        to.bounces = to.bounces || group.restitution[at] > 0;
        toFixed.source[lane] = fixed.source[at];
        values[lane] = valuesOf(group) + at;
        fixedValues[lane] = reinterpret_cast<const double*>(&fixed) + at;
    }
    gatherValues(valuesOfGroup, values, valuesOf(to));
    gatherValues(valuesOfFixed, fixedValues, reinterpret_cast<double*>(&toFixed));
}

// Appends groups of pairs that are in these places.
void BallRows::pack(std::span<const std::uint32_t> places, std::uint32_t immobile, LanePacker& packer,
                    Lanes& from) const {
    for (const std::uint32_t at : places) {
        const BallGroup& group = m_before[at / wideLanes];
        const LanePacker::Place place =
            packer.place(group.a[at % wideLanes], group.b[at % wideLanes], immobile);
        if (place.isNew) from.push_back({noPair, noPair, noPair, noPair});
        from[place.group][place.lane] = at;
    }
}

// A pair takes no place in a group of an earlier section, so threads find the groups of the sections at the
// same time. Pairs that are added later may take one in the last.
void BallRows::reorder(std::span<const std::uint32_t> places, std::uint32_t immobile,
                       std::span<const SectionEnd> sections, Workers& workers) {
    std::swap<std::vector<BallGroup>>(m_groups, m_before);
    std::swap<std::vector<Fixed>>(m_fixed, m_fixedBefore);
    m_packed.resize(sections.size());
    m_packers.resize(static_cast<std::size_t>(workers.threads()));
    for (LanePacker& packer : m_packers) packer.reserve(m_packer.bodies());
    const auto endBefore = [&](std::size_t section) { return section > 0 ? sections[section - 1].end : 0; };
    Workers& several = endBefore(sections.size()) < 2 * fewPacked ? Workers::alone() : workers;
    several.forEach(sections.size(), [&](std::size_t thread, std::size_t section) {
        const std::size_t begin = endBefore(section);
        m_packed[section].clear();
        m_packers[thread].restart();
        pack(places.subspan(begin, sections[section].end - begin), immobile, m_packers[thread],
             m_packed[section]);
    });
    m_from.clear();
    m_sections.clear();
    for (std::size_t section = 0; section < sections.size(); ++section) {
        m_from.insert(m_from.end(), m_packed[section].begin(), m_packed[section].end());
        m_sections.close(sections[section].phase, m_from.size());
    }
    m_packer.restart(m_from.size());
    pack(places.subspan(endBefore(sections.size())), immobile, m_packer, m_from);
    m_groups.resize(m_from.size());
    m_fixed.resize(m_from.size());
    const BallGroup empty = emptyGroup(immobile);
    workers.forRanges(m_from.size(), fewShared, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) fillGroup(i, empty, {});
    });
    markHeld();
}

void BallRows::emptyLane(std::size_t i, std::size_t lane, const BallGroup& empty) {
    copyLane(empty, lane, m_groups[i], lane);
    Fixed& fixed = m_fixed[i];
    fixed.source[lane] = noPair;
    for (Wide& place : fixed.place) place[lane] = 0;
    for (Wide& impulse : fixed.held) impulse[lane] = 0;
    fixed.wall[lane] = fixed.massNormal[lane] = fixed.massTangent[lane] = fixed.isHeld[lane] = 0;
}

void BallRows::renumber(std::span<const std::uint32_t> sources, std::uint32_t immobile, Workers& workers) {
    const BallGroup empty = emptyGroup(immobile);
    std::atomic<bool> isAny = false;
    workers.forRanges(m_fixed.size(), fewRenumbered, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            for (std::size_t lane = 0; lane < wideLanes; ++lane) {
                std::uint32_t& source = m_fixed[i].source[lane];
                if (source == noPair) continue;
                source = sources[source];
                if (source != noPair) continue;
                emptyLane(i, lane, empty);
                isAny.store(true, std::memory_order_relaxed);
            }
    });
    if (isAny) markHeld();
}

void BallRows::keep(std::span<const std::uint32_t> sources, std::span<const std::uint32_t> bodies,
                    std::uint32_t immobile) {
    const BallGroup empty = emptyGroup(immobile);
    m_packer.restart();
    std::uint32_t kept = 0;
    m_newGroup.assign(m_groups.size() + 1, 0);
    for (std::size_t i = 0; i < m_groups.size(); ++i) {
        m_newGroup[i] = kept;
        BallGroup& group = m_groups[i];
        Fixed& fixed = m_fixed[i];
        unsigned used = 0;
        for (std::size_t lane = 0; lane < wideLanes; ++lane) {
            if (fixed.source[lane] == noPair) continue;
            fixed.source[lane] = sources[fixed.source[lane]];
            if (fixed.source[lane] == noPair) {
                emptyLane(i, lane, empty);
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
    m_newGroup[m_groups.size()] = kept;
    m_groups.resize(kept);
    m_fixed.resize(kept);
    m_sections.renumber([&](std::uint32_t end) { return m_newGroup[end]; });
    if (!m_sections.isEmpty()) m_packer.closeAll(); // or pairs of other sections would come into them
    markHeld();
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
        if (!hasAny(group, changed)) continue;
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
}

// Marks the groups of which all pairs are held. Every group has a pair.
CAROM_WIDE void BallRows::markHeld() {
    Wide deepest{};
    m_heldContacts = 0;
    for (std::size_t i = 0; i < m_groups.size(); ++i) {
        const Fixed& fixed = m_fixed[i];
        m_groups[i].held = false;
        if (!anyLane(fixed.isHeld)) continue;
        deepest = fixed.isHeld > Wide{} ? larger(deepest, -m_groups[i].gap) : deepest;
        bool isHeld = true;
        for (std::size_t lane = 0; lane < wideLanes; ++lane) {
            isHeld = isHeld && (fixed.source[lane] == noPair || fixed.isHeld[lane] > 0);
            m_heldContacts += fixed.held[0][lane] > 0 ? 1 : 0;
        }
        m_groups[i].held = isHeld;
        if (isHeld) m_groups[i].idle = true, m_groups[i].watched = false;
    }
    m_heldDeepest = largestLane(deepest);
    m_lists.areKnown = false;
}

void BallRows::refresh(std::span<const SolverBody> bodies, std::span<const BodyPlace> places, double duration,
                       const Vec3& gravity, Workers& workers) {
    if (!m_lists.areKnown) findSolved(workers);
    m_deepest = 0;
    listAfter(workers, fewShared, [&](std::span<const std::uint32_t> groups) {
        raiseTo(m_deepest, refreshAll({groups, m_groups.data(), m_fixed.data(), bodies.data(), places.data(),
                                       nullptr, duration, gravity}));
    });
    m_lists.areKnown = true;
}

bool BallRows::findStruck(std::span<const SolverBody> bodies, std::span<const BodyPlace> places,
                          std::span<const Displacement> moved, double duration, const Vec3& gravity,
                          Workers& workers) {
    const std::span<const std::uint32_t> watched = lists().watched;
    std::atomic<bool> any = false;
    workers.forRanges(watched.size(), fewShared, [&](std::size_t begin, std::size_t end) {
        if (findStruckIn({watched.subspan(begin, end - begin), m_groups.data(), m_fixed.data(), bodies.data(),
                          places.data(), moved.data(), duration, gravity}))
            any = true;
    });
    if (any) listAfter(workers, fewListed, [](std::span<const std::uint32_t>) {});
    return any;
}

} // namespace carom
