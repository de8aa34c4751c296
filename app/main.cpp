// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/version.h"

#include <cstdio>

int main() {
    std::printf("carom %s\n", carom::version().data());
    return 0;
}
