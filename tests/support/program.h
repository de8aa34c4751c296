// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/files.h"

#include <QProcess>
#include <QProcessEnvironment>
#include <QString>
#include <QStringList>
#include <QTemporaryDir>

// Runs the built program as a user would, and small helpers to read what it wrote.

namespace carom::test {

struct Ended {
    int exitCode = -1; ///< -1: it did not end by itself
    QString out;
    QString err;
};

inline Ended finish(QProcess& process) {
    if (!process.waitForFinished(longestWait)) {
        process.kill();
        process.waitForFinished(longestWait);
        return {};
    }
    const bool normal = process.exitStatus() == QProcess::NormalExit;
    return {normal ? process.exitCode() : -1, QString::fromUtf8(process.readAllStandardOutput()),
            QString::fromUtf8(process.readAllStandardError())};
}

inline Ended runCommand(const QString& program, const QStringList& words, const QByteArray& input = {},
                        const QProcessEnvironment& environment = QProcessEnvironment::systemEnvironment()) {
    QProcess process;
    process.setProcessEnvironment(environment);
    process.start(program, words);
    process.write(input);
    process.closeWriteChannel();
    return finish(process);
}

/// `carom` with these words, and this on its standard input.
inline Ended carom(const QStringList& words, const QByteArray& input = {}) {
    return runCommand(QStringLiteral(CAROM_PROGRAM), words, input);
}

/// The same with other variables in its environment.
inline Ended carom(const QStringList& words, const QProcessEnvironment& environment) {
    return runCommand(QStringLiteral(CAROM_PROGRAM), words, {}, environment);
}

/// A shell line in which $carom is the program.
inline Ended shell(const QString& line) {
    return runCommand(QStringLiteral("/bin/sh"),
                      {QStringLiteral("-c"), QStringLiteral("carom='" CAROM_PROGRAM "'; ") + line});
}

/// The lines of a text without their ends; nothing behind the last end.
inline QStringList linesOf(const QString& text) {
    QStringList lines = text.split(QLatin1Char('\n'));
    if (!lines.isEmpty() && lines.last().isEmpty()) lines.removeLast();
    return lines;
}

/// A shipped file, from the root of the sources.
inline QString source(const QString& path) { return QStringLiteral(CAROM_SOURCE_DIR "/") + path; }

} // namespace carom::test
