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

bool writeSwap(const QString& swapFile, const QString& path, const QByteArray& text) {
    QSaveFile file(swapFile);
    if (!file.open(QIODevice::WriteOnly)) return false;
    QDataStream stream(&file);
    stream << signature << path << text;
    return file.commit();
}

} // namespace

Recovery::Recovery(const Document& document, const QString& folder, QObject* parent)
    : QObject(parent), m_document(document) {
    QDir().mkpath(folder);
    m_swapFile = QDir(folder).filePath(QUuid::createUuid().toString(QUuid::WithoutBraces) + ending);
    m_lock = std::make_unique<QLockFile>(lockOf(m_swapFile));
    m_lock->setStaleLockTime(0); // stale only when its process is gone
    m_lock->tryLock(0);
    connect(&m_timer, &QTimer::timeout, this, &Recovery::keepBehind);
    m_writer.setMaxThreadCount(1);
    m_timer.start(interval);
}

Recovery::~Recovery() {
    m_writer.waitForDone();
    QFile::remove(m_swapFile);
}

void Recovery::keep() {
    m_writer.waitForDone(); // what it writes is older
    if (!m_document.isModified()) {
        QFile::remove(m_swapFile);
        m_kept = -1;
        return;
    }
    if (m_kept == m_document.revision()) return;
    if (writeSwap(m_swapFile, m_document.path(), m_document.text())) m_kept = m_document.revision();
}

void Recovery::keepBehind() {
    if (m_writing) return; // the disk is slow; next time
    const bool nothingToWrite = !m_document.isModified() || m_kept == m_document.revision();
    if (nothingToWrite) return keep();
    m_writing = true;
    m_writer.start([this, swapFile = m_swapFile, path = m_document.path(), text = m_document.text(),
                    revision = m_document.revision()] {
        const bool written = writeSwap(swapFile, path, text);
        QMetaObject::invokeMethod(
            this,
            [this, written, revision] {
                m_writing = false;
                if (written) m_kept = std::max(m_kept, revision);
            },
            Qt::QueuedConnection);
    });
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
