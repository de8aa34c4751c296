// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/constants.h"
#include "tests/support/scenes.h"

#include "core/solvers/contacts/refinement.h"

#include <algorithm>
#include <vector>

namespace carom::test {

inline constexpr double earth = 9.81; // [m/s²]

/// Bodies without walls, coupled as `pairs` say; what is in no pair is alone.
struct Crowd {
    explicit Crowd(std::size_t count, double radius = 0.1) {
        Scene scene;
        for (std::size_t i = 0; i < count; ++i)
            scene.bodies.push_back(test::sphere(radius, 1, {static_cast<double>(i), 0, 0}));
        bodies = bodiesOf(scene);
        state = initialStateOf(scene);
    }

    void join(BodyIndex a, BodyIndex b) {
        ContactPair pair;
        pair.a = std::min(a, b);
        pair.b = std::max(a, b);
        pairs.push_back(pair);
    }
    /// Bodies in chains of so many.
    void chain(const std::vector<std::size_t>& lengths) {
        BodyIndex first = 0;
        for (const std::size_t length : lengths) {
            for (std::size_t i = 1; i < length; ++i)
                join(first + static_cast<BodyIndex>(i) - 1, first + static_cast<BodyIndex>(i));
            first += static_cast<BodyIndex>(length);
        }
    }
    void find() {
        std::sort(pairs.begin(), pairs.end(), [](const ContactPair& one, const ContactPair& other) {
            return one.bodies() < other.bodies();
        });
        islands.find(bodies, bodies.mobileBodies, pairs, links);
        canMeet.resize(pairs.size(), 1);
        joins.assign(islands.count(), 0);
        closed.assign(islands.count(), 0);
    }
    RefinementInput input(int part = 0, int parts = 1) const {
        return {bodies,        state, islands, bodies.mobileBodies, canMeet, joins, closed, {0, -earth, 0},
                test::substep, part,  parts};
    }
    /// Bodies and pairs of islands that have pairs: what a budget grows with.
    double items() const {
        std::size_t sum = 0;
        for (std::size_t i = 0; i < islands.count(); ++i)
            if (!islands[i].pairs.empty()) sum += islands[i].bodies.size() + islands[i].pairs.size();
        return static_cast<double>(sum);
    }

    Bodies bodies;
    State state;
    std::vector<ContactPair> pairs;
    std::vector<BodyPair> links;
    std::vector<std::uint8_t> canMeet; // by pair
    std::vector<std::uint8_t> joins;   // by island
    std::vector<std::uint8_t> closed;  // by island
    Islands islands;
};

} // namespace carom::test
