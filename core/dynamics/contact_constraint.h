// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/held_bytes.h"
#include "core/base/index.h"
#include "core/math/types.h"

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

// Contacts as input of the contact solver: pairs of bodies that touch or are near, each with its points, and
// at every point the frame (normal, two tangents) in which velocities and forces are written.
//
//          B        n  normal, from A to B
//        __|__      t1, t2 tangents
//       |  ^n |
//     --+--+--+--   separation > 0: apart
//          A

namespace carom {

/// One point of a contact.
struct ContactConstraint {
    Mat3 frame = Mat3::Identity();                 ///< rows n, t1, t2: world to contact frame
    Vec3 armA = Vec3::Zero(), armB = Vec3::Zero(); ///< from a mobile body's centre to the point [m], world
    double separation = 0;                         ///< [m]
    Vec3 anchor = Vec3::Zero(); ///< the point in the frame of the pair's anchor body, to find it again [m]
    Vec3 force =
        Vec3::Zero(); ///< on B, in the frame [N]; kept from step to step as the start of the next solve
    Eigen::Vector2d rollingTorque = Eigen::Vector2d::Zero(); ///< on B about t1, t2 [N m]
};

/// Two bodies near each other, a < b, with the coefficients of their contact law.
struct ContactPair {
    BodyIndex a = noBody, b = noBody;
    double restitution = 0;
    double friction = 0;
    double rolling = 0;    ///< [m]
    double size = 0;       ///< of the smaller body [m]: lengths of this contact are relative to it
    double margin = 0;     ///< points up to this separation are kept [m]
    double resolution = 0; ///< gaps cannot be told apart below this, by the rounding of coordinates [m]
    std::uint32_t first = 0, count = 0; ///< into ContactSet::points

    BodyPair bodies() const { return {a, b}; }
};

/// All contacts of a set of bodies; pairs ascending.
struct ContactSet {
    std::vector<ContactPair> pairs;
    std::vector<ContactConstraint> points;

    std::span<ContactConstraint> pointsOf(const ContactPair& pair) {
        return std::span(points).subspan(pair.first, pair.count);
    }
    std::span<const ContactConstraint> pointsOf(const ContactPair& pair) const {
        return std::span(points).subspan(pair.first, pair.count);
    }
    void clear() {
        pairs.clear();
        points.clear();
    }
    /// Reserves memory for at least so many pairs and points.
    void reserve(std::size_t pairCount, std::size_t pointCount);
    std::size_t bytes() const { return heldBytes(pairs, points); }
    /// Appends a pair of another set with its points.
    void append(const ContactPair& pair, std::span<const ContactConstraint> itsPoints);
};

/// By how much the worst force is outside Coulomb's cone |fₜ| ≤ μ fₙ, relative to its size; 0 where none is.
double coneViolationOf(const ContactSet& set);

} // namespace carom
