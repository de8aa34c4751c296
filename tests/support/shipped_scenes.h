// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QByteArray>
#include <QDir>
#include <QDirIterator>
#include <QFile>
#include <QString>
#include <QStringList>

#include <string>

namespace carom::test {

/// The scenes that ship with the program, by path from the scenes folder, ascending; without the hard cases,
/// which last longer and have tests of their own (core/study/cases).
inline QStringList shippedScenes() {
    const QDir folder(QStringLiteral(CAROM_SOURCE_DIR "/scenes"));
    QStringList paths;
    QDirIterator files(folder.path(), {QStringLiteral("*.sdl")}, QDir::Files, QDirIterator::Subdirectories);
    while (files.hasNext()) paths += folder.relativeFilePath(files.next());
    paths.removeIf([](const QString& path) { return path.startsWith(QLatin1String("hard/")); });
    paths.sort();
    return paths;
}

inline std::string textOfScene(const QString& path) {
    QFile file(QStringLiteral(CAROM_SOURCE_DIR "/scenes/") + path);
    if (!file.open(QIODevice::ReadOnly)) return {};
    return file.readAll().toStdString();
}

} // namespace carom::test
