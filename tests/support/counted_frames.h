// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/program.h"

#include <QByteArray>
#include <QList>
#include <QString>

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

} // namespace carom::test
