// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/types.h"

// The impulses of a few smooth contacts that act at one moment: W p = c, with the response W of the contacts
// along their normals and the wanted changes c of their closing speeds.

namespace carom {

/// Solved for together; of more ties each impact acts alone. Twice as many would take eight times the work
/// and a matrix of 8 KiB on the stack.
inline constexpr int mostJointContacts = 16;

/// [1/kg], symmetric; entry (i, k) is how an impulse at k changes the closing speed at i.
using JointResponse =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, mostJointContacts, mostJointContacts>;
/// By contact.
using JointValues = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, mostJointContacts, 1>;

/// The impulses [N s] for the changes [m/s]; mirror images have mirrored bits. False if `response` is
/// singular to working precision, or if an impulse would pull: `impulses` is of no use then.
bool jointImpulses(const JointResponse& response, const JointValues& changes, JointValues& impulses);

} // namespace carom
