// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/charts.h"
#include "app/command.h"

#include <string>
#include <vector>

int main(int argc, char** argv) {
    const std::vector<std::string> words(argv + (argc > 0 ? 1 : 0), argv + argc);
    carom::chartDrawer().benchmark = carom::drawBenchmark;
    carom::chartDrawer().accuracy = carom::drawAccuracy;
    carom::chartDrawer().gas = carom::drawGas;
    carom::chartDrawer().sweep = carom::drawSweep;
    carom::QtParts parts;
    parts.ide = carom::runIde;
    return carom::runCommandLine(argc > 0 ? argv[0] : "carom", words, parts);
}
