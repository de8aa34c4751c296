// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/recovery.h"

#include <QDataStream>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QSaveFile>
#include <QStandardPaths>
#include <QUuid>

#include <algorithm>
#include <optional>

namespace carom {
namespace {

constexpr quint32 signature = 0x43535750; // "CSWP": anything else in the folder is not ours
const QString ending = QStringLiteral(".swap");

QString lockOf(const QString& swapFile) { return swapFile + QStringLiteral(".lock"); }

std::optional<LostText> readSwap(const QString& swapFile) {
    QFile file(swapFile);
    if (!file.open(QIODevice::ReadOnly)) return std::nullopt;
    QDataStream stream(&file);
    quint32 found = 0;
    LostText lost{swapFile, {}, {}, QFileInfo(file).lastModified()};
    stream >> found >> lost.path >> lost.text;
    if (found != signature || stream.status() != QDataStream::Ok) return std::nullopt;
    return lost;
}

} // namespace

Recovery::Recovery(const Document& document, const QString& folder, QObject* parent)
    : QObject(parent), m_document(document) {
    QDir().mkpath(folder);
    m_swapFile = QDir(folder).filePath(QUuid::createUuid().toString(QUuid::WithoutBraces) + ending);
    m_lock = std::make_unique<QLockFile>(lockOf(m_swapFile));
    m_lock->setStaleLockTime(0); // stale only when its process is gone
    m_lock->tryLock(0);
    connect(&m_timer, &QTimer::timeout, this, &Recovery::keep);
    m_timer.start(interval);
}

Recovery::~Recovery() { QFile::remove(m_swapFile); }

void Recovery::keep() {
    if (!m_document.isModified()) {
        if (m_kept >= 0) QFile::remove(m_swapFile);
        m_kept = -1;
        return;
    }
    if (m_kept == m_document.revision()) return;
    QSaveFile file(m_swapFile);
    if (!file.open(QIODevice::WriteOnly)) return;
    QDataStream stream(&file);
    stream << signature << m_document.path() << m_document.text();
    if (file.commit()) m_kept = m_document.revision();
}

QString Recovery::standardFolder() {
    return QDir(QStandardPaths::writableLocation(QStandardPaths::AppDataLocation))
        .filePath(QStringLiteral("recovery"));
}

std::vector<LostText> Recovery::lostTexts(const QString& folder) {
    std::vector<LostText> found;
    const QDir directory(folder);
    for (const QString& name : directory.entryList({u'*' + ending}, QDir::Files)) {
        const QString swapFile = directory.filePath(name);
        QLockFile lock(lockOf(swapFile));
        lock.setStaleLockTime(0);
        if (!lock.tryLock(0)) continue; // its session lives
        if (std::optional<LostText> lost = readSwap(swapFile)) found.push_back(std::move(*lost));
    }
    std::sort(found.begin(), found.end(),
              [](const LostText& a, const LostText& b) { return a.written > b.written; });
    return found;
}

void Recovery::discard(const LostText& lost) { QFile::remove(lost.swapFile); }

} // namespace carom
