// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/files.h"
#include "tests/support/program.h"

#include <QByteArray>
#include <QList>
#include <QMap>
#include <QString>
#include <QTemporaryDir>

// Instructions of some frames of scenes, counted by callgrind in one run of `carom-frames`.

namespace carom::test {

/// `counted` frames of each scene after `warmUp`; the profile of scene k, from 1, is written to
/// "<counts>.<k>". What the program says is a state hash a line.
inline Ended countFrames(const QList<QByteArray>& texts, int warmUp, int counted, const QString& counts) {
    return runCommand(QStringLiteral("valgrind"),
                      {QStringLiteral("--tool=callgrind"), QStringLiteral("--instr-atstart=no"),
                       QStringLiteral("--toggle-collect=carom::countedFrames*"),
                       QStringLiteral("--dump-after=carom::countedFrames(carom::World&, int)"),
                       QStringLiteral("--callgrind-out-file=") + counts, QStringLiteral(CAROM_FRAMES),
                       QString::number(warmUp), QString::number(counted)},
                      texts.join("====\n"));
}

/// Instructions of these frames of each text, in one run; none of any if valgrind is not there.
inline QMap<QByteArray, double> instructionsOf(const QList<QByteArray>& texts, int warmUp, int counted) {
    const QTemporaryDir folder;
    const QString counts = folder.filePath(QStringLiteral("counts"));
    QMap<QByteArray, double> instructions;
    if (countFrames(texts, warmUp, counted, counts).exitCode != 0) return instructions;
    for (qsizetype i = 0; i < texts.size(); ++i)
        for (const QString& line :
             linesOf(QString::fromUtf8(readFile(counts + QStringLiteral(".%1").arg(i + 1)))))
            if (line.startsWith(QStringLiteral("totals: ")))
                instructions[texts[i]] = line.section(QLatin1Char(' '), 1, 1).toDouble();
    return instructions;
}

} // namespace carom::test
