// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/command.h"
#include "app/programs.h"

#include <string>
#include <vector>

int main(int argc, char** argv) {
    const std::vector<std::string> words(argv + (argc > 0 ? 1 : 0), argv + argc);
    carom::QtParts parts;
#ifdef CAROM_WINDOW
    parts.handOn = carom::handOn;
#endif
    return carom::runCommandLine(argc > 0 ? argv[0] : "carom", words, parts);
}
