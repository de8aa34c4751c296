// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QByteArray>
#include <QFile>
#include <QString>

// The files of a test, and how long it waits for what others do.

namespace carom::test {

/// Longest wait for what needs a thread, a timer, a picture or another program [ms]. Only a hang takes that
/// long: a machine under load is slow.
inline constexpr int longestWait = 120'000;

/// Writes the whole file, or ends the test program.
inline void writeFile(const QString& path, const QByteArray& content) {
    QFile file(path);
    if (!file.open(QIODevice::WriteOnly) || file.write(content) != content.size() || !file.flush())
        qFatal("cannot write %s", qPrintable(path));
}

/// What is in the file, or `<cannot be read>`.
inline QByteArray readFile(const QString& path) {
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray("<cannot be read>");
}

} // namespace carom::test
