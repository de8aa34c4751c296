// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/islands.h"

#include "core/base/reserve.h"

#include <algorithm>
#include <limits>

namespace carom {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

} // namespace

// Union by smaller index with path halving: the root of an island is its first body, in any order of the
// unions.
std::uint32_t Islands::rootOf(std::uint32_t body) {
    while (m_parent[body] != body) body = m_parent[body] = m_parent[m_parent[body]];
    return body;
}

void Islands::join(BodyIndex a, BodyIndex b) {
    if (!isMember(a) || !isMember(b)) return;
    const std::uint32_t rootA = rootOf(a), rootB = rootOf(b);
    m_parent[std::max(rootA, rootB)] = std::min(rootA, rootB);
}

template<class Pair>
void Islands::find(const Bodies& bodies, std::span<const BodyIndex> members, const std::vector<Pair>& pairs,
                   std::span<const BodyPair> links, std::span<const std::uint8_t> isUsed) {
    m_isMember.assign(bodies.count(), 0);
    m_parent.resize(bodies.count());
    m_island.resize(bodies.count());
    for (const BodyIndex body : members) {
        m_isMember[body] = 1;
        m_parent[body] = body;
        m_island[body] = none;
    }
    const auto forEachPair = [&](const auto& visit) {
        for (std::uint32_t i = 0; i < pairs.size(); ++i)
            if (isUsed.empty() || isUsed[i] != 0) visit(pairs[i], i);
    };
    std::size_t used = 0;
    forEachPair([&](const Pair& pair, std::uint32_t) {
        join(pair.a, pair.b);
        ++used;
    });
    for (const BodyPair& link : links) join(link.a, link.b);

    // Counting sort by island: sizes, then starts, then bodies.
    m_first.assign(1, {});
    for (const BodyIndex body : members) {
        std::uint32_t& island = m_island[rootOf(body)];
        if (island == none) {
            island = static_cast<std::uint32_t>(m_first.size() - 1);
            m_first.push_back({});
        }
        ++m_first[island + 1].body;
    }
    const auto islandOf = [&](BodyIndex a, BodyIndex b) { return m_island[rootOf(isMember(a) ? a : b)]; };
    forEachPair([&](const Pair& pair, std::uint32_t) { ++m_first[islandOf(pair.a, pair.b) + 1].pair; });
    std::size_t live = 0;
    for (const BodyPair& link : links) {
        if (!isMember(link.a) && !isMember(link.b)) continue;
        ++m_first[islandOf(link.a, link.b) + 1].link;
        ++live;
    }
    for (std::size_t i = 1; i < m_first.size(); ++i) {
        m_first[i].body += m_first[i - 1].body;
        m_first[i].pair += m_first[i - 1].pair;
        m_first[i].link += m_first[i - 1].link;
    }
    m_bodies.resize(members.size());
    reserveFor(pairs.size(), m_pairs);
    m_pairs.resize(used);
    m_links.resize(live);
    m_next.assign(m_first.begin(), m_first.end() - 1);
    for (const BodyIndex body : members) m_bodies[m_next[m_island[rootOf(body)]].body++] = body;
    forEachPair(
        [&](const Pair& pair, std::uint32_t i) { m_pairs[m_next[islandOf(pair.a, pair.b)].pair++] = i; });
    for (std::uint32_t i = 0; i < links.size(); ++i)
        if (isMember(links[i].a) || isMember(links[i].b))
            m_links[m_next[islandOf(links[i].a, links[i].b)].link++] = i;
}

template void Islands::find(const Bodies&, std::span<const BodyIndex>, const std::vector<ContactPair>&,
                            std::span<const BodyPair>, std::span<const std::uint8_t>);
template void Islands::find(const Bodies&, std::span<const BodyIndex>, const std::vector<BodyPair>&,
                            std::span<const BodyPair>, std::span<const std::uint8_t>);

} // namespace carom
