// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/document.h"

#include "core/base/hash.h"
#include "core/language/analysis.h"
#include "ui/base/file_output.h"
#include "ui/base/pauses.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>

#include <algorithm>
#include <cstring>

namespace carom {
namespace {

constexpr qint64 longestText = qint64{largestText};
/// [ms] without a change until another program has finished writing the file. At a tenth a half-written file
/// is read; at ten times the window shows the old text for seconds.
constexpr int quietTime = 300;
/// An empty file is checked so often, for two seconds, before it counts as empty: programs that replace a
/// file empty it first.
constexpr int looksAtAnEmptyFile = 7;

/// Of words of eight bytes: it is to tell texts apart, and to take no time for a long one.
std::uint64_t hashOf(const QByteArray& bytes) {
    Hash64 hash;
    for (qsizetype at = 0; at < bytes.size(); at += qsizetype{sizeof(std::uint64_t)}) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data() + at,
                    static_cast<std::size_t>(std::min(qsizetype{sizeof word}, bytes.size() - at)));
        hash.add(word);
    }
    hash.add(static_cast<std::uint64_t>(bytes.size()));
    return hash.value();
}

/// Reads a scene's text; returns what went wrong.
std::optional<QString> read(const QString& path, QByteArray& bytes) {
    const QFileInfo info(path);
    if (info.isDir()) return Document::tr("“%1” is a folder; choose a scene file in it").arg(path);
    if (info.exists() && !info.isFile()) // a FIFO or a device may never end
        return Document::tr("“%1” is a device or a pipe; choose a scene file").arg(path);
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly))
        return Document::tr("“%1” cannot be read: %2").arg(path, file.errorString());
    if (file.size() > longestText)
        return Document::tr("“%1” has %2 MiB; a scene's text may have %3 MiB")
            .arg(path, QString::number(file.size() >> 20), QString::number(longestText >> 20));
    bytes = file.readAll();
    if (file.error() == QFileDevice::NoError) return std::nullopt;
    return Document::tr("“%1” cannot be read: %2").arg(path, file.errorString());
}

/// Of a file that is there; one that cannot be read is like no text.
std::optional<std::uint64_t> hashOfFile(const QString& path) {
    if (!QFileInfo::exists(path)) return std::nullopt;
    QByteArray bytes;
    read(path, bytes);
    return hashOf(bytes);
}

} // namespace

Document::Document(TextBuffer& buffer, QObject* parent) : QObject(parent), m_buffer(buffer) {
    m_quiet.setSingleShot(true);
    m_quiet.setInterval(pauseOf(quietTime));
    const auto wait = [this] { m_quiet.start(); };
    connect(&m_watcher, &QFileSystemWatcher::fileChanged, this, wait);
    connect(&m_watcher, &QFileSystemWatcher::directoryChanged, this, wait);
    connect(&m_quiet, &QTimer::timeout, this, &Document::look);
}

QString Document::name() const {
    return m_path.isEmpty() ? QStringLiteral("untitled.sdl") : QFileInfo(m_path).fileName();
}

std::optional<QString> Document::open(const QString& path) {
    QByteArray bytes;
    if (const std::optional<QString> problem = read(path, bytes)) return problem;
    take(QFileInfo(path).absoluteFilePath(), bytes);
    return std::nullopt;
}

std::optional<QString> Document::reload() {
    QByteArray bytes;
    if (const std::optional<QString> problem = read(m_path, bytes)) return problem;
    m_known = hashOf(bytes);
    m_seen = m_known;
    exchange([&] { m_buffer.exchangeBytes(bytes); });
    return std::nullopt;
}

std::optional<QString> Document::save() { return saveAs(m_path); }

std::optional<QString> Document::saveAs(const QString& path) {
    if (path.isEmpty()) return tr("the text has no file yet; choose a name for it");
    const QByteArray bytes = m_buffer.bytes();
    const QString problem = saveFile(path, bytes);
    if (!problem.isEmpty()) return problem;
    m_known = hashOf(bytes);
    m_seen = m_known;
    m_buffer.markSaved();
    watch(QFileInfo(path).absoluteFilePath());
    Q_EMIT pathChanged(m_path);
    return std::nullopt;
}

OnDisk Document::onDisk() const {
    const std::optional<std::uint64_t> found = hashOfFile(m_path);
    if (!found) return OnDisk::Missing;
    return *found == m_known ? OnDisk::AsKnown : OnDisk::Changed;
}

QByteArray Document::seeTextOnDisk() {
    QByteArray bytes;
    if (read(m_path, bytes)) return {};
    m_seen = hashOf(bytes);
    return bytes;
}

void Document::startNew(const QByteArray& text) { take({}, text); }

void Document::recover(const QString& path, const QByteArray& text) {
    take(path, text);
    // Whoever takes the text has seen what differs from the file.
    m_seen = hashOfFile(path);
    m_known = m_seen.value_or(0);
    m_buffer.markUnsaved();
}

void Document::noteEdit() { Q_EMIT edited(++m_revision); }

void Document::take(const QString& path, const QByteArray& text) {
    m_known = hashOf(text);
    m_seen = m_known;
    watch(path);
    exchange([&] { m_buffer.setBytes(text); });
}

void Document::exchange(const std::function<void()>& change) {
    const bool wasBlocked = blockSignals(true); // one signal for the whole exchange, not one an edit
    change();
    blockSignals(wasBlocked);
    ++m_revision;
    Q_EMIT pathChanged(m_path);
    Q_EMIT replaced();
}

void Document::watch(const QString& path) {
    if (path != m_path) {
        const QStringList before = m_watcher.files() + m_watcher.directories();
        if (!before.isEmpty()) m_watcher.removePaths(before);
    }
    m_path = path;
    if (path.isEmpty()) return;
    // A file that is replaced drops out; its folder tells when it is back.
    const QString folder = QFileInfo(path).absolutePath();
    if (QFileInfo::exists(path) && !m_watcher.files().contains(path)) m_watcher.addPath(path);
    if (!m_watcher.directories().contains(folder)) m_watcher.addPath(folder);
}

/// Something has happened to the file or beside it, and nothing more for a while.
void Document::look() {
    if (m_path.isEmpty()) return;
    watch(m_path);
    const std::optional<std::uint64_t> found = hashOfFile(m_path);
    const bool emptied = found && QFileInfo(m_path).size() == 0 && found != m_known;
    if (emptied && ++m_emptyLooks < looksAtAnEmptyFile) {
        m_quiet.start(); // whoever empties a file is likely to go on writing
        return;
    }
    m_emptyLooks = 0;
    if (found == m_seen) return;
    m_seen = found;
    if (!found) {
        m_buffer.markUnsaved();
        Q_EMIT removedOutside();
    } else if (*found == hashOf(m_buffer.bytes())) { // back as it was, or what stands here
        m_known = *found;
        m_buffer.markSaved();
    } else if (*found != m_known) {
        Q_EMIT changedOutside();
    }
}

} // namespace carom

#include "moc_document.cpp"
