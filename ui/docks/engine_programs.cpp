// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/docks/engine_programs.h"

#include "core/base/clock.h"

#include <QCoreApplication>
#include <QDir>
#include <QFileInfo>
#include <QProcess>
#include <QStandardPaths>
#include <QTemporaryFile>

namespace carom {
namespace {

/// Interval at which a waiting read checks for cancellation [ms]; at ten times cancelling lags.
constexpr int mostWaiting = 50;

QString prefix() { return QStringLiteral("carom-engine-"); }

QStringList folders() {
    return QStringList{QCoreApplication::applicationDirPath()} +
           qEnvironmentVariable("PATH").split(QDir::listSeparator(), Qt::SkipEmptyParts);
}

} // namespace

QStringList installedEngines() {
    QStringList names;
    for (const QString& folder : folders())
        for (const QFileInfo& file :
             QDir(folder).entryInfoList({prefix() + QLatin1Char('*')}, QDir::Files | QDir::Executable))
            names.append(file.fileName().mid(prefix().size()));
    names.sort();
    names.removeDuplicates();
    return names;
}

std::string runEngineOn(const QByteArray& scene, const EngineRequest& request) {
    const Stopwatch watch;
    const QString program =
        QStandardPaths::findExecutable(prefix() + QString::fromStdString(request.engine), folders());
    QTemporaryFile file;
    if (program.isEmpty() || !file.open() || file.write(scene) != scene.size() || !file.flush())
        return "its program could not be started";
    QStringList words;
    for (const std::string& word : argumentsFor(file.fileName().toStdString(), request))
        words.append(QString::fromStdString(word));
    QProcess process;
    process.setStandardInputFile(QProcess::nullDevice());
    process.setStandardErrorFile(QProcess::nullDevice());
    process.start(program, words, QIODevice::ReadOnly);
    if (!process.waitForStarted()) return "its program could not be started";
    std::string problem;
    while (problem.empty() &&
           (process.waitForReadyRead(mostWaiting) || process.state() != QProcess::NotRunning)) {
        const QByteArray piece = process.readAllStandardOutput();
        request.read({piece.data(), static_cast<std::size_t>(piece.size())});
        if (!request.goOn())
            problem = "it was ended";
        else if (watch.elapsed() > 1000 * request.limit)
            problem = "it took longer than the " + QString::number(request.limit, 'g', 2).toStdString() +
                      " s that were left for it";
    }
    if (!problem.empty()) {
        process.kill();
        process.waitForFinished();
        return problem;
    }
    const QByteArray rest = process.readAllStandardOutput();
    request.read({rest.data(), static_cast<std::size_t>(rest.size())});
    const bool isWell = process.exitStatus() == QProcess::NormalExit && process.exitCode() == 0;
    return isWell ? std::string() : "its program ended with " + std::to_string(process.exitCode());
}

} // namespace carom
