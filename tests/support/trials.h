// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace carom::test {

/// How many random poses or scenes a test tries that would try so many: a tenth under the address sanitizer,
/// where each takes ten times as long and memory and arithmetic are the same in all of them.
constexpr int trials(int count) {
#ifdef CAROM_SANITIZE_ADDRESS
    return count / 10;
#else
    return count;
#endif
}

} // namespace carom::test
