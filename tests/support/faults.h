// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QtGlobal>

#include <array>
#include <cerrno>
#include <cstddef>
#include <vector>

// What can fail where a file is written: every call, for every cause.

namespace carom::test {

struct Fault {
    const char* call;
    const char* name; ///< of the cause
    int cause;        ///< errno
};

/// The faults of a writer. What a writer does next depends on the call that failed, and the cause is only
/// said; so every call fails once, and the causes take turns, which begin with another one at every writer.
/// With CAROM_KILLS in the environment (packaging/test crash) every call fails for every cause.
inline std::vector<Fault> faultsToTry(std::size_t writer) {
    constexpr std::array calls = {"open", "write", "fsync", "close", "rename"};
    constexpr std::array causes = {Fault{"", "ENOSPC", ENOSPC}, Fault{"", "EIO", EIO},
                                   Fault{"", "EACCES", EACCES}};
    const bool all = qEnvironmentVariableIsSet("CAROM_KILLS");
    std::vector<Fault> faults;
    for (std::size_t call = 0; call < calls.size(); ++call)
        for (std::size_t cause = 0; cause < causes.size(); ++cause)
            if (all || cause == (writer + call) % causes.size())
                faults.push_back({calls[call], causes[cause].name, causes[cause].cause});
    return faults;
}

} // namespace carom::test
