// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/joint_impulses.h"

#include <Eigen/Cholesky>

namespace carom {
namespace {

/// W counts as singular below this reciprocal condition: impulses would keep fewer than six digits. Twice or
/// half of it decides only whether those with a digit more or less are taken.
constexpr double singular = 1e-10;

} // namespace

bool jointImpulses(const JointResponse& response, const JointValues& changes, JointValues& impulses) {
    if (response.rows() == 1) {
        impulses = changes / response(0, 0);
    } else {
        const Eigen::LDLT<JointResponse> forward(response), backward(response.reverse());
        // (Eigen solves without a pivot of 0, and does not count it in the condition.)
        if (!(forward.vectorD().minCoeff() > 0 && forward.rcond() > singular)) return false;
        impulses = 0.5 * (forward.solve(changes) + backward.solve(changes.reverse()).reverse());
    }
    return impulses.minCoeff() >= 0;
}

} // namespace carom
