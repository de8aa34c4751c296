// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/files.h"

#include <QDir>

// What a process holds, by the kernel's account.

namespace carom::test {

struct Holdings {
    qint64 memory = -1; ///< [KiB] in memory: pages of its own, none of files
    qint64 files = -1;  ///< open descriptors
};

/// Of the process with this number; "self" is the test. Negative where it is gone.
inline Holdings holdingsOf(const QString& process) {
    const QString folder = QStringLiteral("/proc/") + process;
    Holdings found;
    for (const QByteArray& line : readFile(folder + QStringLiteral("/status")).split('\n'))
        if (line.startsWith("RssAnon:"))
            found.memory = line.mid(8).simplified().split(' ').first().toLongLong();
    const QDir files(folder + QStringLiteral("/fd"));
    if (files.exists())
        found.files = files.entryList(QDir::AllEntries | QDir::System | QDir::NoDotAndDotDot).size();
    return found;
}

/// Processor time [ms] that the threads of this name have used in the process with this number.
inline qint64 processorTimeOf(qint64 process, const QByteArray& thread) {
    constexpr qint64 millisecondsPerTick = 10; // Linux: 100 a second, on every machine
    qint64 ticks = 0;
    const QDir tasks(QStringLiteral("/proc/%1/task").arg(process));
    for (const QString& task : tasks.entryList(QDir::Dirs | QDir::NoDotAndDotDot)) {
        if (readFile(tasks.filePath(task + QStringLiteral("/comm"))).trimmed() != thread) continue;
        const QByteArray stat = readFile(tasks.filePath(task + QStringLiteral("/stat")));
        // Behind the name, which may hold anything: state, ten numbers, ticks in user mode, ticks in the
        // kernel.
        const QList<QByteArray> fields = stat.mid(stat.lastIndexOf(')') + 2).split(' ');
        ticks += fields.value(11).toLongLong() + fields.value(12).toLongLong();
    }
    return ticks * millisecondsPerTick;
}

/// How often tests that are made for hours do their round; so often in every run of the tests.
inline int roundsOf(const char* variable, int otherwise) {
    bool given = false;
    const int count = qEnvironmentVariableIntValue(variable, &given);
    return given ? count : otherwise;
}

} // namespace carom::test
