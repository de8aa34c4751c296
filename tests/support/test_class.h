// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QTest>

// A folder's tests are one program. Each file holds one test class and ends in CAROM_TEST, which makes it
// known to the program under the file's name; CMake writes the program's table of classes from its list of
// files.

// Qt 6.4 looks every 50 ms whether what a test waits for has come, and counts the looks. The tests of the IDE
// wait some thousand times, mostly for what takes a few milliseconds.
#undef QTRY_IMPL
#define QTRY_IMPL(expr, timeout)                                                                             \
    constexpr int lookInterval = 5; /* [ms] */                                                               \
    {QTRY_LOOP_IMPL(expr, timeout, lookInterval)} QTRY_TIMEOUT_DEBUG_IMPL(expr, timeout, lookInterval)

// Qt 6.4 makes the description of a check that holds, too: in a loop over random poses that is most of the
// time.
#undef QVERIFY2
#define QVERIFY2(statement, description)                                                                     \
    do {                                                                                                     \
        if (static_cast<bool>(statement)) {                                                                  \
            if (!QTest::qVerify(true, #statement, "", __FILE__, __LINE__)) return;                           \
        } else {                                                                                             \
            if (!QTest::qVerify(false, #statement, (description), __FILE__, __LINE__)) return;               \
        }                                                                                                    \
    } while (false)

/// The last line but one of x_test.cpp: CAROM_TEST(x_test, XTest).
#define CAROM_TEST(name, TestClass)                                                                          \
    namespace carom::test {                                                                                  \
    int name(int argc, char** argv);                                                                         \
    int name(int argc, char** argv) {                                                                        \
        TestClass test;                                                                                      \
        return QTest::qExec(&test, argc, argv);                                                              \
    }                                                                                                        \
    }

/// The same for a class that needs an application object: QCoreApplication, QApplication or IdeApplication.
#define CAROM_TEST_WITH(Application, name, TestClass)                                                        \
    namespace carom::test {                                                                                  \
    int name(int argc, char** argv);                                                                         \
    int name(int argc, char** argv) {                                                                        \
        const Application application(argc, argv);                                                           \
        TestClass test;                                                                                      \
        return QTest::qExec(&test, argc, argv);                                                              \
    }                                                                                                        \
    }
