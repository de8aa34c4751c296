// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdio>
#include <cstring>
#include <span>

// Runs the test class that the first argument names; what follows it is for Qt Test.

namespace carom::test {

struct TestEntry {
    const char* name;
    int (*run)(int argc, char** argv);
};

inline int runTestClass(std::span<const TestEntry> entries, int argc, char** argv) {
    for (const TestEntry& entry : entries)
        if (argc > 1 && std::strcmp(entry.name, argv[1]) == 0) {
            argv[1] = argv[0];
            return entry.run(argc - 1, argv + 1);
        }
    std::fprintf(stderr, "usage: %s CLASS [options of Qt Test]; the classes are\n", argv[0]);
    for (const TestEntry& entry : entries) std::fprintf(stderr, "  %s\n", entry.name);
    return 2;
}

} // namespace carom::test
