// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/interrupt.h"

#include <csignal>

namespace carom {
namespace {

volatile std::sig_atomic_t signalled = 0;

extern "C" void noteSignal(int) { signalled = 1; }

} // namespace

void catchInterrupts() {
    struct sigaction action = {};
    action.sa_handler = noteSignal;
    // SA_RESETHAND: the second signal meets the default, which ends the program.
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() { return signalled != 0; }

} // namespace carom
