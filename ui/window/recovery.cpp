// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/recovery.h"

#include "core/base/file_writer.h"
#include "ui/base/failures.h"

#include <QDataStream>
#include <QDir>
#include <QFile>
#include <QFileInfo>
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
    LostText lost{swapFile, {}, {}, QFileInfo(file).lastModified(), {}};
    stream >> found >> lost.path >> lost.text;
    if (found != signature || stream.status() != QDataStream::Ok) return std::nullopt;
    return lost;
}

/// What went wrong, in words, or an empty text.
QString writeSwap(const QString& swapFile, const QString& path, const QByteArray& text) {
    QByteArray bytes;
    QDataStream stream(&bytes, QIODevice::WriteOnly);
    stream << signature << path << text;
    return QString::fromStdString(writeWholeFile(QFile::encodeName(swapFile).toStdString(),
                                                 {bytes.constData(), static_cast<std::size_t>(bytes.size())},
                                                 FileReaders::OwnerOnly));
}

bool isInItsFile(const LostText& lost) {
    if (!QFileInfo(lost.path).isFile()) return false;
    QFile file(lost.path);
    return file.open(QIODevice::ReadOnly) && file.size() == lost.text.size() && file.readAll() == lost.text;
}

} // namespace

Recovery::Recovery(const Document& document, const QString& folder, int interval, QObject* parent)
    : QObject(parent), m_document(document) {
    QDir().mkpath(folder);
    QFile::setPermissions(folder, QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
    m_swapFile = QDir(folder).filePath(QUuid::createUuid().toString(QUuid::WithoutBraces) + ending);
    m_lock = std::make_unique<QLockFile>(lockOf(m_swapFile));
    m_lock->setStaleLockTime(0); // stale only when its process is gone
    m_lock->tryLock(0);
    connect(&m_timer, &QTimer::timeout, this, &Recovery::keepBehind);
    // What has been saved is no loss from then on: the swap file may be older than the file.
    connect(&document, &Document::pathChanged, this, [this] {
        if (!m_document.isModified()) keep();
    });
    m_writer.setMaxThreadCount(1);
    m_timer.start(interval);
}

Recovery::~Recovery() {
    m_writer.waitForDone();
    QFile::remove(m_swapFile);
}

bool Recovery::keep() {
    m_writer.waitForDone(); // what it writes is older
    if (!m_document.isModified()) {
        QFile::remove(m_swapFile);
        m_kept = -1;
        note(-1, {});
        return true;
    }
    if (m_kept != m_document.revision())
        note(m_document.revision(), writeSwap(m_swapFile, m_document.path(), m_document.text()));
    return m_kept == m_document.revision();
}

void Recovery::keepBehind() {
    if (m_writing) return; // the disk is slow; next time
    const bool nothingToWrite = !m_document.isModified() || m_kept == m_document.revision();
    if (nothingToWrite) {
        keep();
        return;
    }
    m_writing = true;
    m_writer.start([this, swapFile = m_swapFile, path = m_document.path(), text = m_document.text(),
                    revision = m_document.revision()] {
        QString problem;
        const QString failure = attempt([&] { problem = writeSwap(swapFile, path, text); });
        if (!failure.isEmpty()) problem = failure;
        QMetaObject::invokeMethod(
            this,
            [this, problem, revision] {
                m_writing = false;
                note(revision, problem);
            },
            Qt::QueuedConnection);
    });
}

void Recovery::note(std::int64_t revision, const QString& problem) {
    if (problem.isEmpty()) m_kept = std::max(m_kept, revision);
    if (problem == m_problem) return;
    m_problem = problem;
    Q_EMIT keepingChanged(problem);
}

QString Recovery::standardFolder() {
    return QDir(QStandardPaths::writableLocation(QStandardPaths::AppDataLocation))
        .filePath(QStringLiteral("recovery"));
}

LostTexts Recovery::lostTexts(const QString& folder) {
    LostTexts found;
    const QDir directory(folder);
    for (const QString& name : directory.entryList({u'*' + ending, u'*' + lockOf(ending)}, QDir::Files)) {
        const bool isLock = name.endsWith(lockOf(ending));
        const QString swapFile =
            directory.filePath(isLock ? name.chopped(lockOf(ending).size() - ending.size()) : name);
        if (isLock && QFileInfo::exists(swapFile)) continue; // seen with its swap file
        const auto lock = std::make_shared<QLockFile>(lockOf(swapFile));
        lock->setStaleLockTime(0);
        if (!lock->tryLock(0)) continue; // its session lives, or another window offers it
        if (isLock) continue;            // nobody's: unlocking removes it
        std::optional<LostText> lost = readSwap(swapFile);
        if (!lost) {
            found.unreadable << swapFile;
        } else if (isInItsFile(*lost)) {
            discard(*lost);
        } else {
            lost->lock = lock;
            found.texts.push_back(std::move(*lost));
        }
    }
    std::sort(found.texts.begin(), found.texts.end(),
              [](const LostText& a, const LostText& b) { return a.written > b.written; });
    return found;
}

void Recovery::discard(const LostText& lost) { QFile::remove(lost.swapFile); }

} // namespace carom

#include "moc_recovery.cpp"
