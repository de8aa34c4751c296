// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/index.h"
#include "core/solvers/contacts/course.h"

#include <span>

namespace carom {

/// When the bodies of pairs are near each other while all of them follow their courses: meetingOf() of each
/// pair, four pairs at a time.
struct Meetings {
    const Course* courses = nullptr; ///< by body
    const double* extents = nullptr; ///< by body: two are near within the sum of theirs [m]
    double time = 0;                 ///< from then on [s]

    /// Writes as many as there are pairs.
    void find(std::span<const BodyPair> pairs, TimeSpan* meetings) const;
    /// The same of the pairs of one body with others.
    void findOf(BodyIndex body, std::span<const BodyIndex> others, TimeSpan* meetings) const;
};

} // namespace carom
